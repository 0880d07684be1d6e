// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/trajectory_io.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/files.h"

namespace semslam {
namespace {

using testing::InputErrorOf;
using testing::ReadAll;
using testing::TemporaryFolder;

TEST(TrajectoryIo, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const Trajectory written = {
      {1305031102175304000, {Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5), {1.25, -2.5, 1e-3}}},
      {1305031102211214000, {Eigen::Quaterniond(0.6, 0, 0.8, 0), {0, 1000.125, -7}}}};
  WriteTrajectory(folder.path() / "t.txt", written);
  const Trajectory read = ReadTrajectory(folder.path() / "t.txt");
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].time, written[i].time);
    EXPECT_LT(RotationAngle(read[i].T_world_camera, written[i].T_world_camera), 1e-8);
    EXPECT_LT((read[i].T_world_camera.translation - written[i].T_world_camera.translation).norm(),
              1e-8);
  }
}

TEST(TrajectoryIo, WritesTheBenchmarksFormat) {
  const TemporaryFolder folder;
  WriteTrajectory(folder.path() / "t.txt",
                  {{1305031102175304000, {Eigen::Quaterniond(-0.6, 0, -0.8, 0), {1, -2, 0.5}}}});
  EXPECT_EQ(ReadAll(folder.path() / "t.txt"),
            "# timestamp tx ty tz qx qy qz qw\n"
            "1305031102.175304 1.000000000 -2.000000000 0.500000000 "
            "-0.000000000 0.800000000 -0.000000000 0.600000000\n");
}

TEST(TrajectoryIo, ReadsCommentsCommasTabsAndWindowsLineEnds) {
  const TemporaryFolder folder;
  const auto path =
      folder.Write("t.txt", "# comment\r\n\r\n1.5,1,2,3,0,0,0,1\r\n2.5\t1 2  3\t0 0 0 1\r\n");
  const Trajectory read = ReadTrajectory(path);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].time, 2'500'000'000);
  EXPECT_EQ(read[0].T_world_camera.translation, Eigen::Vector3d(1, 2, 3));
}

TEST(TrajectoryIo, ReadsTimesAsNumpyWritesThem) {
  const TemporaryFolder folder;
  const auto path = folder.Write("t.txt", "1.305031102175304000e+09 0 0 0 0 0 0 1\n");
  // A double of such a time is good to about 0.2 us.
  EXPECT_NEAR(static_cast<double>(ReadTrajectory(path).at(0).time - 1305031102175304000), 0, 500);
}

TEST(TrajectoryIo, SortsByTime) {
  const TemporaryFolder folder;
  const auto path = folder.Write("t.txt", "2 0 0 0 0 0 0 1\n1 5 0 0 0 0 0 1\n");
  EXPECT_EQ(ReadTrajectory(path).at(0).T_world_camera.translation.x(), 5);
}

TEST(TrajectoryIo, NormalisesQuaternions) {
  const TemporaryFolder folder;
  const auto path = folder.Write("t.txt", "1 0 0 0 0 0 0 3\n");
  EXPECT_NEAR(ReadTrajectory(path).at(0).T_world_camera.rotation.norm(), 1, 1e-12);
}

TEST(TrajectoryIo, NamesTheLineThatIsCutShort) {
  const TemporaryFolder folder;
  const auto path = folder.Write("t.txt", "# x\n1 0 0 0 0 0 0 1\n2 0 0 0 0\n");
  EXPECT_EQ(InputErrorOf([&] { ReadTrajectory(path); }),
            path.string() + ":3: expected 8 numbers `t tx ty tz qx qy qz qw`, found 5 fields");
}

TEST(TrajectoryIo, NamesWhatIsNoNumber) {
  const TemporaryFolder folder;
  for (const char* bad : {"nan", "1.2.3", "abc", "inf", "1e999", "0x10", "1,"}) {
    std::string line = std::string("1 0 0 0 0 0 0 ") + bad;
    if (std::string(bad) == "1,") line = "abc 0 0 0 0 0 0 1";
    const auto path = folder.Write("t.txt", line + "\n");
    const std::string text = InputErrorOf([&] { ReadTrajectory(path); });
    EXPECT_TRUE(text.starts_with(path.string() + ":1: expected a ")) << text;
  }
}

TEST(TrajectoryIo, RejectsAQuaternionOfZeros) {
  const TemporaryFolder folder;
  const auto path = folder.Write("t.txt", "1 0 0 0 0 0 0 0\n");
  EXPECT_EQ(InputErrorOf([&] { ReadTrajectory(path); }),
            path.string() + ":1: expected a quaternion, found zeros");
}

TEST(TrajectoryIo, SaysThatAFileIsMissing) {
  EXPECT_EQ(InputErrorOf([] { ReadTrajectory("/no/such.txt"); }),
            "/no/such.txt: cannot read: No such file or directory");
}

TEST(TrajectoryIo, SaysThatAFolderIsNoFile) {
  EXPECT_EQ(InputErrorOf([] { ReadTrajectory("/tmp"); }), "/tmp: cannot read: Is a directory");
}

}  // namespace
}  // namespace semslam

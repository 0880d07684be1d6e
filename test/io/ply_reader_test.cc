// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/io/cloud_io.h"

#include "support/files.h"

namespace semslam {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::TemporaryFolder;

class PlyReaderTest : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& bytes) {
    const std::filesystem::path path = folder_.path() / "cloud.ply";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  std::string ErrorOf(const std::string& bytes) {
    const std::filesystem::path path = Write(bytes);
    return InputErrorOf([&] { ReadPly(path); });
  }

  TemporaryFolder folder_;
};

const std::string kTextHeader =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\n";

TEST_F(PlyReaderTest, ReadsBackAllThatIsWritten) {
  const std::vector<Eigen::Vector3f> positions = {{1, 2, 3}, {-4, 5.5F, 6}};
  const std::vector<Rgb> colors = {{1, 2, 3}, {250, 251, 252}};
  const std::vector<Eigen::Vector3f> normals = {{0, 0, 1}, {0, -1, 0}};
  const std::vector<std::uint32_t> labels = {0, 4'000'000'000U};
  const std::vector<std::uint32_t> segments = {7, 8};
  const std::vector<std::uint32_t> objects = {0, 3};
  const std::vector<float> confidences = {0, 0.25F};
  const std::vector<float> entropies = {1, 0.5F};
  const std::filesystem::path path = folder_.path() / "cloud.ply";
  WritePly(path, {.positions = positions,
                  .colors = colors,
                  .normals = normals,
                  .labels = labels,
                  .segments = segments,
                  .objects = objects,
                  .confidences = confidences,
                  .entropies = entropies});
  const CloudColumns cloud = ReadPly(path);
  EXPECT_EQ(cloud.positions, positions);
  EXPECT_EQ(cloud.colors, colors);
  EXPECT_EQ(cloud.normals, normals);
  EXPECT_EQ(cloud.labels, labels);
  EXPECT_EQ(cloud.segments, segments);
  EXPECT_EQ(cloud.objects, objects);
  EXPECT_EQ(cloud.confidences, confidences);
  EXPECT_EQ(cloud.entropies, entropies);
}

TEST_F(PlyReaderTest, ReadsTextWithOtherPropertiesAndElements) {
  const CloudColumns cloud = ReadPly(Write(
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement vertex 2\r\nproperty double x\r\n"
      "property float quality\r\nproperty double y\r\nproperty double z\r\nproperty uchar red\r\n"
      "property uchar green\r\nproperty uchar blue\r\nelement face 1\r\n"
      "property list uchar int vertex_indices\r\nend_header\r\n"
      "1 9 2 3 10 20 30\r\n4 9 5 6 40 50 60\r\n3 0 1 0\r\n"));
  EXPECT_THAT(cloud.positions, ElementsAre(Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6)));
  EXPECT_THAT(cloud.colors, ElementsAre(Rgb{10, 20, 30}, Rgb{40, 50, 60}));
  EXPECT_TRUE(cloud.normals.empty());
}

TEST_F(PlyReaderTest, ReadsTheOtherByteOrder) {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty double y\n"
      "property short z\nend_header\n";
  bytes += std::string("\x3f\x80\x00\x00", 4);                  // 1
  bytes += std::string("\xc0\x00\x00\x00\x00\x00\x00\x00", 8);  // -2
  bytes += std::string("\x01\x00", 2);                          // 256
  EXPECT_THAT(ReadPly(Write(bytes)).positions, ElementsAre(Eigen::Vector3f(1, -2, 256)));
}

TEST_F(PlyReaderTest, ColoursMayBeSharesOfOne) {
  const CloudColumns cloud =
      ReadPly(Write(kTextHeader + "property float red\nproperty float green\nproperty float blue\n"
                                  "end_header\n0 0 0 1 0.5 0\n0 0 1 7 -1 0\n"));
  EXPECT_THAT(cloud.colors, ElementsAre(Rgb{255, 127, 0}, Rgb{255, 0, 0}));
}

TEST_F(PlyReaderTest, PointsThatAreNoNumbersAreLeftOut) {
  const CloudColumns cloud = ReadPly(Write(kTextHeader + "end_header\nnan 0 0\n1 2 3\n"));
  EXPECT_THAT(cloud.positions, ElementsAre(Eigen::Vector3f(1, 2, 3)));
}

TEST_F(PlyReaderTest, DamageIsAnErrorThatNamesFileAndReason) {
  for (const auto& [bytes, reason] : std::vector<std::pair<std::string, std::string>>{
           {"", "end_header"},
           {"solid cube\n", "first line ply"},
           {"ply\nformat ascii 1.0\nend_header\n", "element vertex"},
           {"ply\nelement vertex 1\nproperty float x\nend_header\n", "format"},
           {"ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nformat ascii 1.0\n",
            "one line with the format"},
           {"ply\nformat ascii 1.0\nelement vertex 1\nelement vertex 1\n", "one element"},
           {"ply\nformat utf8 1.0\n", "unknown format"},
           {"ply\nformat ascii 1.0\nelement vertex -2\n", "number of vertices"},
           {"ply\nformat ascii 1.0\nelement face 2\nelement vertex 1\n", "vertices first"},
           {"ply\nformat ascii 1.0\nelement vertex 1\nproperty list int int x\n", "unknown type"},
           {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "x, y"},
           {kTextHeader + "end_header\n1 2 3\n4 5\n", "cut short"},
           {kTextHeader + "end_header\n1 2 3\n4 five 6\n", "five"},
           {"ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\n"
            "property float x\nproperty float y\nproperty float z\nend_header\n1234",
            "cut short"}}) {
    EXPECT_THAT(ErrorOf(bytes), AllOf(HasSubstr("cloud.ply"), HasSubstr(reason))) << bytes;
  }
}

TEST_F(PlyReaderTest, NoCutOfAFileCrashes) {
  const std::filesystem::path path = folder_.path() / "whole.ply";
  const std::vector<Eigen::Vector3f> positions(3, Eigen::Vector3f(1, 2, 3));
  WritePly(path, {.positions = positions});
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(ErrorOf(bytes.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// The whole system on two real clips of the TUM benchmark, against their ground truth.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "semslam/config/settings.h"
#include "semslam/eval/trajectory_error.h"
#include "semslam/io/trajectory_io.h"
#include "semslam/io/tum_dataset.h"
#include "semslam/pipeline/system.h"

#include "support/clips.h"

namespace semslam {
namespace {

struct Case {
  const char* clip;
  int num_frames;
  double max_error;  // Metres, root mean square of the absolute trajectory error.
  Threading threading;
};
void PrintTo(const Case& c, std::ostream* stream) { *stream << c.clip; }

class RealClip : public ::testing::TestWithParam<Case> {};

TEST_P(RealClip, IsTrackedInEveryFrameAndCloseToTheTruth) {
  const Case& test = GetParam();
  const std::filesystem::path folder = testing::FindClip(test.clip);
  if (folder.empty()) GTEST_SKIP() << testing::kHowToGetClips;
  const std::filesystem::path source = SEMSLAM_SOURCE_DIR;
  const Settings settings = LoadSettings(source / "config/TUM1.yaml");
  TumDataset sequence(folder, folder / "associations.txt", {});
  System::Options options;
  options.threading = test.threading;
  System system(settings,
                std::make_shared<const Vocabulary>(Vocabulary::Load(source / "Vocabulary/orb.voc")),
                std::move(options));
  int num_frames = 0;
  while (std::optional<RgbdImage> image = sequence.Next()) {
    const auto result = system.TrackRGBD(std::make_shared<const RgbdImage>(*std::move(image)));
    EXPECT_EQ(result.state, TrackingState::kTracking) << "frame " << num_frames;
    ++num_frames;
  }
  EXPECT_EQ(num_frames, test.num_frames);
  const PointCloudMapping::Result map = system.Shutdown();
  EXPECT_GT(map.cloud.size(), 10'000u);

  Trajectory estimate;
  for (const System::TrackedPose& pose : system.CameraTrajectory()) {
    estimate.push_back({pose.time, pose.T_world_camera});
  }
  EXPECT_EQ(estimate.size(), static_cast<std::size_t>(test.num_frames));
  const TrajectoryError error =
      EvaluateTrajectory(ReadTrajectory(folder / "groundtruth.txt"), estimate);
  RecordProperty("ate_rmse_mm", std::to_string(1e3 * error.absolute.rmse));
  EXPECT_LE(error.absolute.rmse, test.max_error);
}

INSTANTIATE_TEST_SUITE_P(Clips,
                         RealClip,
                         ::testing::Values(Case{"fr1_xyz_160", 160, 0.0105, Threading::kInline},
                                           Case{"fr1_xyz_160", 160, 0.0105, Threading::kWorkers},
                                           Case{"fr1_desk_80", 80, 0.0140, Threading::kInline},
                                           Case{"fr1_desk_80", 80, 0.0140, Threading::kWorkers}),
                         [](const auto& test) {
                           return std::string(test.param.clip) +
                                  (test.param.threading == Threading::kInline ? "_inline"
                                                                              : "_workers");
                         });

}  // namespace
}  // namespace semslam

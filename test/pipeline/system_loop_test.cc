// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// A loop is closed in the running system, with all its threads; the thread sanitizer looks on.
#include <algorithm>
#include <memory>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/pipeline/system.h"

#include "pipeline/turning_camera.h"

namespace semslam {
namespace {

using testing::TurningCamera;

constexpr int kNumFrames = TurningCamera::kNumFramesATurn + 22;

class SystemLoop : public ::testing::Test {
 protected:
  std::unique_ptr<System> MakeSystem(Threading threading, bool enabled = true) {
    Settings settings = TurningCamera::MakeSettings();
    settings.loop.enabled = enabled;
    settings.tracking.keyframes.max_new_share = 10;  // Few keyframes, so that there is drift.
    return std::make_unique<System>(
        settings, Words(),
        System::Options{.threading = threading,
                        .detector = nullptr,
                        .log = [this](LogLevel, std::string_view, std::string_view line) {
                          lines_.emplace_back(line);
                        }});
  }
  // Lets local mapping keep up, as it would at the speed of a camera.
  static void Track(System& system, int first, int last) {
    for (int i = first; i < last; ++i) {
      ASSERT_EQ(system.TrackRGBD(Camera().Image(i)).state, TrackingState::kTracking) << i;
      while (!system.status().mapping_is_idle) std::this_thread::yield();
    }
  }
  // Between frames that saw the same, a full turn apart: metres, the median.
  static double MedianGap(const std::vector<System::TrackedPose>& poses) {
    std::vector<double> gaps;
    for (std::size_t i = TurningCamera::kNumFramesATurn; i < poses.size(); ++i) {
      const Rigid3& before = poses[i - TurningCamera::kNumFramesATurn].T_world_camera;
      gaps.push_back((poses[i].T_world_camera.translation - before.translation).norm());
    }
    std::sort(gaps.begin(), gaps.end());
    return gaps.at(gaps.size() / 2);
  }

  static const TurningCamera& Camera() {
    static const TurningCamera camera;
    return camera;
  }
  static std::shared_ptr<const Vocabulary> Words() {
    static const std::shared_ptr<const Vocabulary> vocabulary = Camera().Train();
    return vocabulary;
  }

  std::vector<std::string> lines_;
};

TEST_F(SystemLoop, WithoutLoopClosingTheTurnDoesNotMeetItself) {
  const auto system = MakeSystem(Threading::kInline, false);
  Track(*system, 0, kNumFrames);
  system->Shutdown();
  EXPECT_EQ(system->status().num_loops, 0u);
  EXPECT_GT(MedianGap(system->CameraTrajectory()), 0.1) << "metres of drift";
}

TEST_F(SystemLoop, IsClosedInline) {
  const auto system = MakeSystem(Threading::kInline);
  Track(*system, 0, kNumFrames);
  system->Shutdown();
  const System::Status status = system->status();
  EXPECT_EQ(status.num_loops, 1u);
  EXPECT_EQ(status.num_full_bundles, 1u);
  EXPECT_LT(MedianGap(system->CameraTrajectory()), 0.03);
  ASSERT_EQ(lines_.size(), 1u);
  EXPECT_THAT(lines_[0], ::testing::HasSubstr("loop closed"));
}

TEST_F(SystemLoop, IsClosedWhileTrackingGoesOn) {
  const auto system = MakeSystem(Threading::kWorkers);
  Track(*system, 0, kNumFrames);
  system->Shutdown();
  EXPECT_GE(system->status().num_loops, 1u);
  EXPECT_EQ(system->CameraTrajectory().size(), static_cast<std::size_t>(kNumFrames));
  EXPECT_LT(MedianGap(system->CameraTrajectory()), 0.03);
}

TEST_F(SystemLoop, GivesTheSameBitsTwiceWhenInline) {
  std::vector<std::vector<System::TrackedPose>> runs;
  for (int run = 0; run < 2; ++run) {
    const auto system = MakeSystem(Threading::kInline);
    Track(*system, 0, kNumFrames);
    system->Shutdown();
    runs.push_back(system->CameraTrajectory());
  }
  ASSERT_EQ(runs[0].size(), runs[1].size());
  for (std::size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0][i].T_world_camera.ToMatrix(), runs[1][i].T_world_camera.ToMatrix()) << i;
  }
}

// The camera is covered while it turns on, and sees a new place then.
class CoveredOnTheWay : public SystemLoop {
 protected:
  static constexpr int kCoverFrom = 25;
  static constexpr int kCoverTo = 42;
  static constexpr int kFramesToStart = 5;

  static int TrackCovered(System& system, int last) {
    int num_tracked = 0;
    for (int i = 0; i < last; ++i) {
      RgbdImage image = *Camera().Image(i);
      if (i >= kCoverFrom && i < kCoverTo) {
        image.color = cv::Mat(image.color.size(), image.color.type(), cv::Scalar::all(0));
        image.depth = cv::Mat(image.depth.size(), image.depth.type(), cv::Scalar::all(0));
      }
      const auto result = system.TrackRGBD(std::make_shared<const RgbdImage>(std::move(image)));
      if (result.state == TrackingState::kTracking) ++num_tracked;
      while (!system.status().mapping_is_idle) std::this_thread::yield();
    }
    return num_tracked;
  }
};

TEST_F(CoveredOnTheWay, TheTwoPiecesOfTheMapAreJoinedWhenTheTurnIsComplete) {
  for (const Threading threading : {Threading::kInline, Threading::kWorkers}) {
    lines_.clear();
    const auto system = MakeSystem(threading);
    const int num_tracked = TrackCovered(*system, kNumFrames);
    EXPECT_GE(num_tracked, kNumFrames - (kCoverTo - kCoverFrom) - kFramesToStart);
    system->Shutdown();
    EXPECT_EQ(system->status().num_pieces, 1u);
    EXPECT_EQ(system->status().num_joins, 1u);
    EXPECT_EQ(system->CameraTrajectory().size(), static_cast<std::size_t>(num_tracked));
    ASSERT_GE(lines_.size(), 2u);
    EXPECT_THAT(lines_[0], ::testing::HasSubstr("another piece of the map begins"));
    EXPECT_THAT(lines_[1], ::testing::HasSubstr("joined"));
  }
}

TEST_F(CoveredOnTheWay, APieceThatWasNotJoinedIsLeftOutOfTheResults) {
  const auto system = MakeSystem(Threading::kInline);
  TrackCovered(*system, kCoverTo + 12);
  const PointCloudMapping::Result result = system->Shutdown();
  EXPECT_EQ(system->status().num_pieces, 2u);
  EXPECT_EQ(system->status().num_joins, 0u);
  const std::vector<System::TrackedPose> poses = system->CameraTrajectory();
  EXPECT_EQ(poses.size(), static_cast<std::size_t>(kCoverFrom)) << "the larger piece";
  for (const System::TrackedPose& pose : system->KeyframeTrajectory())
    EXPECT_LT(pose.time, Camera().Image(kCoverFrom)->time);
  // What was seen before the camera was covered, and nothing beside it.
  const auto alone = MakeSystem(Threading::kInline);
  TrackCovered(*alone, kCoverFrom);
  EXPECT_EQ(result.cloud.positions.size(), alone->Shutdown().cloud.positions.size());
}

TEST_F(SystemLoop, MayBeLeftAtAnyMoment) {
  for (const int num_frames : {62, 66, 70, 74}) {
    const auto system = MakeSystem(Threading::kWorkers);
    Track(*system, 0, num_frames);
    if (num_frames % 4 == 0) system->Shutdown(System::PendingLabels::kDropAndBreakOff);
  }
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/system.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/pause.h"

#include "pipeline/same_poses.h"
#include "pipeline/wall_camera.h"
#include "support/label_detector.h"
#include "support/matchers.h"

namespace semslam {
namespace {

using testing::ExpectSameBits;
using testing::RecordedClip;
using testing::Rigid3Near;
using testing::WallCamera;

struct Outcome {
  std::vector<System::TrackedPose> camera;
  std::vector<System::TrackedPose> keyframes;
  PointCloudMapping::Result map;
};

class RenderedDesk : public ::testing::Test {
 protected:
  static constexpr int kNumFrames = 16;

  static const RecordedClip& Clip() {
    static const RecordedClip clip([] {
      RenderedClip::Options options;
      options.num_frames = kNumFrames;
      options.fps = 15;
      options.camera = {
          .width = 320, .height = 240, .fx = 262, .fy = 262, .cx = 159.5, .cy = 119.5};
      return options;
    }());
    return clip;
  }
  static Settings MakeSettings() {
    Settings settings;
    settings.camera = Clip().clip().options().camera;
    settings.bf = 20;
    settings.orb.num_features = 500;
    settings.tracking.min_features_to_start = 150;
    settings.tracking.keyframes.changed_ratio = 0.9;
    settings.tracking.keyframes.changed_ratio_at_start = 0.9;
    return settings;
  }
  static std::shared_ptr<const Vocabulary> Words() {
    static const auto vocabulary = [] {
      const Settings settings = MakeSettings();
      const FrameBuilder builder(settings.orb, PinholeCamera(settings.camera), settings.bf);
      std::vector<std::vector<Descriptor>> images;
      for (const std::size_t i : {0, 5, 10, 15}) {
        images.push_back(builder.Build(*Clip().images()[i]).descriptors);
      }
      return std::make_shared<const Vocabulary>(
          TrainVocabulary(images, {.branching = 8, .depth = 3, .max_iterations = 4}, 1));
    }();
    return vocabulary;
  }
  static Outcome RunAll(Threading threading) {
    System system(MakeSettings(), Words(),
                  {.threading = threading, .detector = Clip().MakeDetector(), .log = {}});
    for (const RgbdImagePtr& image : Clip().images()) {
      EXPECT_EQ(system.TrackRGBD(image).state, TrackingState::kTracking) << image->time;
    }
    Outcome run;
    run.map = system.Shutdown();
    run.camera = system.CameraTrajectory();
    run.keyframes = system.KeyframeTrajectory();
    return run;
  }
};

TEST_F(RenderedDesk, CanBeWatchedWhileItRuns) {
  System system(MakeSettings(), Words(),
                {.threading = Threading::kInline, .detector = nullptr, .log = {}});
  Tracking::Result last;
  for (const RgbdImagePtr& image : Clip().images()) last = system.TrackRGBD(image);
  ASSERT_NE(last.frame, nullptr);
  EXPECT_EQ(last.shows_landmark.size(), last.frame->keypoints.size());
  EXPECT_GE(std::count(last.shows_landmark.begin(), last.shows_landmark.end(), true),
            last.num_inliers / 2);
  const System::Graph graph = system.graph(1);
  EXPECT_EQ(graph.keyframes.size(), system.status().num_keyframes);
  EXPECT_EQ(graph.tree.size(), graph.keyframes.size() - 1);  // All but the first have a parent.
  EXPECT_GE(graph.covisible.size(), graph.tree.size());
  EXPECT_GE(system.clouds().size(), graph.keyframes.size());
  std::vector<KeyframeId> ids;
  for (const auto& cloud : system.clouds()) ids.push_back(cloud->id());
  EXPECT_EQ(system.KeyframePoses(ids).size(), ids.size());
}

TEST_F(RenderedDesk, APreviewIsTheMapAsItIs) {
  System system(MakeSettings(), Words(),
                {.threading = Threading::kWorkers, .detector = Clip().MakeDetector(), .log = {}});
  EXPECT_EQ(system.preview(), nullptr);
  for (const RgbdImagePtr& image : Clip().images()) system.TrackRGBD(image);
  while (!system.status().mapping_is_idle) Pause(0.01);
  system.RequestPreview();
  const PointCloudMapping::Result map = system.Shutdown();
  const auto preview = system.preview();
  ASSERT_NE(preview, nullptr);
  EXPECT_EQ(preview->semantics.class_of_point.size(), preview->cloud.size());
  // It may have been made before the last keyframes came.
  EXPECT_GT(preview->cloud.size(), 1000u);
  EXPECT_LT(static_cast<double>(preview->cloud.size()),
            1.1 * static_cast<double>(map.cloud.size()));
}

TEST_F(RenderedDesk, PreviewsDoNotChangeTheResult) {
  const Outcome expected = RunAll(Threading::kInline);
  System system(MakeSettings(), Words(),
                {.threading = Threading::kInline, .detector = Clip().MakeDetector(), .log = {}});
  for (const RgbdImagePtr& image : Clip().images()) {
    system.TrackRGBD(image);
    system.RequestPreview();
  }
  EXPECT_EQ(system.Shutdown().cloud.positions, expected.map.cloud.positions);
  EXPECT_EQ(system.preview(), nullptr);  // All in one thread: there is no time for them.
}

TEST_F(RenderedDesk, ResetForgetsMapAndTrajectory) {
  System system(MakeSettings(), Words(),
                {.threading = Threading::kInline, .detector = nullptr, .log = {}});
  const auto& images = Clip().images();
  for (std::size_t i = 0; i < 8; ++i) system.TrackRGBD(images[i]);
  system.Reset();
  EXPECT_EQ(system.status().num_keyframes, 0u);
  EXPECT_TRUE(system.CameraTrajectory().empty());
  EXPECT_TRUE(system.clouds().empty());
  const Tracking::Result first = system.TrackRGBD(images[8]);
  EXPECT_EQ(first.state, TrackingState::kTracking);
  EXPECT_TRUE(first.new_keyframe);
  for (std::size_t i = 9; i < 16; ++i)
    EXPECT_EQ(system.TrackRGBD(images[i]).state, TrackingState::kTracking);
  EXPECT_GT(system.Shutdown().cloud.size(), 1000u);
  EXPECT_EQ(system.CameraTrajectory().size(), 8u);
}

TEST_F(RenderedDesk, LocalisationOnlyLeavesTheMapAsItIsUntilItIsSwitchedOff) {
  System system(MakeSettings(), Words(),
                {.threading = Threading::kInline, .detector = nullptr, .log = {}});
  const auto& images = Clip().images();
  for (std::size_t i = 0; i < 4; ++i) system.TrackRGBD(images[i]);
  const System::Status before = system.status();
  system.SetLocalizationOnly(true);
  for (std::size_t i = 4; i < 8; ++i) {
    const Tracking::Result result = system.TrackRGBD(images[i]);
    EXPECT_EQ(result.state, TrackingState::kTracking);
    EXPECT_FALSE(result.new_keyframe);
  }
  EXPECT_EQ(system.status().num_landmarks, before.num_landmarks);
  system.SetLocalizationOnly(false);
  for (std::size_t i = 8; i < 16; ++i) system.TrackRGBD(images[i]);
  EXPECT_GT(system.status().num_keyframes, before.num_keyframes);
}

TEST_F(RenderedDesk, GivesTheSameBitsTwiceWhenInline) {
  const Outcome first = RunAll(Threading::kInline);
  const Outcome second = RunAll(Threading::kInline);
  EXPECT_EQ(first.camera.size(), static_cast<std::size_t>(kNumFrames));
  EXPECT_GT(first.keyframes.size(), 1u);
  ExpectSameBits(first.camera, second.camera);
  ExpectSameBits(first.keyframes, second.keyframes);
  EXPECT_GT(first.map.cloud.size(), 1000u);
  EXPECT_EQ(first.map.cloud.positions, second.map.cloud.positions);
  EXPECT_EQ(first.map.cloud.colors, second.map.cloud.colors);
  EXPECT_EQ(first.map.segmentation.segment_of_point, second.map.segmentation.segment_of_point);
  EXPECT_EQ(first.map.semantics.class_of_point, second.map.semantics.class_of_point);
  EXPECT_EQ(first.map.semantics.object_of_point, second.map.semantics.object_of_point);
  EXPECT_EQ(first.map.semantics.confidence_of_point, second.map.semantics.confidence_of_point);
  ASSERT_EQ(first.map.semantics.objects.size(), second.map.semantics.objects.size());
}

TEST_F(RenderedDesk, IsTrackedAlikeByThreadsOfTheirOwn) {
  const Outcome run = RunAll(Threading::kWorkers);
  ASSERT_EQ(run.camera.size(), static_cast<std::size_t>(kNumFrames));
  const Rigid3 T_first_world = Clip().clip().T_world_camera(0).Inverse();
  for (std::size_t i = 0; i < run.camera.size(); ++i) {
    EXPECT_THAT(run.camera[i].T_world_camera,
                Rigid3Near(T_first_world * Clip().clip().T_world_camera(i), 0.02, 0.02))
        << "frame " << i;
  }
  EXPECT_GT(run.map.cloud.size(), 1000u);
}

class SystemTest : public ::testing::Test {
 protected:
  std::unique_ptr<System> MakeSystem() const {
    return std::make_unique<System>(
        WallCamera::MakeSettings(), wall_.Train(),
        System::Options{.threading = Threading::kInline, .detector = nullptr, .log = log_});
  }
  WallCamera wall_{40};
  LogSink log_;
};

TEST_F(SystemTest, WithoutFramesTheMapIsEmpty) {
  const auto system = MakeSystem();
  EXPECT_EQ(system->Shutdown().cloud.size(), 0u);
  EXPECT_TRUE(system->CameraTrajectory().empty());
  EXPECT_TRUE(system->KeyframeTrajectory().empty());
}

TEST_F(SystemTest, TracksAndMapsAWall) {
  const auto system = MakeSystem();
  for (int i = 0; i < 30; ++i) {
    const Tracking::Result result = system->TrackRGBD(wall_.Image(i));
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    ASSERT_THAT(
        result.T_world_camera,
        Rigid3Near(Rigid3{Eigen::Quaterniond::Identity(), WallCamera::Position(i)}, 0.02, 0.03))
        << "frame " << i;
  }
  const System::Status status = system->status();
  EXPECT_GT(status.num_keyframes, 1u);
  EXPECT_GT(status.num_landmarks, 100u);
  EXPECT_GT(status.num_voxels, 100u);
  EXPECT_EQ(status.mapping_queue + status.dense_queue + status.detector_queue, 0u);
  EXPECT_FALSE(system->has_detector());
  const PointCloudMapping::Result map = system->Shutdown();
  for (const Eigen::Vector3f& p : map.cloud.positions) EXPECT_NEAR(p.z(), WallCamera::kDepth, 0.05);
  EXPECT_EQ(system->CameraTrajectory().size(), 30u);
}

TEST_F(SystemTest, AMapThatWasStartedOverHasTheNewPosesOnly) {
  std::vector<std::string> lines;
  log_ = [&](LogLevel, std::string_view, std::string_view line) { lines.emplace_back(line); };
  const auto system = MakeSystem();
  system->TrackRGBD(wall_.Image(0));
  system->TrackRGBD(wall_.Image(1));
  EXPECT_FALSE(system->TrackRGBD(WallCamera::Blank(2)).map_was_reset);
  EXPECT_TRUE(system->TrackRGBD(WallCamera::Blank(3)).map_was_reset);
  EXPECT_EQ(lines.size(), 1u);
  for (int i = 4; i < 8; ++i) system->TrackRGBD(wall_.Image(i));
  const PointCloudMapping::Result map = system->Shutdown();
  const std::vector<System::TrackedPose> trajectory = system->CameraTrajectory();
  ASSERT_EQ(trajectory.size(), 4u);
  EXPECT_EQ(trajectory.front().time, wall_.Image(4)->time);
  EXPECT_GT(map.cloud.size(), 100u);
  float min_x = 0;
  for (const Eigen::Vector3f& p : map.cloud.positions) min_x = std::min(min_x, p.x());
  EXPECT_GT(min_x, -0.9F) << "points of the old map lie where the new one has none";
}

TEST_F(SystemTest, SkipsFramesThatAreNotNewer) {
  std::vector<std::string> lines;
  log_ = [&](LogLevel, std::string_view, std::string_view line) { lines.emplace_back(line); };
  const auto system = MakeSystem();
  system->TrackRGBD(wall_.Image(1));
  for (const int number : {1, 0}) {
    const Tracking::Result result = system->TrackRGBD(wall_.Image(number));
    EXPECT_TRUE(result.was_skipped);
    EXPECT_EQ(result.state, TrackingState::kTracking) << "as before";
  }
  EXPECT_FALSE(system->TrackRGBD(wall_.Image(2)).was_skipped);
  EXPECT_EQ(lines.size(), 2u);
  system->Shutdown();
  EXPECT_EQ(system->CameraTrajectory().size(), 2u);
}

TEST_F(SystemTest, RefusesImagesThatAreNotTheCameras) {
  const auto system = MakeSystem();
  EXPECT_THROW(system->TrackRGBD(nullptr), std::logic_error);
  auto image = std::make_shared<RgbdImage>(*wall_.Image(0));
  image->color = cv::Mat(10, 10, CV_8UC3, cv::Scalar(0));
  EXPECT_THROW(system->TrackRGBD(image), std::logic_error);
  *image = *wall_.Image(0);
  image->depth = cv::Mat(WallCamera::kHeight, WallCamera::kWidth, CV_16UC1, cv::Scalar(0));
  EXPECT_THROW(system->TrackRGBD(image), std::logic_error);
  EXPECT_EQ(system->TrackRGBD(wall_.Image(0)).state, TrackingState::kTracking) << "it goes on";
}

}  // namespace
}  // namespace semslam

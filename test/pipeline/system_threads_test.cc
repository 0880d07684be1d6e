// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// System with all its threads; the thread sanitizer looks on.
#include <cmath>
#include <future>
#include <iterator>
#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/pipeline/system.h"

#include "pipeline/wall_camera.h"

namespace semslam {
namespace {

using testing::WallCamera;

// Sees the same thing everywhere, or fails everywhere.
class FakeDetector : public Detector {
 public:
  explicit FakeDetector(bool fails) : fails_(fails) {}
  std::vector<Detection> Detect(const RgbdImage& image) override {
    if (fails_) throw std::runtime_error("the network is down");
    Detection detection;
    detection.class_id = 0;
    detection.score = 0.9F;
    detection.box = {10, 10, static_cast<float>(image.color.cols) / 2, 100};
    detection.class_scores = {0.9F};
    return {detection};
  }
  const ClassTable& classes() const override { return classes_; }

 private:
  bool fails_;
  ClassTable classes_{{"book"}};
};

// Is stuck in its first image until it is let go.
class StuckDetector : public Detector {
 public:
  explicit StuckDetector(std::shared_future<void> let_go) : let_go_(std::move(let_go)) {}
  std::vector<Detection> Detect(const RgbdImage& /*image*/) override {
    let_go_.wait();
    return {};
  }
  const ClassTable& classes() const override { return classes_; }

 private:
  std::shared_future<void> let_go_;
  ClassTable classes_{{"book"}};
};

// Ten thousand boxes an image: outside of it, inside out, without numbers, of no class.
class BabblingDetector : public Detector {
 public:
  std::vector<Detection> Detect(const RgbdImage& image) override {
    const float nan = std::nanf("");
    const auto width = static_cast<float>(image.color.cols);
    const ImageBox boxes[] = {{-500, -500, -400, -400}, {2 * width, 0, 3 * width, 10},
                              {50, 50, 10, 10},         {nan, 0, 10, nan},
                              {-1e30F, 0, 1e30F, 10},   {5, 5, 5, 5}};
    std::vector<Detection> detections(10000);
    for (std::size_t i = 0; i < detections.size(); ++i) {
      detections[i].class_id = static_cast<int>(i % 5) - 2;
      detections[i].score = i % 3 == 0 ? nan : 1e3F;
      detections[i].box = boxes[i % std::size(boxes)];
      detections[i].class_scores.assign(i % 4, i % 2 == 0 ? nan : -7.0F);
    }
    return detections;
  }
  const ClassTable& classes() const override { return classes_; }

 private:
  ClassTable classes_{{"book", "cup"}};
};

class SystemThreads : public ::testing::Test {
 protected:
  std::unique_ptr<System> MakeSystem(std::unique_ptr<Detector> detector = nullptr) const {
    System::Options options;
    options.detector = std::move(detector);
    return std::make_unique<System>(WallCamera::MakeSettings(), vocabulary_, std::move(options));
  }

  WallCamera wall_{48};
  std::shared_ptr<const Vocabulary> vocabulary_ = wall_.Train();
};

TEST_F(SystemThreads, TrackAndMapAWallTogether) {
  const auto system = MakeSystem(std::make_unique<FakeDetector>(false));
  for (int i = 0; i < 25; ++i) {
    ASSERT_EQ(system->TrackRGBD(wall_.Image(i)).state, TrackingState::kTracking) << "frame " << i;
    system->status();
    system->CameraTrajectory();
  }
  const PointCloudMapping::Result map = system->Shutdown();
  EXPECT_GT(map.cloud.size(), 100u);
  const std::vector<System::TrackedPose> trajectory = system->CameraTrajectory();
  ASSERT_EQ(trajectory.size(), 25u);
  for (int i = 0; i < 25; ++i) {
    EXPECT_LT((trajectory[i].T_world_camera.translation - WallCamera::Position(i)).norm(), 0.03);
  }
  const DetectorThread::Statistics statistics = system->detector_statistics();
  EXPECT_GT(statistics.num_done, 0u);
  EXPECT_EQ(statistics.num_done, statistics.num_submitted) << "none is left behind";
}

TEST_F(SystemThreads, StopInAnyState) {
  for (int cycle = 0; cycle < 50; ++cycle) {
    const auto system =
        MakeSystem(cycle % 2 == 0 ? std::make_unique<FakeDetector>(false) : nullptr);
    const int num_frames = cycle % 5 == 4 ? 12 : cycle % 5;
    for (int i = 0; i < num_frames; ++i) system->TrackRGBD(wall_.Image(i));
    if (cycle % 3 == 0) system->Shutdown();  // Else it is left with what is queued.
  }
}

TEST_F(SystemThreads, ADetectorThatFailsCostsLabelsOnly) {
  const auto system = MakeSystem(std::make_unique<FakeDetector>(true));
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(system->TrackRGBD(wall_.Image(i)).state, TrackingState::kTracking);
  }
  const PointCloudMapping::Result map = system->Shutdown();
  EXPECT_GT(map.cloud.size(), 100u);
  EXPECT_TRUE(map.semantics.objects.empty());
  const DetectorThread::Statistics statistics = system->detector_statistics();
  EXPECT_GT(statistics.num_failed, 0u);
  EXPECT_EQ(statistics.num_failed, statistics.num_submitted);
  EXPECT_EQ(statistics.first_error, "the network is down");
}

TEST_F(SystemThreads, ADetectorThatHangsHoldsUpNobody) {
  std::promise<void> let_go;
  const auto system = MakeSystem(std::make_unique<StuckDetector>(let_go.get_future().share()));
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(system->TrackRGBD(wall_.Image(i)).state, TrackingState::kTracking) << "frame " << i;
  }
  EXPECT_EQ(system->detector_statistics().num_done, 0u);
  let_go.set_value();
  EXPECT_GT(system->Shutdown().cloud.size(), 100u);
  const DetectorThread::Statistics statistics = system->detector_statistics();
  EXPECT_EQ(statistics.num_done, statistics.num_submitted);
}

TEST_F(SystemThreads, ADetectorThatBabblesDoesNoHarm) {
  const auto system = MakeSystem(std::make_unique<BabblingDetector>());
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(system->TrackRGBD(wall_.Image(i)).state, TrackingState::kTracking);
  }
  const PointCloudMapping::Result map = system->Shutdown();
  EXPECT_GT(map.cloud.size(), 100u);
  for (const SemanticObject& object : map.semantics.objects) {
    EXPECT_TRUE(object.centroid.allFinite());
    EXPECT_TRUE(object.confidence >= 0 && object.confidence <= 1) << object.confidence;
  }
}

TEST_F(SystemThreads, StartOverWhileKeyframesOfTheOldMapAreQueued) {
  const auto system = MakeSystem(std::make_unique<FakeDetector>(false));
  int number = 0;
  for (int round = 0; round < 4; ++round) {
    for (int i = 0; i < 4; ++i) system->TrackRGBD(wall_.Image(number++));
    bool was_reset = false;
    for (int i = 0; i < 4; ++i)
      was_reset |= system->TrackRGBD(WallCamera::Blank(number++)).map_was_reset;
    EXPECT_TRUE(was_reset);
  }
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(system->TrackRGBD(wall_.Image(number++)).state, TrackingState::kTracking);
  }
  EXPECT_GT(system->Shutdown().cloud.size(), 100u);
}

}  // namespace
}  // namespace semslam

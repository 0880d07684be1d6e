// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// The whole system on a rendered desk with all its noise, against the scene's exact truth. The bars
// are about twice what was measured: path 1.2 mm, keyboard 14 mm, monitor 22 mm.
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "semslam/eval/trajectory_error.h"
#include "semslam/pipeline/system.h"

#include "support/desk_clip.h"
#include "support/label_detector.h"

namespace semslam {
namespace {

using testing::RecordedClip;

constexpr int kNumFrames = 72;

// One run for all tests here: it is the costly part.
class MappedDesk : public ::testing::Test {
 protected:
  struct Outcome {
    explicit Outcome(const RenderedClip::Options& options) : clip(options) {}
    RecordedClip clip;
    int num_tracked = 0;
    Trajectory camera;
    PointCloudMapping::Result map;
  };

  static void SetUpTestSuite() {
    RenderedClip::Options clip_options = testing::DeskClipOptions(kNumFrames);
    clip_options.fps = 20;
    run_ = new Outcome(clip_options);
    Settings settings;
    settings.camera = run_->clip.clip().options().camera;
    settings.fps = clip_options.fps;
    const std::filesystem::path source = SEMSLAM_SOURCE_DIR;
    auto vocabulary =
        std::make_shared<const Vocabulary>(Vocabulary::Load(source / "Vocabulary/orb.voc"));
    System system(
        settings, std::move(vocabulary),
        {.threading = Threading::kInline, .detector = run_->clip.MakeDetector(), .log = {}});
    for (const RgbdImagePtr& image : run_->clip.images()) {
      if (system.TrackRGBD(image).state == TrackingState::kTracking) ++run_->num_tracked;
    }
    run_->map = system.Shutdown();
    for (const System::TrackedPose& pose : system.CameraTrajectory()) {
      run_->camera.push_back({pose.time, pose.T_world_camera});
    }
  }
  static void TearDownTestSuite() {
    delete run_;
    run_ = nullptr;
  }

  static const Outcome& run() { return *run_; }
  static const RenderedClip& clip() { return run_->clip.clip(); }
  // The map's world is the first camera.
  static Eigen::Vector3d ToTrueWorld(const Eigen::Vector3d& p_world) {
    return clip().T_world_camera(0) * p_world;
  }
  static std::string ClassOf(const SemanticObject& object) {
    return run().map.semantics.classes.name(object.class_id);
  }
  // Mean of the points of each instance's surface that the camera saw.
  static std::map<int, Eigen::Vector3d> SeenCentroids() {
    std::map<int, std::pair<Eigen::Vector3d, double>> sums;
    const RayTable rays(clip().camera());
    for (std::size_t i = 0; i < clip().num_frames(); i += 12) {
      const RenderedFrame frame = clip().Frame(i);
      for (int y = 0; y < frame.ideal.labels.rows; y += 2) {
        for (int x = 0; x < frame.ideal.labels.cols; x += 2) {
          const auto z = static_cast<float>(frame.ideal.depth.at<double>(y, x));
          if (z <= 0) continue;
          auto& [sum, weight] = sums[frame.ideal.labels.at<std::uint16_t>(y, x)];
          if (weight == 0) sum.setZero();
          sum += frame.T_world_camera * rays.Unproject(x, y, z).cast<double>();
          weight += 1;
        }
      }
    }
    std::map<int, Eigen::Vector3d> centroids;
    for (const auto& [id, sum] : sums) {
      if (sum.second > 200) centroids[id] = sum.first / sum.second;
    }
    return centroids;
  }
  // Distance from the seen centroid of the nearest instance of a class; infinite without any.
  static double DistanceToInstance(const Eigen::Vector3d& p_true, const std::string& class_name) {
    static const std::map<int, Eigen::Vector3d> centroids = SeenCentroids();
    double nearest = INFINITY;
    for (const Instance& instance : clip().instances()) {
      const auto centroid = centroids.find(instance.id);
      if (instance.class_name != class_name || centroid == centroids.end()) continue;
      nearest = std::min(nearest, (centroid->second - p_true).norm());
    }
    return nearest;
  }

  static Outcome* run_;
};
MappedDesk::Outcome* MappedDesk::run_ = nullptr;

TEST_F(MappedDesk, IsTrackedInEveryFrame) {
  EXPECT_EQ(run().num_tracked, kNumFrames);
  EXPECT_EQ(run().camera.size(), static_cast<std::size_t>(kNumFrames));
}

TEST_F(MappedDesk, TheCamerasPathIsTrue) {
  Trajectory truth;
  for (std::size_t i = 0; i < clip().num_frames(); ++i) {
    truth.push_back({clip().Time(i), clip().T_world_camera(i)});
  }
  const TrajectoryError error = EvaluateTrajectory(truth, run().camera);
  RecordProperty("ate_rmse_mm", std::to_string(1e3 * error.absolute.rmse));
  EXPECT_EQ(error.num_pairs, kNumFrames);
  EXPECT_LE(error.absolute.rmse, 0.003);
}

TEST_F(MappedDesk, KeyboardAndMonitorAreObjectsWhereTheyAre) {
  for (const std::string class_name : {"keyboard", "tvmonitor"}) {
    double nearest = INFINITY;
    for (const SemanticObject& object : run().map.semantics.objects) {
      if (ClassOf(object) != class_name) continue;
      nearest = std::min(nearest, DistanceToInstance(ToTrueWorld(object.centroid), class_name));
    }
    RecordProperty(class_name + "_mm", std::to_string(1e3 * nearest));
    EXPECT_LE(nearest, 0.05) << class_name;
  }
}

TEST_F(MappedDesk, EveryObjectIsNearAThingOfItsClass) {
  EXPECT_GE(run().map.semantics.objects.size(), 2u);
  for (const SemanticObject& object : run().map.semantics.objects) {
    EXPECT_LE(DistanceToInstance(ToTrueWorld(object.centroid), ClassOf(object)), 0.25)
        << ClassOf(object) << " of " << object.num_points << " points";
  }
}

TEST_F(MappedDesk, TheDesksTopIsNoObject) {
  const Instance* desk = nullptr;
  for (const Instance& instance : clip().instances()) {
    if (instance.class_name == "desk") desk = &instance;
  }
  ASSERT_NE(desk, nullptr);
  const double top = desk->box.T_world_box.translation.z() + desk->box.half_size.z();
  int num_points = 0;
  int num_in_objects = 0;
  for (std::size_t i = 0; i < run().map.cloud.size(); ++i) {
    const Eigen::Vector3d p = ToTrueWorld(run().map.cloud.positions[i].cast<double>());
    OrientedBox around = desk->box;
    around.half_size.z() += 0.02;
    if (std::abs(p.z() - top) > 0.01 || !around.Contains(p)) continue;
    bool is_at_a_thing = false;
    for (const Instance& instance : clip().instances()) {
      OrientedBox wider = instance.box;
      wider.half_size.array() += 0.03;
      is_at_a_thing |= &instance != desk && wider.Contains(p);
    }
    if (is_at_a_thing) continue;
    ++num_points;
    if (run().map.semantics.object_of_point[i] != 0) ++num_in_objects;
  }
  RecordProperty("desk_points", num_points);
  RecordProperty("desk_points_in_objects", num_in_objects);
  ASSERT_GT(num_points, 1000) << "the test sees no desk";
  EXPECT_LE(num_in_objects, 0.02 * num_points);
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "semslam/base/random.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/features/frame.h"
#include "semslam/features/scale_space.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/place/vocabulary_training.h"

#include "place/random_descriptors.h"

namespace semslam::testing {

// A frame, and which point of the world each of its features shows.
struct SyntheticView {
  std::shared_ptr<const Frame> frame;
  std::vector<int> points;
  Rigid3 T_world_camera;  // The truth.
};

// A cloud of points with a descriptor each, and frames of it by exact geometry: what a tracker gets
// from images, without images. A test that uses it links semslam::place.
class SyntheticWorld {
 public:
  struct Options {
    int num_points = 3000;
    int num_flips = 6;        // Bits of each descriptor that differ from the point's own, at most.
    double pixel_noise = 0;   // Standard deviation, pixels of the feature's level.
    double depth_share = 1;   // Of the points that have depth; the same ones in every frame.
    double wrong_share = 0;   // Of the features, those that sit where their point is not.
    bool all_around = false;  // Points on all sides of the origin, instead of before it.
    std::uint64_t seed = 1;
  };

  static constexpr double kBaselineTimesFx = 40;  // px m.

  explicit SyntheticWorld(const Options& options)
      : options_(options),
        camera_({.width = 640, .height = 480, .fx = 520, .fy = 520, .cx = 319.5, .cy = 239.5}) {
    Random random(options.seed);
    for (int i = 0; i < options.num_points; ++i) {
      Point point;
      point.p_world = {random.Uniform(-3, 3), random.Uniform(-2.2, 2.2), random.Uniform(1.6, 3.2)};
      if (options.all_around) {
        const double angle = random.Uniform(0, 2 * std::numbers::pi);
        const double radius = random.Uniform(2.6, 3.6);
        point.p_world = {radius * std::sin(angle), random.Uniform(-2, 2), radius * std::cos(angle)};
      }
      // At this distance the point is found at the finest level.
      const double level = random.Uniform(0, 5);
      point.reference_distance = point.p_world.norm() * std::pow(ScaleSpace().scale_factor, level);
      point.has_depth = random.Uniform() < options.depth_share;
      point.angle = static_cast<float>(random.Uniform(0, 6.28));
      point.descriptor = RandomDescriptor(random);
      points_.push_back(point);
    }
  }

  const PinholeCamera& camera() const { return camera_; }
  const Eigen::Vector3d& p_world(int point) const { return points_[point].p_world; }
  std::size_t num_points() const { return points_.size(); }

  // A smooth path that starts at rest at the origin.
  static Rigid3 PathAt(double seconds) {
    const double t = seconds;
    const Eigen::Vector3d turn(0.05 * (1 - std::cos(0.9 * t)), 0.12 * (1 - std::cos(0.7 * t)),
                               0.04 * (1 - std::cos(1.3 * t)));
    return {ExpSO3(turn),
            {0.4 * (1 - std::cos(0.8 * t)), 0.15 * (1 - std::cos(1.1 * t)),
             0.2 * (1 - std::cos(0.6 * t))}};
  }

  // Frame `number` of a camera with 30 frames a second, at the given pose.
  SyntheticView Look(int number, const Rigid3& T_world_camera) const {
    return LookWith(number, T_world_camera, [&](const Eigen::Vector3d& p_world) {
      return Eigen::Vector3d(T_world_camera.Inverse() * p_world);
    });
  }
  SyntheticView LookAlongPath(int number) const { return Look(number, PathAt(number / 30.0)); }

  // The same through a rolling shutter on any path: the middle row is exposed at the frame's time.
  template <typename Path>  // Rigid3(double seconds).
  SyntheticView LookWhileRolling(int number, const Path& path, double readout_seconds) const {
    const double middle = number / 30.0;
    return LookWith(number, path(middle), [&](const Eigen::Vector3d& p_world) {
      Eigen::Vector3d p_camera = path(middle).Inverse() * p_world;
      for (int i = 0; i < 4 && p_camera.z() > 0.3; ++i) {  // Which row sees it depends on when.
        const double row = camera_.Project(p_camera).y() / camera_.height() - 0.5;
        p_camera = path(middle + row * readout_seconds).Inverse() * p_world;
      }
      return p_camera;
    });
  }

  static std::shared_ptr<const Frame> BlankFrame(int number) {
    auto frame = std::make_shared<Frame>();
    frame->time = number * (kNsPerSecond / 30);
    return frame;
  }

  // A small vocabulary in which this world's descriptors are words.
  std::shared_ptr<const Vocabulary> Train() const {
    std::vector<std::vector<Descriptor>> images;
    for (int i = 0; i < 4; ++i) images.push_back(LookAlongPath(25 * i).frame->descriptors);
    for (int i = 0; options_.all_around && i < 8; ++i) {
      const Rigid3 T_world_camera{ExpSO3({0, i * std::numbers::pi / 4, 0}),
                                  Eigen::Vector3d::Zero()};
      images.push_back(Look(i, T_world_camera).frame->descriptors);
    }
    const VocabularyTrainingOptions options{.branching = 8, .depth = 3, .max_iterations = 4};
    return std::make_shared<const Vocabulary>(TrainVocabulary(images, options, 1));
  }

 private:
  struct Point {
    Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
    double reference_distance = 0;
    bool has_depth = true;
    float angle = 0;
    Descriptor descriptor;
  };

  // `to_camera` takes a point from the world to the camera that sees it.
  template <typename ToCamera>
  SyntheticView LookWith(int number,
                         const Rigid3& T_world_camera,
                         const ToCamera& to_camera) const {
    SyntheticView view{nullptr, {}, T_world_camera};
    auto frame = std::make_shared<Frame>();
    frame->time = number * (kNsPerSecond / 30);
    Random random(options_.seed * 1000003 + static_cast<std::uint64_t>(number));
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d p_camera = to_camera(points_[i].p_world);
      if (p_camera.z() < 0.3) continue;
      Keypoint keypoint;
      if (!Show(points_[i], p_camera, random, &keypoint)) continue;
      frame->keypoints.push_back(keypoint);
      frame->descriptors.push_back(Disturb(points_[i].descriptor, options_.num_flips, random));
      view.points.push_back(static_cast<int>(i));
    }
    frame->grid = FeatureGrid(frame->keypoints, camera_.ideal_bounds());
    view.frame = std::move(frame);
    return view;
  }

  bool Show(const Point& point,
            const Eigen::Vector3d& p_camera,
            Random& random,
            Keypoint* keypoint) const {
    const ScaleSpace scale_space;
    const double level = std::log(point.reference_distance / p_camera.norm()) /
                         std::log(static_cast<double>(scale_space.scale_factor));
    const int octave = std::max(0, static_cast<int>(std::lround(level)));
    if (octave >= scale_space.num_levels) return false;
    const double noise = options_.pixel_noise * scale_space.PixelSize(octave);
    Eigen::Vector2d pixel = camera_.Project(p_camera);
    double depth = p_camera.z();
    if (options_.pixel_noise > 0) {
      pixel += noise * Eigen::Vector2d(random.Gaussian(), random.Gaussian());
    }
    if (options_.wrong_share > 0 && random.Uniform() < options_.wrong_share) {
      const double angle = random.Uniform(0, 6.28);
      pixel += random.Uniform(5, 14) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      depth *= random.Uniform(0.8, 1.2);
    }
    if (!(pixel.x() >= 0 && pixel.x() < camera_.width() - 1 && pixel.y() >= 0 &&
          pixel.y() < camera_.height() - 1)) {
      return false;
    }
    keypoint->pixel = pixel.cast<float>();
    keypoint->raw_pixel = keypoint->pixel;
    keypoint->octave = static_cast<std::int16_t>(octave);
    keypoint->angle = point.angle;
    keypoint->response = 50;
    if (point.has_depth) {
      keypoint->depth = static_cast<float>(depth);
      keypoint->right_x = static_cast<float>(pixel.x() - kBaselineTimesFx / depth + noise * 0.5);
    }
    return true;
  }

  Options options_;
  PinholeCamera camera_;
  std::vector<Point> points_;
};

}  // namespace semslam::testing

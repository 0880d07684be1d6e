// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "semslam/base/random.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/optim/bundle_adjuster.h"
#include "semslam/optim/pose_optimizer.h"

// Cameras that walk sideways past a cloud of points, with exact or noisy measurements: the ground
// truth of the tests and the load of the benchmarks of this module.
namespace semslam::testing {

inline StereoCamera TestCamera() {
  return {.fx = 517.3, .fy = 516.5, .cx = 318.6, .cy = 255.3, .bf = 40.0};
}

// The measurement a camera at the origin makes of a point in its frame.
inline ImagePoint Observe(const StereoCamera& camera,
                          const Eigen::Vector3d& p_camera,
                          bool with_depth) {
  ImagePoint image;
  image.pixel = {camera.fx * p_camera.x() / p_camera.z() + camera.cx,
                 camera.fy * p_camera.y() / p_camera.z() + camera.cy};
  if (with_depth) image.right_x = image.pixel.x() - camera.bf / p_camera.z();
  return image;
}

inline bool IsInImage(const ImagePoint& image) {
  return image.pixel.x() >= 0 && image.pixel.x() < 640 && image.pixel.y() >= 0 &&
         image.pixel.y() < 480;
}

inline Vector6d RandomTwist(double angle, double distance, Random* random) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = (i < 3 ? angle : distance) * random->Uniform(-1, 1);
  return twist;
}

struct Noise {
  double pixel = 0;         // Standard deviation at the finest pyramid level.
  double outliers = 0;      // Fraction of measurements that are somewhere in the image.
  double with_depth = 0.8;  // Fraction of measurements.
  bool pyramid = true;      // Variances of the levels of a pyramid instead of one pixel for all.
  std::uint64_t seed = 1;
};

// Disturbs an exact measurement; true if it became an outlier.
inline bool Disturb(const Noise& noise, Random* random, ImagePoint* image) {
  const double scale = noise.pyramid ? std::pow(1.2, random->Index(8)) : 1.0;
  image->inverse_variance = 1.0 / (scale * scale);
  const auto error = [&] { return noise.pixel * scale * random->Gaussian(); };
  const bool outlier = random->Uniform() < noise.outliers;
  if (outlier) image->pixel = {random->Uniform(0, 640), random->Uniform(0, 480)};
  image->pixel += Eigen::Vector2d(error(), error());
  if (image->has_right()) image->right_x += error();
  return outlier;
}

struct PoseScene {
  StereoCamera camera = TestCamera();
  Rigid3 T_world_camera;
  std::vector<PoseObservation> observations;
  std::vector<std::uint8_t> is_outlier;
};

inline PoseScene MakePoseScene(int num_observations, const Noise& noise) {
  Random random(noise.seed);
  PoseScene scene;
  scene.T_world_camera = Retract(Rigid3{}, RandomTwist(1.0, 2.0, &random));
  while (static_cast<int>(scene.observations.size()) < num_observations) {
    const double z = random.Uniform(0.5, 4.0);
    const Eigen::Vector3d p_camera(z * random.Uniform(-0.6, 0.6), z * random.Uniform(-0.45, 0.45),
                                   z);
    ImagePoint image = Observe(scene.camera, p_camera, random.Uniform() < noise.with_depth);
    if (!IsInImage(image)) continue;
    scene.is_outlier.push_back(Disturb(noise, &random, &image));
    scene.observations.push_back({scene.T_world_camera * p_camera, image});
  }
  return scene;
}

struct BundleScene {
  BundleProblem problem;  // At the ground truth.
  std::vector<std::uint8_t> is_outlier;
};

// The first `num_fixed` poses are fixed. The walk is as long as gives each point `track_length`
// observations or so.
inline BundleScene MakeBundleScene(
    int num_poses, int num_fixed, int num_points, double track_length, const Noise& noise) {
  Random random(noise.seed);
  BundleScene scene;
  BundleProblem& problem = scene.problem;
  problem.camera = TestCamera();
  const double step = 2.0 / track_length;  // A camera sees about 2 m of the wall.
  for (int i = 0; i < num_poses; ++i) {
    Vector6d twist = RandomTwist(0.05, 0.1, &random);
    twist[3] += step * i;
    problem.T_world_camera.push_back(Retract(Rigid3{}, twist));
    problem.pose_is_fixed.push_back(i < num_fixed);
  }
  for (int i = 0; i < num_points; ++i) {
    problem.p_world.emplace_back(random.Uniform(-1.0, step * num_poses + 1.0),
                                 random.Uniform(-0.8, 0.8), random.Uniform(1.5, 2.5));
  }
  for (int pose = 0; pose < num_poses; ++pose) {
    for (int point = 0; point < num_points; ++point) {
      const Eigen::Vector3d p_camera =
          problem.T_world_camera[pose].Inverse() * problem.p_world[point];
      ImagePoint image = Observe(problem.camera, p_camera, random.Uniform() < noise.with_depth);
      if (!IsInImage(image)) continue;
      scene.is_outlier.push_back(Disturb(noise, &random, &image));
      problem.observations.push_back({pose, point, image});
    }
  }
  return scene;
}

// Moves free poses and points away from where they are.
inline BundleProblem Disturbed(BundleProblem problem,
                               double angle,
                               double distance,
                               std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < problem.T_world_camera.size(); ++i) {
    const Vector6d twist = RandomTwist(angle, distance, &random);
    if (problem.pose_is_fixed[i]) continue;
    problem.T_world_camera[i] = Retract(problem.T_world_camera[i], twist);
  }
  for (Eigen::Vector3d& p_world : problem.p_world) {
    p_world += RandomTwist(0, distance, &random).tail<3>();
  }
  return problem;
}

}  // namespace semslam::testing

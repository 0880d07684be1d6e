// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/map/landmark_projection.h"

#include <algorithm>
#include <cmath>

namespace semslam {

std::optional<LandmarkProjection> ProjectLandmark(const ProjectionCamera& camera,
                                                  const Rigid3& T_world_camera,
                                                  const LandmarkAppearance& landmark) {
  constexpr float kMinViewCosine = 0.5F;  // 60 degrees.
  const Eigen::Vector3d view = landmark.p_world - T_world_camera.translation;
  const Eigen::Vector3d p_camera = T_world_camera.rotation.conjugate() * view;
  if (p_camera.z() <= 0) return std::nullopt;
  const Eigen::Vector2d pixel = camera.camera.Project(p_camera);
  if (!camera.camera.ideal_bounds().Contains(pixel)) return std::nullopt;
  const auto distance = static_cast<float>(view.norm());
  if (distance < 0.8F * landmark.min_distance || distance > 1.2F * landmark.max_distance) {
    return std::nullopt;
  }
  LandmarkProjection projection;
  projection.view_cosine = view.cast<float>().dot(landmark.view_direction) / distance;
  if (projection.view_cosine < kMinViewCosine) return std::nullopt;

  const float level =
      std::log(landmark.max_distance / distance) / std::log(camera.scale_space.scale_factor);
  const int octave =
      std::clamp(static_cast<int>(std::ceil(level)), 0, camera.scale_space.num_levels - 1);
  projection.point = {
      .pixel = pixel.cast<float>(),
      .right_x = static_cast<float>(pixel.x() - camera.baseline_times_fx / p_camera.z()),
      .radius = camera.scale_space.PixelSize(octave),
      .min_octave = std::max(0, octave - 1),
      .max_octave = octave,
      .descriptor = landmark.descriptor};
  return projection;
}

}  // namespace semslam

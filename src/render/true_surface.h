// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "semslam/render/clip.h"

namespace semslam {

// The surface that a clip's camera saw, as exact points. All vectors have the same length.
struct TrueSurface {
  std::vector<Eigen::Vector3f> positions;  // World, metres.
  std::vector<Eigen::Vector3f> normals;    // Of the face, towards the camera.
  std::vector<std::uint32_t> instances;    // Ids as in the label images.
};

inline constexpr double kTrueSurfaceSpacing = 0.005;  // Metres.

// Samples what the depth sensor could see in some frame, within its range and not at a grazing
// angle; of a clip with more than ten frames a second, about ten of them. Of every voxel of size
// `spacing` the point nearest to its centre, for each instance in it; ordered by voxel, so that the
// same clip gives the same bytes on any number of threads.
TrueSurface SampleTrueSurface(const RenderedClip& clip, double spacing = kTrueSurfaceSpacing);

// Writes the samples as a PCD file: XYZ, normal, label = instance. Throws InputError.
void WriteTrueSurface(const std::filesystem::path& path, const TrueSurface& surface);

}  // namespace semslam

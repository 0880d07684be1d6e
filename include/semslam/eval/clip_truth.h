// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/eval/surface_match.h"
#include "semslam/io/instances_io.h"
#include "semslam/io/trajectory_io.h"

namespace semslam {

// What is true of a rendered clip.
struct ClipTruth {
  Trajectory trajectory;
  std::vector<InstanceRecord> instances;  // By id.
  // Samples of the surface that the camera saw.
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> instance_of_sample;

  SurfaceSamples Surface() const { return {positions, normals, instance_of_sample}; }
};

// Reads groundtruth.txt, instances.json and surface.pcd of a folder that render_clip wrote. Throws
// InputError that names the file.
ClipTruth ReadClipTruth(const std::filesystem::path& folder);

// What geometry can tell apart: for the id of each instance the least id of those that form one
// region with it. A sheet thinner than `sheet_thickness` (a poster, a page) that lies flat on
// something is one region with it.
std::map<std::uint32_t, std::uint32_t> RegionOfInstance(const ClipTruth& truth,
                                                        double sheet_thickness = 0.005);

// The part of an instance that was seen.
struct SeenPart {
  std::size_t num_samples = 0;
  OrientedBox box;  // Around its samples, with the axes of the instance's own box.
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // Of the samples.
  // Along each axis of the box, the share of the whole instance's face there that the seen samples
  // cover when projected on it, in cells of 1 cm; here the largest of the three.
  double seen_share = 0;
};
SeenPart FindSeenPart(const ClipTruth& truth, const InstanceRecord& instance);

}  // namespace semslam

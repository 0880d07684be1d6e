// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/clip_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/io/cloud_io.h"

#include "eval/point_grid.h"

namespace semslam {
namespace {

std::set<std::uint32_t> IdsOf(const std::vector<InstanceRecord>& instances) {
  std::set<std::uint32_t> ids;
  for (const InstanceRecord& instance : instances) ids.insert(instance.id);
  return ids;
}

void ReadSurface(const std::filesystem::path& path, ClipTruth& truth) {
  CloudColumns cloud = ReadPcd(path);
  if (cloud.positions.empty()) throw InputError(path.string() + ": expected points, found none");
  if (cloud.normals.empty() || cloud.labels.empty()) {
    throw InputError(path.string() +
                     ": expected the fields normal_x, normal_y, normal_z and label");
  }
  const std::set<std::uint32_t> ids = IdsOf(truth.instances);
  for (const std::uint32_t label : cloud.labels) {
    if (!ids.contains(label)) {
      throw InputError(path.string() + ": expected labels that are ids in instances.json, found " +
                       std::to_string(label));
    }
  }
  truth.positions = std::move(cloud.positions);
  truth.normals = std::move(cloud.normals);
  truth.instance_of_sample = std::move(cloud.labels);
}

// How many samples of each sheet lie flat on each other instance.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> CountContacts(
    const ClipTruth& truth, const std::set<std::uint32_t>& sheets, double sheet_thickness) {
  constexpr double kReach = 0.01;  // Metres along the surface: a sheet hides what it lies on.
  constexpr float kParallel = 0.95F;
  const PointGrid grid(truth.positions, kReach);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> contacts;
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    const std::uint32_t sheet = truth.instance_of_sample[i];
    if (!sheets.contains(sheet)) continue;
    grid.Any(truth.positions[i].cast<double>(), kReach, [&](std::uint32_t other) {
      const Eigen::Vector3f offset = truth.positions[other] - truth.positions[i];
      const bool lies_flat =
          truth.normals[i].dot(truth.normals[other]) > kParallel &&
          std::abs(truth.normals[i].dot(offset)) <= static_cast<float>(sheet_thickness);
      const std::uint32_t instance = truth.instance_of_sample[other];
      if (instance != sheet && lies_flat) ++contacts[{sheet, instance}];
      return false;
    });
  }
  return contacts;
}

}  // namespace

ClipTruth ReadClipTruth(const std::filesystem::path& folder) {
  ClipTruth truth;
  truth.trajectory = ReadTrajectory(folder / "groundtruth.txt");
  truth.instances = ReadInstances(folder / "instances.json");
  ReadSurface(folder / "surface.pcd", truth);
  return truth;
}

std::map<std::uint32_t, std::uint32_t> RegionOfInstance(const ClipTruth& truth,
                                                        double sheet_thickness) {
  std::map<std::uint32_t, std::uint32_t> region;
  std::set<std::uint32_t> sheets;
  for (const InstanceRecord& instance : truth.instances) {
    region[instance.id] = instance.id;
    if (2.0 * instance.box.half_size.minCoeff() < sheet_thickness) sheets.insert(instance.id);
  }
  std::map<std::uint32_t, std::pair<int, std::uint32_t>>
      support;  // Of a sheet: contacts, instance.
  for (const auto& [pair, count] : CountContacts(truth, sheets, sheet_thickness)) {
    auto& best = support[pair.first];
    if (count > best.first) best = {count, pair.second};
  }
  for (const auto& [sheet, best] : support) {
    const std::uint32_t a = region[sheet];
    const std::uint32_t b = region[best.second];
    for (auto& [id, root] : region) {
      if (root == a || root == b) root = std::min(a, b);
    }
  }
  return region;
}

SeenPart FindSeenPart(const ClipTruth& truth, const InstanceRecord& instance) {
  constexpr double kCell = 0.01;  // Metres.
  const Rigid3 T_box_world = instance.box.T_world_box.Inverse();
  SeenPart part;
  Eigen::AlignedBox3d extent;
  std::array<std::set<std::pair<int, int>>, 3> covered;  // Cells of the face across each axis.
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    if (truth.instance_of_sample[i] != instance.id) continue;
    const Eigen::Vector3d p_world = truth.positions[i].cast<double>();
    const Eigen::Vector3d p_box = T_box_world * p_world;
    part.centroid += p_world;
    ++part.num_samples;
    extent.extend(p_box);
    const Eigen::Vector3i cell =
        ((p_box + instance.box.half_size) / kCell).array().floor().cast<int>();
    for (int axis = 0; axis < 3; ++axis) {
      covered[static_cast<std::size_t>(axis)].emplace(cell[(axis + 1) % 3], cell[(axis + 2) % 3]);
    }
  }
  if (part.num_samples == 0) return part;
  part.centroid /= static_cast<double>(part.num_samples);
  part.box.T_world_box =
      instance.box.T_world_box * Rigid3{Eigen::Quaterniond::Identity(), extent.center()};
  part.box.half_size = 0.5 * extent.sizes();
  for (int axis = 0; axis < 3; ++axis) {
    const double num_cells = std::ceil(2.0 * instance.box.half_size[(axis + 1) % 3] / kCell) *
                             std::ceil(2.0 * instance.box.half_size[(axis + 2) % 3] / kCell);
    const auto num_covered = static_cast<double>(covered[static_cast<std::size_t>(axis)].size());
    if (num_cells > 0) {
      part.seen_share = std::max(part.seen_share, std::min(1.0, num_covered / num_cells));
    }
  }
  return part;
}

}  // namespace semslam

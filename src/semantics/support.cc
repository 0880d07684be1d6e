// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/support.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>

#include "semslam/dense/up_direction.h"

#include "semantics/evenly_chosen.h"
#include "semantics/round_footprint.h"

namespace semslam {
namespace {

constexpr double kLevel = 0.966;   // Cosine of 15 degrees between a level plane's normal and up.
constexpr double kLayer = 0.02;    // Metres above the lowest point that stand on something.
constexpr double kMaxSink = 0.01;  // Metres by which noise puts points below what carries them.
constexpr double kReach = 0.03;    // Metres from a low point to its support, sideways and down.
constexpr double kTrimmed = 0.02;  // Share of a thing's points that may be outliers below it.

// The height that all but a few points are above.
double LowestHeight(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& up) {
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const Eigen::Vector3d& point : points) heights.push_back(up.dot(point));
  const auto low =
      heights.begin() + static_cast<std::ptrdiff_t>(kTrimmed * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), low, heights.end());
  return *low;
}

// Those that are not higher, evenly chosen if they are many.
std::vector<Eigen::Vector3d> LowPoints(std::span<const Eigen::Vector3d> points,
                                       const Eigen::Vector3d& up,
                                       double highest) {
  constexpr std::size_t kMaxPoints = 300;
  std::vector<Eigen::Vector3d> low;
  std::copy_if(points.begin(), points.end(), std::back_inserter(low),
               [&](const Eigen::Vector3d& point) { return up.dot(point) <= highest; });
  return EvenlyChosen(low, kMaxPoints);
}

}  // namespace

SupportFinder::SupportFinder(const MapCloud& cloud,
                             const VoxelIndex& index,
                             const Segmentation& segmentation)
    : index_(index), segmentation_(segmentation) {
  const auto up = CommonUpNormal(cloud.normals, -Eigen::Vector3f::UnitY());
  if (up) up_ = up->cast<double>();
}

SegmentId SupportFinder::FindSupport(std::span<const Eigen::Vector3d> points,
                                     std::span<const SegmentId> own) const {
  if (!up_ || points.empty()) return 0;
  const double highest = LowestHeight(points, *up_) + kLayer;
  const std::vector<Eigen::Vector3d> offsets = OffsetsToSupport();
  VoxelIndex::Finder finder(index_);
  std::map<SegmentId, std::size_t> num_touched;
  for (const Eigen::Vector3d& point : LowPoints(points, *up_, highest)) {
    std::vector<SegmentId> touched;  // By this point; each counts once.
    for (const Eigen::Vector3d& offset : offsets) {
      const auto found = finder.Find(point + offset);
      if (!found) continue;
      const SegmentId segment = segmentation_.segment_of_point[*found];
      if (segment != 0 && !std::binary_search(own.begin(), own.end(), segment)) {
        touched.push_back(segment);
      }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const SegmentId segment : touched) ++num_touched[segment];
  }
  SegmentId support = 0;
  for (const auto& [segment, count] : num_touched) {
    if (support == 0 || count > num_touched[support]) support = segment;
  }
  return support;
}

// Every lookup finds what lies within one voxel around.
std::vector<Eigen::Vector3d> SupportFinder::OffsetsToSupport() const {
  const double step = 3 * segmentation_.voxel_size;
  const int reach = static_cast<int>(std::ceil((kReach - segmentation_.voxel_size) / step));
  const Eigen::Vector3d side = up_->unitOrthogonal();
  const Eigen::Vector3d other = up_->cross(side);
  std::vector<Eigen::Vector3d> offsets;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int down = 0; down <= reach; ++down) {
        offsets.emplace_back(step * (x * side + y * other - down * *up_));
      }
    }
  }
  return offsets;
}

std::optional<Plane> SupportFinder::LevelPlaneOf(SegmentId segment) const {
  if (segment == 0 || !up_) return std::nullopt;
  const std::optional<Plane>& plane = segmentation_.segments[segment - 1].plane;
  if (!plane || std::abs(plane->normal.dot(*up_)) < kLevel) return std::nullopt;
  return plane->normal.dot(*up_) < 0 ? plane->Flipped() : *plane;
}

OrientedBox SupportFinder::FitBox(std::span<const Eigen::Vector3d> points,
                                  SegmentId support) const {
  if (!up_) return FitOrientedBox(points);
  const std::optional<Plane> plane = LevelPlaneOf(support);
  const Eigen::Vector3d& up = plane ? plane->normal : *up_;
  OrientedBox box = FitUprightBox(WithUnseenBack(points, up), up);
  if (!plane) return box;
  const Eigen::Vector3d center = box.T_world_box.translation;
  const double height = plane->SignedDistance(center);
  const double bottom = height - box.half_size.z();
  if (std::abs(bottom) > kReach + kMaxSink || height <= 0) return box;
  // What is seen of a thing ends a little above its support, where the segments meet.
  const double shift = 0.5 * bottom;
  box.half_size.z() += shift;
  box.T_world_box.translation = center - shift * plane->normal;
  return box;
}

}  // namespace semslam

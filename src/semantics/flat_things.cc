// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/flat_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "semslam/base/random.h"
#include "semslam/dense/voxel_index.h"
#include "semslam/geometry/plane.h"

#include "semantics/evenly_chosen.h"
#include "semantics/keyframe_view.h"
#include "semantics/segment_parts.h"

namespace semslam {
namespace {

constexpr float kCellSize = 0.02F;             // Metres; votes are counted by cells of that size.
constexpr std::uint32_t kMinVotes = 3;         // Keyframes whose box holds a cell.
constexpr std::uint32_t kMinVotesInReach = 2;  // One box alone may be wrong.
constexpr double kMinShareOfVotesInReach = 0.25;
constexpr double kMinShareOfVotes = 0.5;   // Of the most voted cell of the same thing.
constexpr double kMinHeight = 0.006;       // Metres above the surface around,
constexpr double kMinHeightInNoise = 2.5;  // and in median deviations of that.
constexpr std::size_t kMinPoints = 30;     // Of a thing,
constexpr double kMinRaised = 0.25;        // and as a share of the points in its place.

using Cell = std::array<int, 3>;
using Votes = std::map<Cell, std::uint32_t>;

Cell CellOf(const Eigen::Vector3f& p) {
  return {static_cast<int>(std::floor(p.x() / kCellSize)),
          static_cast<int>(std::floor(p.y() / kCellSize)),
          static_cast<int>(std::floor(p.z() / kCellSize))};
}

template <typename Visit>
void ForEachNeighbour(const Cell& cell, const Visit& visit) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) visit(Cell{cell[0] + x, cell[1] + y, cell[2] + z});
    }
  }
}

// The cells in which a keyframe sees the segment inside a box.
std::set<Cell> CellsInBox(SegmentId segment,
                          const CellRange& box,
                          const SegmentImage& image,
                          const MapCloud& cloud) {
  std::set<Cell> cells;
  for (int row = box.first_row; row < box.last_row; ++row) {
    for (int column = box.first_column; column < box.last_column; ++column) {
      const std::size_t pixel = image.Cell(column, row);
      if (image.segments[pixel] != segment) continue;
      cells.insert(CellOf(cloud.positions[image.points[pixel]]));
    }
  }
  return cells;
}

std::map<SegmentAndClass, Votes> CountVotes(const MapCloud& cloud,
                                            const Segmentation& segmentation,
                                            std::span<const SeenKeyframe> keyframes,
                                            const std::set<SegmentAndClass>& subjects) {
  std::map<SegmentAndClass, Votes> votes;
  for (const SeenKeyframe& keyframe : keyframes) {
    if (keyframe.detections.empty()) continue;
    const KeyframeView view = DrawSegments(keyframe, segmentation);
    for (const Detection& detection : keyframe.detections) {
      const CellRange box = CellRange::Of(detection.box, keyframe.cloud->stride(),
                                          view.image.columns, view.image.rows);
      const SegmentAndClass subject(FindFilling(view.image, box), detection.class_id);
      if (!subjects.contains(subject)) continue;
      for (const Cell& cell : CellsInBox(subject.first, box, view.image, cloud))
        ++votes[subject][cell];
    }
  }
  return votes;
}

// The cells that can be reached from `start` by steps that `may_step` allows.
template <typename MayStep>
std::set<Cell> Flood(const Cell& start, const Votes& votes, const MayStep& may_step) {
  std::set<Cell> reached = {start};
  std::vector<Cell> open = {start};
  while (!open.empty()) {
    const auto from = votes.find(open.back());
    open.pop_back();
    ForEachNeighbour(from->first, [&](const Cell& next) {
      const auto to = votes.find(next);
      if (to == votes.end() || !may_step(from->second, to->second)) return;
      if (reached.insert(next).second) open.push_back(next);
    });
  }
  return reached;
}

// Where a thing lies.
struct Place {
  std::set<Cell> core;   // Cells that most of its boxes hold,
  std::set<Cell> reach;  // and all that some do: downhill from the core.
};

// The place around the most voted cell; and removes its votes. Nothing if no cell has enough.
std::optional<Place> TakePlace(Votes* votes) {
  const auto best =
      std::max_element(votes->begin(), votes->end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (best == votes->end() || best->second < kMinVotes) return std::nullopt;
  const double min_votes =
      std::max<double>(kMinVotes, kMinShareOfVotes * static_cast<double>(best->second));
  const double min_reach = std::max<double>(
      kMinVotesInReach, kMinShareOfVotesInReach * static_cast<double>(best->second));
  Place place;
  place.core =
      Flood(best->first, *votes, [&](std::uint32_t, std::uint32_t to) { return to >= min_votes; });
  place.reach = Flood(best->first, *votes, [&](std::uint32_t from, std::uint32_t to) {
    return to >= min_reach && (to <= from || to >= min_votes);
  });
  const std::set<Cell> slope =
      Flood(best->first, *votes,
            [&](std::uint32_t from, std::uint32_t to) { return to <= from || to >= min_votes; });
  for (const Cell& cell : slope) votes->erase(cell);
  return place;
}

// The plane that most of the points lie near: what is around a thing, whatever else lies there.
std::optional<Plane> FindSurface(const std::vector<Eigen::Vector3f>& around,
                                 const Eigen::Vector3d& towards_viewer) {
  constexpr double kTolerance = 0.004;
  constexpr int kNumTrials = 200;
  constexpr double kMinTriangle = 1e-4;  // Square metres.
  Random random(1);
  std::optional<Plane> best;
  std::size_t most = 0;
  const auto size = static_cast<std::uint32_t>(around.size());
  for (int trial = 0; trial < kNumTrials && size >= kMinPoints; ++trial) {
    const Eigen::Vector3d a = around[random.Index(size)].cast<double>();
    const Eigen::Vector3d b = around[random.Index(size)].cast<double>();
    const Eigen::Vector3d c = around[random.Index(size)].cast<double>();
    Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.norm() < kMinTriangle) continue;
    normal.normalize();
    if (normal.dot(towards_viewer) < 0) normal = -normal;
    const Plane plane{normal, -normal.dot(a)};
    const auto num_near = static_cast<std::size_t>(
        std::count_if(around.begin(), around.end(), [&](const Eigen::Vector3f& p) {
          return std::abs(plane.SignedDistance(p.cast<double>())) <= kTolerance;
        }));
    if (num_near <= most) continue;
    most = num_near;
    best = plane;
  }
  return best;
}

// Of the points that may be the surface's.
double MedianDeviation(const std::vector<Eigen::Vector3f>& points, const Plane& plane) {
  constexpr double kFar = 0.008;  // Metres.
  std::vector<double> deviations;
  for (const Eigen::Vector3f& p : points) {
    const double deviation = std::abs(plane.SignedDistance(p.cast<double>()));
    if (deviation <= kFar) deviations.push_back(deviation);
  }
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle;
}

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    return VoxelKey::Hash(VoxelKey::Pack({cell[0], cell[1], cell[2]}));
  }
};

// One segment's points by cell; never visited in the table's order.
using Contents = std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash>;

Contents ContentsOf(SegmentId segment, const MapCloud& cloud, const Segmentation& segmentation) {
  Contents contents;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (segmentation.segment_of_point[i] != segment) continue;
    contents[CellOf(cloud.positions[i])].push_back(static_cast<std::uint32_t>(i));
  }
  return contents;
}

// `points`: ascending.
void TakeOut(const std::vector<std::uint32_t>& points, const MapCloud& cloud, Contents* contents) {
  std::set<Cell> cells;
  for (const std::uint32_t point : points) cells.insert(CellOf(cloud.positions[point]));
  for (const Cell& cell : cells) {
    const auto content = contents->find(cell);
    std::erase_if(content->second, [&](std::uint32_t point) {
      return std::binary_search(points.begin(), points.end(), point);
    });
    if (content->second.empty()) contents->erase(content);
  }
}

std::vector<std::uint32_t> PointsIn(const std::set<Cell>& cells, const Contents& contents) {
  std::vector<std::uint32_t> points;
  for (const Cell& cell : cells) {
    const auto found = contents.find(cell);
    if (found == contents.end()) continue;
    points.insert(points.end(), found->second.begin(), found->second.end());
  }
  return points;
}

// Cells of the segment within `reach` cells of a place, without the place itself.
std::set<Cell> CellsAround(const std::set<Cell>& place, const Contents& contents, int reach) {
  std::set<Cell> all = place;
  std::vector<Cell> border(place.begin(), place.end());
  std::set<Cell> around;
  for (int step = 0; step < reach; ++step) {
    std::vector<Cell> next_border;
    for (const Cell& cell : border) {
      ForEachNeighbour(cell, [&](const Cell& next) {
        if (!contents.contains(next) || !all.insert(next).second) return;
        around.insert(next);
        next_border.push_back(next);
      });
    }
    border = std::move(next_border);
  }
  return around;
}

// All points of the cells that are raised, as they and the cells around them tell, so that noise
// neither tears holes nor leaves crumbs. Ascending.
template <typename IsRaised>
std::vector<std::uint32_t> PointsOfRaisedCells(const std::set<Cell>& cells,
                                               const Contents& contents,
                                               const IsRaised& is_raised) {
  const auto share_of = [&](const std::set<Cell>& some) {
    const std::vector<std::uint32_t> points = PointsIn(some, contents);
    return points.empty()
               ? 0.0
               : static_cast<double>(std::count_if(points.begin(), points.end(), is_raised)) /
                     static_cast<double>(points.size());
  };
  std::set<Cell> raised;
  for (const Cell& cell : cells) {
    std::set<Cell> neighbourhood;
    ForEachNeighbour(cell, [&](const Cell& next) { neighbourhood.insert(next); });
    if (share_of({cell}) + share_of(neighbourhood) >= 1.0) raised.insert(cell);
  }
  std::vector<std::uint32_t> points = PointsIn(raised, contents);
  std::sort(points.begin(), points.end());
  return points;
}

// The points of a place that rise above the surface around it; none if they are too few to be a
// thing.
std::vector<std::uint32_t> FindThing(const Place& place,
                                     const Contents& contents,
                                     const MapCloud& cloud) {
  constexpr int kReachOfSurface = 5;  // Cells around a place.
  constexpr std::size_t kMaxPointsOfSurface = 2000;
  const std::vector<std::uint32_t> inside = PointsIn(place.core, contents);
  std::vector<Eigen::Vector3f> around;
  for (const std::uint32_t point :
       PointsIn(CellsAround(place.core, contents, kReachOfSurface), contents))
    around.push_back(cloud.positions[point]);
  Eigen::Vector3d towards_viewer = Eigen::Vector3d::Zero();
  for (const std::uint32_t point : inside) towards_viewer += cloud.normals[point].cast<double>();
  const std::optional<Plane> surface =
      FindSurface(EvenlyChosen(around, kMaxPointsOfSurface), towards_viewer);
  if (!surface) return {};
  const double min_height =
      std::max(kMinHeight, kMinHeightInNoise * MedianDeviation(around, *surface));
  const auto is_raised = [&](std::uint32_t point) {
    return surface->SignedDistance(cloud.positions[point].cast<double>()) >= min_height;
  };
  const auto num_raised = std::count_if(inside.begin(), inside.end(), is_raised);
  if (num_raised < static_cast<std::ptrdiff_t>(kMinPoints) ||
      static_cast<double>(num_raised) < kMinRaised * static_cast<double>(inside.size()))
    return {};
  return PointsOfRaisedCells(place.reach, contents, is_raised);
}

}  // namespace

std::optional<Segmentation> TakeOutFlatThings(const MapCloud& cloud,
                                              const Segmentation& segmentation,
                                              std::span<const SeenKeyframe> keyframes,
                                              const Evidence& evidence,
                                              const ClassTable& classes) {
  std::set<SegmentAndClass> subjects;
  for (const auto& [subject, num_boxes] : evidence.num_filled_boxes) {
    if (num_boxes >= kMinVotes && classes.is_of_interest(subject.second)) subjects.insert(subject);
  }
  if (subjects.empty()) return std::nullopt;
  std::optional<Segmentation> result;
  std::map<SegmentId, Contents> contents_of;
  for (auto& [subject, votes] : CountVotes(cloud, segmentation, keyframes, subjects)) {
    const auto [entry, is_new] = contents_of.try_emplace(subject.first);
    Contents& contents = entry->second;
    if (is_new) contents = ContentsOf(subject.first, cloud, segmentation);
    while (const std::optional<Place> place = TakePlace(&votes)) {
      const std::vector<std::uint32_t> thing = FindThing(*place, contents, cloud);
      if (thing.size() < kMinPoints) continue;
      if (!result) result = segmentation;
      MakeSegment(thing, subject.first, cloud, &*result);
      TakeOut(thing, cloud, &contents);
    }
  }
  return result;
}

}  // namespace semslam

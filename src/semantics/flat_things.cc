// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/flat_things.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "semslam/base/random.h"
#include "semslam/geometry/plane.h"

#include "semantics/cell_votes.h"
#include "semantics/evenly_chosen.h"
#include "semantics/keyframe_view.h"
#include "semantics/segment_cells.h"
#include "semantics/segment_parts.h"
#include "semantics/segment_points.h"

namespace semslam {
namespace {

constexpr double kMinHeight = 0.006;       // Metres above the surface around,
constexpr double kMinHeightInNoise = 2.5;  // and in median deviations of that.
constexpr std::size_t kMinPoints = 30;     // Of a thing,
constexpr double kMinRaised = 0.25;        // and as a share of the points in its place.

// The cells in which a keyframe sees the segment inside a box; many of them several times.
std::vector<Cell> CellsInBox(SegmentId segment,
                             const ImageBox& box,
                             const SeenKeyframe& keyframe,
                             const MapCloud& cloud,
                             const Segmentation& segmentation) {
  const int columns = keyframe.cloud->grid_columns();
  const CellRange range =
      CellRange::Of(box, keyframe.cloud->stride(), columns, keyframe.cloud->grid_rows());
  std::vector<Cell> cells;
  for (int row = range.first_row; row < range.last_row; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * columns;
    for (int column = range.first_column; column < range.last_column; ++column) {
      const std::uint32_t point = keyframe.points[first + column];
      if (point == kNoPoint || segmentation.segment_of_point[point] != segment) continue;
      const Cell cell = CellOf(cloud.positions[point]);
      if (cells.empty() || cells.back() != cell) cells.push_back(cell);
    }
  }
  return cells;
}

CellVotes CountVotes(SegmentId segment,
                     std::span<const BoxPlace> boxes,
                     const MapCloud& cloud,
                     const Segmentation& segmentation,
                     std::span<const SeenKeyframe> keyframes) {
  CellVotes votes;
  for (const BoxPlace& place : boxes) {
    const SeenKeyframe& keyframe = keyframes[place.keyframe];
    const ImageBox& box = keyframe.detections[place.detection].box;
    votes.AddBox(CellsInBox(segment, box, keyframe, cloud, segmentation));
  }
  return votes;
}

// How many points lie near the plane; 0 as soon as it is clear that they are not more than `most`.
std::size_t CountNear(std::span<const Eigen::Vector3d> points,
                      const Plane& plane,
                      std::size_t most) {
  constexpr double kTolerance = 0.004;
  constexpr std::size_t kAtOnce = 64;
  std::size_t count = 0;
  while (!points.empty()) {
    if (count + points.size() <= most) return 0;
    const auto some = points.first(std::min(kAtOnce, points.size()));
    for (const Eigen::Vector3d& p : some) {
      count += std::abs(plane.SignedDistance(p)) <= kTolerance ? 1 : 0;
    }
    points = points.subspan(some.size());
  }
  return count;
}

// The plane that most of the points lie near: what is around a thing, whatever else lies there.
std::optional<Plane> FindSurface(const std::vector<Eigen::Vector3d>& around,
                                 const Eigen::Vector3d& towards_viewer) {
  constexpr int kNumTrials = 200;
  constexpr double kMinTriangle = 1e-4;  // Square metres.
  Random random(1);
  std::optional<Plane> best;
  std::size_t most = 0;
  const auto size = static_cast<std::uint32_t>(around.size());
  for (int trial = 0; trial < kNumTrials && size >= kMinPoints; ++trial) {
    const Eigen::Vector3d& a = around[random.Index(size)];
    const Eigen::Vector3d& b = around[random.Index(size)];
    const Eigen::Vector3d& c = around[random.Index(size)];
    Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.norm() < kMinTriangle) continue;
    normal.normalize();
    if (normal.dot(towards_viewer) < 0) normal = -normal;
    const Plane plane{normal, -normal.dot(a)};
    const std::size_t num_near = CountNear(around, plane, most);
    if (num_near <= most) continue;
    most = num_near;
    best = plane;
  }
  return best;
}

// Of the points that may be the surface's.
double MedianDeviation(const std::vector<Eigen::Vector3d>& points, const Plane& plane) {
  constexpr double kFar = 0.008;  // Metres.
  std::vector<double> deviations;
  for (const Eigen::Vector3d& p : points) {
    const double deviation = std::abs(plane.SignedDistance(p));
    if (deviation <= kFar) deviations.push_back(deviation);
  }
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle;
}

// Cells of the segment within `reach` cells of a place, without the place itself. Ascending.
std::vector<Cell> CellsAround(const std::vector<Cell>& place,
                              const SegmentCells& contents,
                              int reach) {
  std::vector<bool> is_known(contents.size(), false);
  for (const Cell cell : place) {
    const std::uint32_t number = contents.NumberOf(cell);
    if (number != KeyNumbers::kNone) is_known[number] = true;
  }
  std::vector<Cell> border = place;
  std::vector<Cell> around;
  for (int step = 0; step < reach; ++step) {
    std::vector<Cell> next_border;
    for (const Cell cell : border) {
      ForEachNeighbour(cell, [&](Cell next) {
        const std::uint32_t number = contents.NumberOf(next);
        if (number == KeyNumbers::kNone || is_known[number]) return;
        is_known[number] = true;
        next_border.push_back(next);
      });
    }
    around.insert(around.end(), next_border.begin(), next_border.end());
    border = std::move(next_border);
  }
  std::sort(around.begin(), around.end());
  return around;
}

// How many points of a cell, or of some, are raised.
struct Raised {
  std::size_t num_raised = 0;
  std::size_t num_points = 0;

  double Share() const {
    return num_points == 0 ? 0.0
                           : static_cast<double>(num_raised) / static_cast<double>(num_points);
  }
};

// The cells that are raised, as they and the cells around them tell, so that noise neither tears
// holes nor leaves crumbs.
template <typename IsRaised>
std::vector<Cell> FindRaisedCells(const std::vector<Cell>& cells,
                                  const SegmentCells& contents,
                                  const IsRaised& is_raised) {
  std::vector<std::optional<Raised>> counted(contents.size());
  const auto count = [&](std::uint32_t number) {
    std::optional<Raised>& own = counted[number];
    if (!own) {
      const std::span<const std::uint32_t> points = contents.PointsAt(number);
      const auto num_raised = std::count_if(points.begin(), points.end(), is_raised);
      own = {static_cast<std::size_t>(num_raised), points.size()};
    }
    return *own;
  };
  std::vector<Cell> raised;
  for (const Cell cell : cells) {
    const std::uint32_t number = contents.NumberOf(cell);
    if (number == KeyNumbers::kNone) continue;
    Raised neighbourhood;
    ForEachNeighbour(cell, [&](Cell next) {
      const std::uint32_t neighbour = contents.NumberOf(next);
      if (neighbour == KeyNumbers::kNone) return;
      neighbourhood.num_raised += count(neighbour).num_raised;
      neighbourhood.num_points += count(neighbour).num_points;
    });
    if (count(number).Share() + neighbourhood.Share() >= 1.0) raised.push_back(cell);
  }
  return raised;
}

// The cells of a place that rise above the surface around it; none if they are too few to be a
// thing.
std::vector<Cell> FindThing(const Place& place,
                            const SegmentCells& contents,
                            const MapCloud& cloud) {
  constexpr int kReachOfSurface = 5;  // Cells around a place.
  constexpr std::size_t kMaxPointsOfSurface = 2000;
  const std::vector<std::uint32_t> inside = contents.PointsIn(place.core);
  if (inside.size() < kMinPoints) return {};
  const std::vector<Eigen::Vector3d> around =
      PositionsOf(contents.PointsIn(CellsAround(place.core, contents, kReachOfSurface)), cloud);
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
  return FindRaisedCells(place.reach, contents, is_raised);
}

// Takes the things that boxes of one class tell out of a segment's contents. Adds the points of
// each, ascending.
void TakeThings(CellVotes votes,
                const MapCloud& cloud,
                SegmentCells* contents,
                std::vector<std::vector<std::uint32_t>>* things) {
  while (const std::optional<Place> place = votes.TakePlace()) {
    const std::vector<Cell> cells = FindThing(*place, *contents, cloud);
    std::vector<std::uint32_t> thing = contents->PointsIn(cells);
    if (thing.size() < kMinPoints) continue;
    std::sort(thing.begin(), thing.end());
    things->push_back(std::move(thing));
    contents->TakeOut(cells);
  }
}

// For each segment the boxes of every class that enough of them filled with it.
using BoxesByClass = std::vector<std::span<const BoxPlace>>;
std::map<SegmentId, BoxesByClass> FindSubjects(const Evidence& evidence,
                                               const ClassTable& classes) {
  std::map<SegmentId, BoxesByClass> subjects;
  for (const auto& [subject, boxes] : evidence.filled_boxes) {
    const auto& [segment, class_id] = subject;
    if (boxes.size() >= kMinVotes && classes.is_of_interest(class_id)) {
      subjects[segment].push_back(boxes);
    }
  }
  return subjects;
}

}  // namespace

std::optional<Segmentation> TakeOutFlatThings(const MapCloud& cloud,
                                              const Segmentation& segmentation,
                                              std::span<const SeenKeyframe> keyframes,
                                              const Evidence& evidence,
                                              const ClassTable& classes) {
  std::optional<Segmentation> result;
  for (const auto& [segment, boxes_by_class] : FindSubjects(evidence, classes)) {
    SegmentCells contents(segment, cloud, segmentation);
    std::vector<std::vector<std::uint32_t>> things;
    for (const std::span<const BoxPlace> boxes : boxes_by_class) {
      TakeThings(CountVotes(segment, boxes, cloud, segmentation, keyframes), cloud, &contents,
                 &things);
    }
    if (things.empty()) continue;
    if (!result) result = segmentation;
    MakeSegments(things, segment, cloud, &*result);
  }
  return result;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/label_score.h"

#include <algorithm>
#include <limits>
#include <map>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

#include "eval/point_grid.h"

namespace semslam {
namespace {

using Points = std::vector<Eigen::Vector3f>;

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(part) / static_cast<double>(whole);
}

// The first point of each voxel: at a reach of many voxels the others make no difference.
Points ThinnedOut(const Points& points, double voxel_size) {
  std::map<std::uint64_t, Eigen::Vector3f> first;
  for (const Eigen::Vector3f& point : points) {
    const auto voxel = VoxelKey::Coordinates(point.cast<double>(), voxel_size);
    if (voxel) first.emplace(VoxelKey::Pack(*voxel), point);
  }
  Points thin;
  for (const auto& [key, point] : first) thin.push_back(point);
  return thin;
}

// Tells whether a place is within reach of some points.
class Neighbourhood {
 public:
  Neighbourhood(const Points& points, double reach)
      : reach_(reach),
        thin_(ThinnedOut(points, reach / 15)),
        coarse_(thin_, reach),
        fine_(thin_, 0.5 * reach) {}

  bool Holds(const Eigen::Vector3f& point) const {
    const Eigen::Vector3d p = point.cast<double>();
    return coarse_.HasCellWithin(p, reach_) &&
           fine_.Any(p, reach_, [](std::uint32_t) { return true; });
  }

 private:
  double reach_;
  Points thin_;
  PointGrid coarse_;  // Most places are far from everything, and this tells it fast.
  PointGrid fine_;
};

std::map<std::uint32_t, Neighbourhood> NeighbourhoodOfClass(std::span<const Eigen::Vector3f> points,
                                                            std::span<const std::uint32_t> classes,
                                                            double reach) {
  std::map<std::uint32_t, Points> points_of_class;
  for (std::size_t i = 0; i < points.size(); ++i) points_of_class[classes[i]].push_back(points[i]);
  std::map<std::uint32_t, Neighbourhood> neighbourhoods;
  for (const auto& [class_number, members] : points_of_class) {
    neighbourhoods.try_emplace(class_number, members, reach);
  }
  return neighbourhoods;
}

}  // namespace

double ClassScore::Precision() const { return Share(num_right, num_found); }
double ClassScore::Recall() const { return Share(num_right, num_true); }
double ClassScore::IntersectionOverUnion() const {
  return Share(num_right, num_true + num_found - num_right);
}

double LabelScore::Accuracy() const { return Share(num_right, num_points); }
double LabelScore::ObjectAccuracy() const { return Share(num_object_right, num_object_points); }

double LabelScore::MeanIntersectionOverUnion() const {
  double sum = 0;
  std::size_t count = 0;
  for (const ClassScore& score : classes) {
    if (score.num_true + score.num_found == 0) continue;
    sum += score.IntersectionOverUnion();
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

LabelScore ScoreLabels(std::span<const std::uint32_t> labels,
                       std::span<const std::uint32_t> truth,
                       std::uint32_t num_classes) {
  SEMSLAM_CHECK(labels.size() == truth.size());
  LabelScore score;
  score.classes.resize(num_classes);
  score.num_points = labels.size();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    SEMSLAM_CHECK(labels[i] <= num_classes) << "label " << labels[i];
    const bool is_right = labels[i] == truth[i];
    score.num_right += is_right ? 1 : 0;
    if (labels[i] != kNoClassNumber) ++score.classes[labels[i] - 1].num_found;
    if (truth[i] == kNoClassNumber || truth[i] == kNothingThere) continue;
    SEMSLAM_CHECK(truth[i] <= num_classes) << "truth " << truth[i];
    ClassScore& true_class = score.classes[truth[i] - 1];
    ++true_class.num_true;
    ++score.num_object_points;
    true_class.num_right += is_right ? 1 : 0;
    score.num_object_right += is_right ? 1 : 0;
  }
  return score;
}

double BleedingScore::Share() const { return semslam::Share(num_bleeding, num_points); }

BleedingScore MeasureBleeding(std::span<const Eigen::Vector3f> positions,
                              std::span<const std::uint32_t> labels,
                              std::span<const std::uint32_t> truth,
                              std::span<const Eigen::Vector3f> object_points,
                              std::span<const std::uint32_t> object_classes,
                              double reach) {
  SEMSLAM_CHECK(labels.size() == positions.size() && truth.size() == positions.size());
  SEMSLAM_CHECK(object_classes.size() == object_points.size());
  const Neighbourhood near_objects({object_points.begin(), object_points.end()}, reach);
  const std::map<std::uint32_t, Neighbourhood> near_class =
      NeighbourhoodOfClass(object_points, object_classes, reach);
  enum : std::uint8_t { kFar, kNear, kBleeding };
  std::vector<std::uint8_t> marks(positions.size(), kFar);
  constexpr std::size_t kGrain = 4096;
  ParallelFor(positions.size(), kGrain, 0, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (truth[i] != kNoClassNumber || !near_objects.Holds(positions[i])) continue;
      const auto carried = near_class.find(labels[i]);
      const bool bleeds = carried != near_class.end() && carried->second.Holds(positions[i]);
      marks[i] = bleeds ? kBleeding : kNear;
    }
  });
  BleedingScore score;
  for (const std::uint8_t mark : marks) {
    score.num_points += mark != kFar ? 1 : 0;
    score.num_bleeding += mark == kBleeding ? 1 : 0;
  }
  return score;
}

}  // namespace semslam

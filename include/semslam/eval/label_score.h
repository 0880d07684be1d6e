// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace semslam {

// Classes of points are numbered from 1; 0 is a point without any.
inline constexpr std::uint32_t kNoClassNumber = 0;
// As the truth of a point: there is nothing, so that whatever is said of the point is wrong.
inline constexpr std::uint32_t kNothingThere = 0xffffffffU;

// Shares whose denominator is 0 are not a number.
struct ClassScore {
  std::size_t num_true = 0;   // Points that are of this class,
  std::size_t num_found = 0;  // that carry it,
  std::size_t num_right = 0;  // both.
  double Precision() const;
  double Recall() const;
  double IntersectionOverUnion() const;
};

struct LabelScore {
  std::vector<ClassScore> classes;  // Class c at c - 1.
  std::size_t num_points = 0;
  std::size_t num_right = 0;          // With their true class, or rightly with none.
  std::size_t num_object_points = 0;  // That are of some class,
  std::size_t num_object_right = 0;   // and carry it.
  double Accuracy() const;
  double ObjectAccuracy() const;
  // Mean over the classes that some point is of or carries.
  double MeanIntersectionOverUnion() const;
};

// Compares the class that each point carries with its true one, both kNoClassNumber or 1 to
// num_classes; the truth may also be kNothingThere.
LabelScore ScoreLabels(std::span<const std::uint32_t> labels,
                       std::span<const std::uint32_t> truth,
                       std::uint32_t num_classes);

// How far classes run over onto what objects stand on or at.
struct BleedingScore {
  std::size_t num_points = 0;    // Of no class, but within reach of an object.
  std::size_t num_bleeding = 0;  // Of these, with the class of an object within reach.
  double Share() const;
};

// `labels` and `truth` as for ScoreLabels, of points at `positions`; `object_points` are points on
// the surfaces of all objects, with their classes. Of these one in each voxel of a fifteenth of the
// reach decides what is within reach.
BleedingScore MeasureBleeding(std::span<const Eigen::Vector3f> positions,
                              std::span<const std::uint32_t> labels,
                              std::span<const std::uint32_t> truth,
                              std::span<const Eigen::Vector3f> object_points,
                              std::span<const std::uint32_t> object_classes,
                              double reach = 0.3);

}  // namespace semslam

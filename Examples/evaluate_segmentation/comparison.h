// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "semslam/eval/boundary_score.h"
#include "semslam/eval/segmentation_score.h"

#include "labelled_cloud.h"

// The methods that are compared, by the names they have on the command line.
enum class Method { kGraph, kLccp, kRegionGrowing };
std::string MethodName(Method method);

// How a method did on a cloud.
struct MethodResult {
  Method method = Method::kGraph;
  double milliseconds = 0;
  std::size_t num_segments = 0;
  std::vector<std::uint32_t> segments;  // By point; 0: unassigned.
  struct Scores {
    semslam::SegmentationScore segmentation;
    semslam::BoundaryScore boundaries;
  };
  std::optional<Scores> scores;  // If the cloud has labels.
};

MethodResult RunMethod(Method method, const LabelledCloud& cloud);

// The measures of a row of the table.
struct Measures {
  double adjusted_rand_index = 0;
  double over_segmentation = 0;
  double under_segmentation = 0;
  double boundary_recall = 0;
  double boundary_precision = 0;
  double coverage = 0;
};
Measures MeasuresOf(const MethodResult::Scores& scores);

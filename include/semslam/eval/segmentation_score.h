// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace semslam {

struct SegmentationScore {
  // Agreement of the two partitions over all pairs of points, corrected for chance: 1 for equal
  // ones, about 0 for unrelated ones (Hubert and Arabie 1985).
  double adjusted_rand_index = 0;
  // Of every true region, the points outside the segment that covers most of it, and the points of
  // that segment in other true regions; both over the number of points (Richtsfeld et al. 2012).
  double over_segmentation = 0;
  double under_segmentation = 0;
  double coverage = 0;  // Share of the points that have a segment.
  std::size_t num_segments = 0;
  std::size_t num_regions = 0;
  std::size_t num_points = 0;  // That were compared.
};

// Compares a segment and a true region for every point. Points whose region is 0 are unknown and
// left out. Points of segment 0 are unassigned: one more segment for the index, but covering no
// region.
SegmentationScore ScoreSegmentation(std::span<const std::uint32_t> segments,
                                    std::span<const std::uint32_t> truth);

// How well one segment stands for a true region.
struct RegionScore {
  std::uint32_t region = 0;
  std::size_t num_points = 0;      // Of the region.
  std::uint32_t best_segment = 0;  // With most of its points; 0 if none of them has a segment.
  double covered = 0;              // Share of the region's points that are in it,
  double foreign = 0;              // share of its points that are of other regions.
};

// For every region above 0, in ascending order; arguments as for ScoreSegmentation.
std::vector<RegionScore> ScoreRegions(std::span<const std::uint32_t> segments,
                                      std::span<const std::uint32_t> truth);

}  // namespace semslam

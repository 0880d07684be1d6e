// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/segmentation_score.h"

#include <map>
#include <utility>

#include "semslam/base/check.h"

namespace semslam {
namespace {

struct Contingency {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> cells;  // By region, then segment.
  std::map<std::uint32_t, double> regions;
  std::map<std::uint32_t, double> segments;
  double total = 0;
};

Contingency Count(std::span<const std::uint32_t> segments, std::span<const std::uint32_t> truth) {
  Contingency table;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == 0) continue;
    ++table.cells[{truth[i], segments[i]}];
    ++table.regions[truth[i]];
    ++table.segments[segments[i]];
    ++table.total;
  }
  return table;
}

double NumPairs(double count) { return 0.5 * count * (count - 1); }

template <typename Map>
double SumOfPairs(const Map& counts) {
  double sum = 0;
  for (const auto& [key, count] : counts) sum += NumPairs(count);
  return sum;
}

double AdjustedRandIndex(const Contingency& table) {
  const double in_both = SumOfPairs(table.cells);
  const double in_regions = SumOfPairs(table.regions);
  const double in_segments = SumOfPairs(table.segments);
  const double all = NumPairs(table.total);
  if (all <= 0) return 1.0;
  const double expected = in_regions * in_segments / all;
  const double largest = 0.5 * (in_regions + in_segments);
  return largest == expected ? 1.0 : (in_both - expected) / (largest - expected);
}

std::vector<RegionScore> RegionScores(const Contingency& table) {
  std::vector<RegionScore> scores;
  double most = 0;  // Points of the last region in its best segment so far.
  for (const auto& [key, count] : table.cells) {
    const auto& [region, segment] = key;
    if (scores.empty() || scores.back().region != region) {
      const double size = table.regions.at(region);
      scores.push_back({.region = region, .num_points = static_cast<std::size_t>(size)});
      most = 0;
    }
    if (segment == 0 || count <= most) continue;
    most = count;
    scores.back().best_segment = segment;
    scores.back().covered = count / table.regions.at(region);
    scores.back().foreign = 1.0 - count / table.segments.at(segment);
  }
  return scores;
}

}  // namespace

SegmentationScore ScoreSegmentation(std::span<const std::uint32_t> segments,
                                    std::span<const std::uint32_t> truth) {
  SEMSLAM_CHECK(segments.size() == truth.size())
      << segments.size() << " segments, " << truth.size() << " regions";
  const Contingency table = Count(segments, truth);
  SegmentationScore score;
  score.num_points = static_cast<std::size_t>(table.total);
  score.adjusted_rand_index = AdjustedRandIndex(table);
  score.num_regions = table.regions.size();
  if (table.total == 0) return score;
  for (const RegionScore& region : RegionScores(table)) {
    const double size = table.regions.at(region.region);
    score.over_segmentation += size * (1.0 - region.covered);
    if (region.best_segment == 0) continue;
    score.under_segmentation += table.segments.at(region.best_segment) * region.foreign;
  }
  score.over_segmentation /= table.total;
  score.under_segmentation /= table.total;
  const auto unassigned = table.segments.find(0);
  const bool all_assigned = unassigned == table.segments.end();
  score.coverage = all_assigned ? 1.0 : 1.0 - unassigned->second / table.total;
  score.num_segments = table.segments.size() - (all_assigned ? 0 : 1);
  return score;
}

std::vector<RegionScore> ScoreRegions(std::span<const std::uint32_t> segments,
                                      std::span<const std::uint32_t> truth) {
  SEMSLAM_CHECK(segments.size() == truth.size())
      << segments.size() << " segments, " << truth.size() << " regions";
  return RegionScores(Count(segments, truth));
}

}  // namespace semslam

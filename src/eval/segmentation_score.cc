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

}  // namespace

SegmentationScore ScoreSegmentation(std::span<const std::uint32_t> segments,
                                    std::span<const std::uint32_t> truth) {
  SEMSLAM_CHECK(segments.size() == truth.size())
      << segments.size() << " segments, " << truth.size() << " regions";
  const Contingency table = Count(segments, truth);
  SegmentationScore score;
  score.num_points = static_cast<std::size_t>(table.total);
  score.adjusted_rand_index = AdjustedRandIndex(table);
  if (table.total == 0) return score;
  std::map<std::uint32_t, std::pair<double, std::uint32_t>> best;  // Region to overlap, segment.
  for (const auto& [key, count] : table.cells) {
    auto& entry = best[key.first];
    if (key.second != 0 && count > entry.first) entry = {count, key.second};
  }
  for (const auto& [region, entry] : best) {
    score.over_segmentation += table.regions.at(region) - entry.first;
    if (entry.first > 0) {
      score.under_segmentation += table.segments.at(entry.second) - entry.first;
    }
  }
  score.over_segmentation /= table.total;
  score.under_segmentation /= table.total;
  return score;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/object_score.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "semslam/base/check.h"

namespace semslam {
namespace {

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(part) / static_cast<double>(whole);
}

// All pairs that overlap enough, the best first.
std::vector<ObjectMatch> Candidates(std::span<const ScoredObject> truth,
                                    std::span<const ScoredObject> found,
                                    double min_overlap) {
  std::vector<ObjectMatch> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t f = 0; f < found.size(); ++f) {
      const double overlap = IntersectionOverUnion(truth[t].box, found[f].box);
      if (overlap < min_overlap) continue;
      pairs.push_back({t, f, overlap, truth[t].class_number == found[f].class_number,
                       (truth[t].centroid - found[f].centroid).norm()});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const ObjectMatch& a, const ObjectMatch& b) {
    return std::tuple(!a.has_right_class, -a.overlap, a.true_index, a.found_index) <
           std::tuple(!b.has_right_class, -b.overlap, b.true_index, b.found_index);
  });
  return pairs;
}

}  // namespace

std::size_t ObjectScore::NumRight() const {
  return static_cast<std::size_t>(
      std::count_if(matches.begin(), matches.end(),
                    [](const ObjectMatch& match) { return match.has_right_class; }));
}

double ObjectScore::Precision() const { return Share(NumRight(), num_found); }
double ObjectScore::Recall() const { return Share(NumRight(), num_true); }
double ObjectScore::ClassAccuracy() const { return Share(NumRight(), matches.size()); }

double ObjectScore::MedianCentroidError() const {
  if (matches.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> errors;
  for (const ObjectMatch& match : matches) errors.push_back(match.centroid_error);
  std::sort(errors.begin(), errors.end());
  const std::size_t half = errors.size() / 2;
  return errors.size() % 2 == 1 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
}

ObjectScore ScoreObjects(std::span<const ScoredObject> truth,
                         std::span<const ScoredObject> found,
                         double min_overlap) {
  SEMSLAM_CHECK(min_overlap > 0 && min_overlap <= 1) << min_overlap;
  ObjectScore score;
  score.min_overlap = min_overlap;
  score.num_found = found.size();
  for (const ScoredObject& object : truth) score.num_true += object.counts ? 1 : 0;
  std::vector<bool> is_true_taken(truth.size(), false);
  std::vector<bool> is_found_taken(found.size(), false);
  for (const ObjectMatch& pair : Candidates(truth, found, min_overlap)) {
    if (is_true_taken[pair.true_index] || is_found_taken[pair.found_index]) continue;
    is_true_taken[pair.true_index] = true;
    is_found_taken[pair.found_index] = true;
    if (truth[pair.true_index].counts) {
      score.matches.push_back(pair);
    } else {
      --score.num_found;
    }
  }
  std::sort(score.matches.begin(), score.matches.end(),
            [](const auto& a, const auto& b) { return a.true_index < b.true_index; });
  return score;
}

}  // namespace semslam

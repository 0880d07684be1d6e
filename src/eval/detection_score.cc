// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/detection_score.h"

#include <algorithm>
#include <limits>

namespace semslam {
namespace {

struct Judged {
  float score = 0;
  bool is_right = false;
};

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// The true box of the class that overlaps the most and is still free; hard ones are never taken.
std::size_t BestMatch(const Detection& detection,
                      const std::vector<TrueBox>& truth,
                      const std::vector<bool>& is_taken,
                      bool hard,
                      float min_overlap) {
  std::size_t best = kNone;
  float best_overlap = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i].class_id != detection.class_id || truth[i].is_hard != hard || is_taken[i])
      continue;
    const float overlap = IntersectionOverUnion(detection.box, truth[i].box);
    if (overlap < min_overlap || overlap <= best_overlap) continue;
    best = i;
    best_overlap = overlap;
  }
  return best;
}

// Adds the picture's detections of one class to `judged`.
void Judge(const ScoredPicture& picture,
           int class_id,
           float min_overlap,
           std::vector<Judged>& judged) {
  std::vector<const Detection*> found;
  for (const Detection& detection : picture.found) {
    if (detection.class_id == class_id) found.push_back(&detection);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto* a, const auto* b) { return a->score > b->score; });
  std::vector<bool> is_taken(picture.truth.size(), false);
  for (const Detection* detection : found) {
    const std::size_t match = BestMatch(*detection, picture.truth, is_taken, false, min_overlap);
    if (match != kNone) {
      is_taken[match] = true;
      judged.push_back({detection->score, true});
    } else if (BestMatch(*detection, picture.truth, is_taken, true, min_overlap) == kNone) {
      judged.push_back({detection->score, false});
    }
  }
}

double AveragePrecision(std::vector<Judged> judged, std::size_t num_true) {
  if (num_true == 0) return std::numeric_limits<double>::quiet_NaN();
  std::stable_sort(judged.begin(), judged.end(),
                   [](const Judged& a, const Judged& b) { return a.score > b.score; });
  std::vector<double> precision;  // At each right detection.
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (!judged[i].is_right) continue;
    precision.push_back(static_cast<double>(precision.size() + 1) / static_cast<double>(i + 1));
  }
  double area = 0;
  double highest = 0;  // Of this and all later ones.
  for (auto it = precision.rbegin(); it != precision.rend(); ++it) {
    highest = std::max(highest, *it);
    area += highest;
  }
  return area / static_cast<double>(num_true);
}

}  // namespace

double DetectionScore::MeanAveragePrecision() const {
  double sum = 0;
  int count = 0;
  for (const OfClass& of_class : classes) {
    if (of_class.num_true == 0) continue;
    sum += of_class.average_precision;
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

DetectionScore ScoreDetections(std::span<const ScoredPicture> pictures,
                               std::size_t num_classes,
                               float min_overlap) {
  DetectionScore score;
  for (std::size_t i = 0; i < num_classes; ++i) {
    const int class_id = static_cast<int>(i);
    std::vector<Judged> judged;
    DetectionScore::OfClass of_class;
    for (const ScoredPicture& picture : pictures) {
      Judge(picture, class_id, min_overlap, judged);
      of_class.num_true += static_cast<std::size_t>(std::count_if(
          picture.truth.begin(), picture.truth.end(),
          [&](const TrueBox& box) { return box.class_id == class_id && !box.is_hard; }));
    }
    of_class.num_found = judged.size();
    of_class.num_right = static_cast<std::size_t>(std::count_if(
        judged.begin(), judged.end(), [](const Judged& detection) { return detection.is_right; }));
    of_class.average_precision = AveragePrecision(std::move(judged), of_class.num_true);
    score.classes.push_back(of_class);
  }
  return score;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/evidence.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/base/parallel.h"

#include "semantics/box_claims.h"
#include "semantics/box_foreground.h"
#include "semantics/collect_evidence.h"
#include "semantics/keyframe_view.h"

namespace semslam {
namespace {

std::int64_t ToUnits(double value) { return std::llround(value / kEvidenceUnit); }

// Pixels of a segment inside one box.
struct Overlap {
  std::uint32_t num_inside = 0;
  std::uint32_t num_foreground = 0;
  double border_factor = 0;  // Sum over the foreground pixels.
};

// What a box shows, by segment, ascending.
struct BoxContents {
  std::vector<std::pair<SegmentId, Overlap>> overlaps;
  std::uint32_t num_measured = 0;  // Grid cells with depth.
};

// What pixels of a box count for: 1 inside, falling linearly to border_weight at its border.
class BorderFactor {
 public:
  BorderFactor(const ImageBox& box, const EvidenceOptions& options)
      : box_(box),
        margin_(std::max(1.0, options.border_share * std::min(box.width(), box.height()))),
        border_weight_(options.border_weight) {}

  double At(int column, int row) const {
    const double x = column + 0.5;
    const double y = row + 0.5;
    const double distance = std::min(std::min<double>(x - box_.min_x, box_.max_x - x),
                                     std::min<double>(y - box_.min_y, box_.max_y - y));
    // Most are inside, and a division takes its time.
    const double depth = distance >= margin_ ? 1.0 : std::max(distance / margin_, 0.0);
    return border_weight_ + (1.0 - border_weight_) * depth;
  }

 private:
  const ImageBox box_;
  const double margin_;
  const double border_weight_;
};

// The segment that at least half of the measured cells of a box show; 0: none.
SegmentId FindFilling(const BoxContents& contents) {
  for (const auto& [segment, overlap] : contents.overlaps) {
    if (2 * overlap.num_inside >= contents.num_measured) return segment;
  }
  return 0;
}

// One keyframe's evidence, kept apart until all its boxes are known.
class KeyframeJudge {
 public:
  KeyframeJudge(const SeenKeyframe& keyframe,
                const Segmentation& segmentation,
                const ClassTable& classes,
                const EvidenceOptions& options)
      : keyframe_(keyframe),
        segmentation_(segmentation),
        classes_(classes),
        options_(options),
        view_(DrawSegments(keyframe, segmentation)),
        largest_inside_share_(view_.visibility.size()),
        overlap_of_(view_.visibility.size()),
        largest_claims_(view_.visibility.size()) {
    foregrounds_.reserve(keyframe_.detections.size());
    for (std::size_t i = 0; i < keyframe_.detections.size(); ++i) JudgeBox(i);
    FindParted();
    // Large, and of all keyframes there is a judge at once.
    view_.image = {};
    foregrounds_ = {};
  }

  // `place`: of the keyframe among all.
  void AddTo(std::size_t place, Evidence& evidence) const {
    for (SegmentId segment = 1; segment < view_.visibility.size(); ++segment) {
      if (IsSeen(segment, options_.min_visible_share)) ++evidence.segments[segment - 1].num_seen;
    }
    AddBest(evidence);
    AddBackground(evidence);
    for (const SegmentId segment : parted_) ++evidence.segments[segment - 1].num_parted;
    for (const auto& [subject, detection] : filled_) {
      evidence.filled_boxes[subject].push_back({place, detection});
    }
  }

 private:
  struct Gain {  // Of one segment from its best box, by class.
    std::vector<double> alpha;
    std::vector<double> part_alpha;
    std::vector<bool> is_seen_as;  // The box's best class.
  };

  const Segment& SegmentOf(SegmentId id) const { return segmentation_.segments[id - 1]; }

  bool IsSeen(SegmentId segment, double min_share) const {
    const Visibility& visible = view_.visibility[segment];
    return visible.num_pixels >= options_.min_pixels &&
           visible.area >= min_share * SegmentOf(segment).area;
  }

  // What is in the box, without the foreground.
  BoxContents CountInside(const CellRange& range) {
    BoxContents contents;
    std::vector<SegmentId> seen;
    for (int row = range.first_row; row < range.last_row; ++row) {
      for (int column = range.first_column; column < range.last_column; ++column) {
        if (keyframe_.cloud->DepthAt(column, row) > 0) ++contents.num_measured;
        const SegmentId segment = view_.image.segments[view_.image.Cell(column, row)];
        if (segment != 0 && overlap_of_[segment].num_inside++ == 0) seen.push_back(segment);
      }
    }
    std::sort(seen.begin(), seen.end());
    for (const SegmentId segment : seen) contents.overlaps.emplace_back(segment, Overlap());
    return contents;
  }

  BoxContents MeasureContents(const Detection& detection,
                              const CellRange& range,
                              const std::vector<std::size_t>& foreground) {
    BoxContents contents = CountInside(range);
    const int stride = keyframe_.cloud->stride();
    const BorderFactor border_factor(detection.box, options_);
    const auto columns = static_cast<std::size_t>(view_.image.columns);
    int row = range.first_row;
    std::size_t row_begin = view_.image.Cell(0, row);
    for (const std::size_t cell : foreground) {
      for (; cell >= row_begin + columns; row_begin += columns) ++row;
      if (view_.image.segments[cell] == 0) continue;
      Overlap& overlap = overlap_of_[view_.image.segments[cell]];
      const int column = static_cast<int>(cell - row_begin);
      ++overlap.num_foreground;
      overlap.border_factor += border_factor.At(column * stride, row * stride);
    }
    for (auto& [segment, overlap] : contents.overlaps) {
      overlap = std::exchange(overlap_of_[segment], Overlap());
    }
    return contents;
  }

  // `place`: of the box in its keyframe.
  void JudgeBox(std::size_t place) {
    const Detection& detection = keyframe_.detections[place];
    const CellRange range = CellRange::Of(detection.box, keyframe_.cloud->stride(),
                                          view_.image.columns, view_.image.rows);
    if (range.empty()) return;
    foregrounds_.push_back(FindForeground(*keyframe_.cloud, view_.image, range,
                                          FindBarriers(segmentation_, classes_, detection.class_id),
                                          options_));
    const std::vector<std::size_t>& foreground = foregrounds_.back();
    const BoxContents contents = MeasureContents(detection, range, foreground);
    const SegmentId filling = FindFilling(contents);
    if (filling != 0 && !CanBe(SegmentOf(filling), classes_, detection.class_id)) {
      filled_.emplace_back(SegmentAndClass(filling, detection.class_id), place);
    }
    std::vector<SegmentId> held;
    for (const auto& [segment, overlap] : contents.overlaps) {
      NoteClaim(segment, overlap.num_foreground);
      const double inside_share =
          double(overlap.num_inside) / double(view_.visibility[segment].num_pixels);
      largest_inside_share_[segment] = std::max(largest_inside_share_[segment], inside_share);
      if (inside_share < options_.min_inside_share) continue;
      if (!IsSeen(segment, options_.min_visible_share)) continue;
      const double filled_share = double(overlap.num_foreground) / double(foreground.size());
      AddGain(segment, detection, inside_share, overlap, filled_share >= options_.min_filled_share);
      // Half or more of it is the object's, or it is seen beside it only where the box is: a foot
      // whose neck is hidden.
      if (2 * overlap.num_foreground >= overlap.num_inside ||
          inside_share >= options_.min_enclosed_share) {
        held.push_back(segment);
      }
    }
    NotePairs(detection.class_id, std::move(held));
  }

  // `held`: by one box, ascending.
  void NotePairs(int box_class, std::vector<SegmentId> held) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      for (std::size_t j = i + 1; j < held.size(); ++j) {
        shared_.emplace(held[i], held[j]);
      }
    }
    for (const auto& [class_id, others] : held_by_boxes_) {
      if (class_id == box_class) AddPairs(held, others, &separate_);
    }
    held_by_boxes_.emplace_back(box_class, std::move(held));
  }

  static void AddPairs(const std::vector<SegmentId>& some,
                       const std::vector<SegmentId>& others,
                       std::set<SegmentPair>* pairs) {
    for (const SegmentId a : some) {
      for (const SegmentId b : others) {
        if (a != b) pairs->emplace(std::min(a, b), std::max(a, b));
      }
    }
  }

  void AddGain(SegmentId segment,
               const Detection& detection,
               double inside_share,
               const Overlap& overlap,
               bool fills_enough) {
    // The mean over its pixels inside the box: of the border factor in the foreground, 0 elsewhere.
    const double weight = inside_share * overlap.border_factor / double(overlap.num_inside);
    const bool is_enclosed = inside_share >= options_.min_enclosed_share;
    const double part_weight = is_enclosed ? std::max(weight, options_.enclosed_weight) : weight;
    Gain& gain = gains_[segment];
    gain.alpha.resize(classes_.size());
    gain.part_alpha.resize(classes_.size());
    gain.is_seen_as.resize(classes_.size());
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (!CanBe(SegmentOf(segment), classes_, static_cast<int>(c))) continue;
      const auto score = static_cast<double>(detection.class_scores[c]);
      gain.part_alpha[c] = std::max(gain.part_alpha[c], score * part_weight);
      const double alpha = score * weight;
      if (!fills_enough || alpha <= 0) continue;
      gain.alpha[c] = std::max(gain.alpha[c], alpha);
      if (static_cast<int>(c) == detection.class_id) gain.is_seen_as[c] = true;
    }
  }

  void AddBest(Evidence& evidence) const {
    for (const auto& [segment, gain] : gains_) {
      SegmentEvidence& sums = evidence.segments[segment - 1];
      for (std::size_t c = 0; c < classes_.size(); ++c) {
        if (gain.part_alpha[c] <= 0) continue;  // Most are not: alpha is never more.
        sums.alpha[c] += ToUnits(gain.alpha[c]);
        sums.part_alpha[c] += ToUnits(gain.part_alpha[c]);
        if (gain.is_seen_as[c]) ++sums.num_views[c];
      }
    }
    for (const SegmentPair& pair : shared_) ++evidence.num_shared_boxes[pair];
    for (const SegmentPair& pair : separate_) {
      if (!shared_.contains(pair)) ++evidence.num_separate_boxes[pair];
    }
  }

  // Detectors overlook what is small in the image: one that found nothing there says little.
  double ChanceToBeDetected(SegmentId segment) const {
    const double stride = keyframe_.cloud->stride();
    const double side_px = stride * std::sqrt(double(view_.visibility[segment].num_pixels));
    return std::min(1.0, side_px / (options_.sure_size * keyframe_.cloud->image_width()));
  }

  void AddBackground(Evidence& evidence) const {
    constexpr double kInNoBox = 0.2;  // Share of the segment inside the best box.
    for (SegmentId segment = 1; segment < view_.visibility.size(); ++segment) {
      if (largest_inside_share_[segment] >= kInNoBox) continue;
      if (!IsSeen(segment, options_.min_visible_share_background)) continue;
      evidence.segments[segment - 1].background +=
          ToUnits(options_.background_weight * ChanceToBeDetected(segment));
    }
  }

  void NoteClaim(SegmentId segment, std::uint32_t num_cells) {
    auto& [largest, second] = largest_claims_[segment];
    second = std::max(second, std::min(largest, num_cells));
    largest = std::max(largest, num_cells);
  }

  // Looks at the points of those claims only that can be rivals.
  void FindParted() {
    std::vector<bool> is_asked(view_.visibility.size(), false);
    for (SegmentId segment = 1; segment < view_.visibility.size(); ++segment) {
      const auto& [largest, second] = largest_claims_[segment];
      is_asked[segment] = second >= options_.min_pixels &&
                          CanBeRivals(largest, second, view_.visibility[segment].num_pixels);
    }
    std::vector<BoxClaim> claims;
    for (const std::vector<std::size_t>& foreground : foregrounds_) {
      for (BoxClaim& claim :
           ClaimsOf(foreground, keyframe_, view_, is_asked, options_.min_pixels)) {
        claims.push_back(std::move(claim));
      }
    }
    for (const auto& [first, second] : FindRivals(claims, view_)) {
      parted_.insert(claims[first].segment);
    }
  }

  const SeenKeyframe& keyframe_;
  const Segmentation& segmentation_;
  const ClassTable& classes_;
  const EvidenceOptions& options_;
  KeyframeView view_;
  std::vector<double> largest_inside_share_;  // By segment id, over all boxes.
  std::map<SegmentId, Gain> gains_;
  std::vector<Overlap> overlap_of_;                    // By segment, of the box that is looked at.
  std::vector<std::vector<std::size_t>> foregrounds_;  // Of all boxes.
  // By segment, over all boxes: the most cells of it in a foreground, and the second most.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> largest_claims_;
  std::set<SegmentId> parted_;  // By two boxes.
  // Boxes filled by what their thing cannot be, by their places.
  std::vector<std::pair<SegmentAndClass, std::size_t>> filled_;
  std::vector<std::pair<int, std::vector<SegmentId>>> held_by_boxes_;  // With the box's class.
  std::set<SegmentPair> shared_;                                       // By one box.
  std::set<SegmentPair> separate_;                                     // By two of one class.
};

}  // namespace

void EvidenceOptions::Validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(std::string("evidence: ") + what);
  };
  const auto is_share = [](double value) { return value >= 0 && value <= 1; };
  require(is_share(min_inside_share) && is_share(min_filled_share) && is_share(border_share) &&
              is_share(border_weight) && is_share(min_enclosed_share) &&
              is_share(enclosed_weight) && is_share(min_visible_share) &&
              is_share(min_visible_share_background),
          "expected shares in [0, 1]");
  require(core_share > 0 && core_share <= 1, "expected 0 < core_share <= 1");
  require(max_depth_step > 0 && depth_step_at_1m >= 0, "expected max_depth_step > 0");
  require(max_hole >= 0 && max_hole <= 100, "expected 0 <= max_hole <= 100");
  require(background_weight >= 0, "expected background_weight >= 0");
  require(sure_size > 0, "expected sure_size > 0");
}

Evidence CollectEvidence(std::span<const SeenKeyframe> keyframes,
                         const Segmentation& segmentation,
                         const ClassTable& classes,
                         const EvidenceOptions& options) {
  options.Validate();
  Evidence evidence;
  SegmentEvidence nothing;
  nothing.alpha.assign(classes.size(), 0);
  nothing.part_alpha.assign(classes.size(), 0);
  nothing.num_views.assign(classes.size(), 0);
  evidence.segments.assign(segmentation.segments.size(), nothing);
  std::vector<std::optional<KeyframeJudge>> judges(keyframes.size());
  ParallelFor(keyframes.size(), 1, 0, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      judges[i].emplace(keyframes[i], segmentation, classes, options);
    }
  });
  for (std::size_t i = 0; i < judges.size(); ++i) judges[i]->AddTo(i, evidence);
  return evidence;
}

}  // namespace semslam

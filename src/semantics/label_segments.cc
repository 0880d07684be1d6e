// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/label_segments.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "semantics/belief.h"

namespace semslam {
namespace {

SegmentId RootOf(SegmentId segment, const std::vector<SegmentLabel>& labels) {
  while (labels[segment - 1].object_root != segment) segment = labels[segment - 1].object_root;
  return segment;
}

void JoinTrees(SegmentId a, SegmentId b, std::vector<SegmentLabel>* labels) {
  const SegmentId root_a = RootOf(a, *labels);
  const SegmentId root_b = RootOf(b, *labels);
  (*labels)[std::max(root_a, root_b) - 1].object_root = std::min(root_a, root_b);
}

std::int64_t EvidenceForNotKnowing(const FusionOptions& options) {
  return std::max<std::int64_t>(1, std::llround(options.min_evidence / kEvidenceUnit));
}

void Add(const SegmentEvidence& part, SegmentEvidence* sums) {
  const std::size_t num_classes = part.part_alpha.size();
  sums->part_alpha.resize(num_classes);
  sums->num_views.resize(num_classes);
  for (std::size_t c = 0; c < num_classes; ++c) {
    sums->part_alpha[c] += part.part_alpha[c];
    sums->num_views[c] = std::max(sums->num_views[c], part.num_views[c]);
  }
  sums->background += part.background;
}

// Root, confidence, entropy and views of every object's parts, from the forest and the evidence for
// all parts.
void SumUpObjects(const Evidence& evidence,
                  std::int64_t unknown,
                  std::vector<SegmentLabel>* labels) {
  std::map<SegmentId, SegmentEvidence> sums_of;  // By root.
  for (SegmentId segment = 1; segment <= labels->size(); ++segment) {
    SegmentLabel& label = (*labels)[segment - 1];
    if (label.class_id == kNoClass) continue;
    label.object_root = RootOf(segment, *labels);
    Add(evidence.segments[segment - 1], &sums_of[label.object_root]);
  }
  for (SegmentLabel& label : *labels) {
    if (label.class_id == kNoClass) continue;
    const SegmentEvidence& sums = sums_of[label.object_root];
    const Belief belief(sums.part_alpha, sums.background, unknown);
    label.num_views = sums.num_views[static_cast<std::size_t>(label.class_id)];
    label.confidence = belief.ProbabilityOf(label.class_id);
    label.entropy = belief.Entropy();
  }
}

// Works on the segments' evidence; the parts of an object are kept as a forest.
class Labeller {
 public:
  Labeller(const Evidence& evidence,
           const MapCloud& cloud,
           const Segmentation& segmentation,
           const SegmentPoints& segment_points,
           const ClassTable& classes,
           const FusionOptions& options)
      : evidence_(evidence),
        cloud_(cloud),
        segmentation_(segmentation),
        segment_points_(segment_points),
        classes_(classes),
        options_(options),
        unknown_(EvidenceForNotKnowing(options)),
        labels_(segmentation.segments.size()),
        extents_(segmentation.segments.size()) {}

  std::vector<SegmentLabel> Run() {
    for (SegmentId segment = 1; segment <= labels_.size(); ++segment) LabelAlone(segment);
    JoinParts();
    TakePiecesAlong();
    SumUpObjects(evidence_, unknown_, &labels_);
    return std::move(labels_);
  }

 private:
  SegmentLabel& LabelOf(SegmentId segment) { return labels_[segment - 1]; }
  const SegmentEvidence& EvidenceOf(SegmentId segment) const {
    return evidence_.segments[segment - 1];
  }

  SegmentId Root(SegmentId segment) const { return RootOf(segment, labels_); }

  void LabelAlone(SegmentId segment) {
    const SegmentEvidence& sums = EvidenceOf(segment);
    SegmentLabel& label = LabelOf(segment);
    label.object_root = segment;
    const Belief belief(sums.alpha, sums.background, unknown_);
    label.confidence = belief.background_confidence();
    label.entropy = belief.Entropy();
    const int class_id = belief.best_class();
    if (class_id == kNoClass || !classes_.is_of_interest(class_id)) return;
    const std::uint32_t num_views = sums.num_views[static_cast<std::size_t>(class_id)];
    if (belief.ProbabilityOf(class_id) < options_.min_confidence || num_views == 0) return;
    if (num_views < std::min(options_.min_views, sums.num_seen)) return;
    label.class_id = class_id;
  }

  // Whether two segments were under one box in most of the keyframes in which boxes held them.
  bool ShareBoxes(const SegmentPair& pair, std::uint32_t num_shared) const {
    const std::uint32_t num_seen =
        std::min(EvidenceOf(pair.first).num_seen, EvidenceOf(pair.second).num_seen);
    return num_shared > 0 && num_shared >= options_.min_shared_share * num_seen;
  }

  bool LieTogether(SegmentId a, SegmentId b) {
    const auto& neighbours = segmentation_.segments[a - 1].neighbours;
    if (std::binary_search(neighbours.begin(), neighbours.end(), b)) return true;
    const float size = std::max(ExtentOf(a).sizes().maxCoeff(), ExtentOf(b).sizes().maxCoeff());
    const float max_gap = std::max(static_cast<float>(options_.max_part_gap),
                                   static_cast<float>(options_.max_relative_part_gap) * size);
    const std::vector<Eigen::Vector3f> near_b = PointsNear(a, ExtentOf(b), max_gap);
    const std::vector<Eigen::Vector3f> near_a = PointsNear(b, ExtentOf(a), max_gap);
    return std::any_of(near_b.begin(), near_b.end(), [&](const Eigen::Vector3f& p) {
      return std::any_of(near_a.begin(), near_a.end(), [&](const Eigen::Vector3f& q) {
        return (p - q).squaredNorm() <= max_gap * max_gap;
      });
    });
  }

  // Of few segments anyone asks.
  const Eigen::AlignedBox3f& ExtentOf(SegmentId segment) {
    Eigen::AlignedBox3f& extent = extents_[segment - 1];
    if (extent.isEmpty()) {
      for (const std::uint32_t point : segment_points_.Of(segment)) {
        extent.extend(cloud_.positions[point]);
      }
    }
    return extent;
  }

  std::vector<Eigen::Vector3f> PointsNear(SegmentId segment,
                                          const Eigen::AlignedBox3f& box,
                                          float reach) const {
    std::vector<Eigen::Vector3f> near;
    for (const std::uint32_t point : segment_points_.Of(segment)) {
      const Eigen::Vector3f& p = cloud_.positions[point];
      if (box.squaredExteriorDistance(p) <= reach * reach) near.push_back(p);
    }
    return near;
  }

  void JoinParts() {
    for (const auto& [pair, num_shared] : evidence_.num_shared_boxes) {
      const int class_id = LabelOf(pair.first).class_id;
      if (class_id == kNoClass || class_id != LabelOf(pair.second).class_id) continue;
      if (ShareBoxes(pair, num_shared) && LieTogether(pair.first, pair.second)) {
        JoinTrees(pair.first, pair.second, &labels_);
      }
    }
  }

  // Pieces too small to fill a box on their own. Decided against the labels of whole parts only, so
  // that the order does not matter.
  void TakePiecesAlong() {
    struct Piece {
      SegmentId segment, part;
      std::uint32_t num_shared;
    };
    std::vector<Piece> pieces;
    for (const auto& [pair, num_shared] : evidence_.num_shared_boxes) {
      if (!ShareBoxes(pair, num_shared)) continue;
      for (const auto& [piece, part] :
           {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)}) {
        if (IsPieceOf(piece, part) && LieTogether(pair.first, pair.second)) {
          pieces.push_back({piece, part, num_shared});
        }
      }
    }
    // Each piece to the part it was seen with most often; ties to the lower id.
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Piece& a, const Piece& b) { return a.num_shared > b.num_shared; });
    for (const Piece& piece : pieces) {
      if (LabelOf(piece.segment).class_id != kNoClass) continue;
      LabelOf(piece.segment).class_id = LabelOf(piece.part).class_id;
      LabelOf(piece.segment).object_root = Root(piece.part);
    }
  }

  bool IsPieceOf(SegmentId piece, SegmentId part) {
    const int class_id = LabelOf(part).class_id;
    if (class_id == kNoClass || LabelOf(piece).class_id != kNoClass) return false;
    const SegmentEvidence& sums = EvidenceOf(piece);
    const Belief belief(sums.part_alpha, sums.background, unknown_);
    return belief.best_class() == class_id &&
           belief.ProbabilityOf(class_id) >= options_.min_confidence;
  }

  const Evidence& evidence_;
  const MapCloud& cloud_;
  const Segmentation& segmentation_;
  const SegmentPoints& segment_points_;
  const ClassTable& classes_;
  const FusionOptions& options_;
  const std::int64_t unknown_;  // Evidence for not knowing.
  std::vector<SegmentLabel> labels_;
  std::vector<Eigen::AlignedBox3f> extents_;  // By segment, in world axes; see ExtentOf.
};

}  // namespace

std::vector<SegmentLabel> LabelSegments(const Evidence& evidence,
                                        const MapCloud& cloud,
                                        const Segmentation& segmentation,
                                        const SegmentPoints& segment_points,
                                        const ClassTable& classes,
                                        const FusionOptions& options) {
  return Labeller(evidence, cloud, segmentation, segment_points, classes, options).Run();
}

void JoinObjects(std::span<const SegmentPair> pairs,
                 const Evidence& evidence,
                 const FusionOptions& options,
                 std::vector<SegmentLabel>* labels) {
  for (const SegmentPair& pair : pairs) JoinTrees(pair.first, pair.second, labels);
  SumUpObjects(evidence, EvidenceForNotKnowing(options), labels);
}

}  // namespace semslam

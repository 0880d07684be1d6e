// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/semantic_map.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/base/parallel.h"

#include "semantics/collect_evidence.h"
#include "semantics/duplicates.h"
#include "semantics/flat_things.h"
#include "semantics/label_segments.h"
#include "semantics/segment_points.h"
#include "semantics/split_segments.h"
#include "semantics/support.h"

namespace semslam {
namespace {

constexpr int kMaxThingsInASegment = 4;

// Segments with one root are parts of one object.
std::map<SegmentId, std::vector<SegmentId>> PartsOfObjects(
    const std::vector<SegmentLabel>& labels) {
  std::map<SegmentId, std::vector<SegmentId>> parts_of;  // By root.
  for (SegmentId segment = 1; segment <= labels.size(); ++segment) {
    const SegmentLabel& label = labels[segment - 1];
    if (label.class_id != kNoClass) parts_of[label.object_root].push_back(segment);
  }
  return parts_of;
}

// All points of some segments, in the cloud's order.
std::vector<std::uint32_t> PointsOf(const std::vector<SegmentId>& segments,
                                    const SegmentPoints& segment_points) {
  std::vector<std::uint32_t> points;
  for (const SegmentId segment : segments) {
    const std::span<const std::uint32_t> own = segment_points.Of(segment);
    points.insert(points.end(), own.begin(), own.end());
  }
  if (segments.size() > 1) std::sort(points.begin(), points.end());
  return points;
}

SemanticObject MakeObject(const SegmentLabel& label,
                          std::vector<SegmentId> segments,
                          const std::vector<Eigen::Vector3d>& points,
                          const SupportFinder& supports) {
  SemanticObject object;
  object.class_id = label.class_id;
  object.confidence = label.confidence;
  object.entropy = label.entropy;
  object.num_views = label.num_views;
  object.segments = std::move(segments);
  object.num_points = points.size();
  object.centroid =
      std::accumulate(points.begin(), points.end(), Eigen::Vector3d(Eigen::Vector3d::Zero())) /
      static_cast<double>(points.size());
  object.supporting_segment = supports.FindSupport(points, object.segments);
  object.box = supports.FitBox(points, object.supporting_segment);
  return object;
}

std::vector<SemanticObject> MakeObjects(const std::vector<SegmentLabel>& labels,
                                        const MapCloud& cloud,
                                        const SegmentPoints& segment_points,
                                        const SupportFinder& supports) {
  std::map<SegmentId, std::vector<SegmentId>> parts_of = PartsOfObjects(labels);
  std::erase_if(parts_of, [&](const auto& object) {
    return std::all_of(object.second.begin(), object.second.end(),
                       [&](SegmentId segment) { return segment_points.Of(segment).empty(); });
  });
  std::vector<std::pair<SegmentId, std::vector<SegmentId>>> parts(
      std::make_move_iterator(parts_of.begin()), std::make_move_iterator(parts_of.end()));
  std::vector<SemanticObject> objects(parts.size());
  ParallelFor(parts.size(), 1, 0, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      auto& [root, segments] = parts[i];
      const auto points = PositionsOf(PointsOf(segments, segment_points), cloud);
      objects[i] = MakeObject(labels[root - 1], std::move(segments), points, supports);
    }
  });
  return objects;
}

// Gives objects the ids they had: nearest pairs of one class first.
void TakeOverIds(const SemanticMap& previous,
                 double max_object_shift,
                 std::vector<SemanticObject>& objects) {
  struct Match {
    double distance;
    ObjectId id;
    std::size_t object;
  };
  std::vector<Match> matches;
  for (const SemanticObject& before : previous.objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i].class_id != before.class_id) continue;
      const double distance = (objects[i].centroid - before.centroid).norm();
      const double reach = std::max(max_object_shift, before.box.half_size.maxCoeff());
      if (distance <= reach) matches.push_back({distance, before.id, i});
    }
  }
  std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
    return std::tie(a.distance, a.id, a.object) < std::tie(b.distance, b.id, b.object);
  });
  std::vector<ObjectId> taken;
  for (const Match& match : matches) {
    if (objects[match.object].id != 0) continue;
    if (std::find(taken.begin(), taken.end(), match.id) != taken.end()) continue;
    objects[match.object].id = match.id;
    taken.push_back(match.id);
  }
}

void NumberObjects(const SemanticMap* previous, double max_object_shift, SemanticMap& map) {
  if (previous != nullptr) {
    map.next_object_id = previous->next_object_id;
    TakeOverIds(*previous, max_object_shift, map.objects);
  }
  for (SemanticObject& object : map.objects) {
    if (object.id == 0) object.id = map.next_object_id++;
  }
  std::sort(map.objects.begin(), map.objects.end(),
            [](const SemanticObject& a, const SemanticObject& b) { return a.id < b.id; });
}

// After NumberObjects.
std::vector<ObjectId> ObjectOfSegment(const std::vector<SemanticObject>& objects,
                                      std::size_t num_segments) {
  std::vector<ObjectId> object_of_segment(num_segments + 1, 0);
  for (const SemanticObject& object : objects) {
    for (const SegmentId segment : object.segments) object_of_segment[segment] = object.id;
  }
  return object_of_segment;
}

void LabelPoints(const std::vector<SegmentLabel>& labels,
                 const std::vector<ObjectId>& object_of_segment,
                 SemanticMap& map) {
  const std::size_t num_points = map.segment_of_point.size();
  map.class_of_point.assign(num_points, kNoClass);
  map.confidence_of_point.assign(num_points, 0.0F);
  map.entropy_of_point.assign(num_points, 1.0F);
  map.object_of_point.assign(num_points, 0);
  for (std::size_t i = 0; i < num_points; ++i) {
    const SegmentId segment = map.segment_of_point[i];
    if (segment == 0) continue;
    map.class_of_point[i] = labels[segment - 1].class_id;
    map.confidence_of_point[i] = static_cast<float>(labels[segment - 1].confidence);
    map.entropy_of_point[i] = static_cast<float>(labels[segment - 1].entropy);
    map.object_of_point[i] = object_of_segment[segment];
  }
}

SemanticMap LabelMap(const MapCloud& cloud,
                     const VoxelIndex& index,
                     const Segmentation& segmentation,
                     const Evidence& evidence,
                     const ClassTable& classes,
                     const FusionOptions& options,
                     const SemanticMap* previous) {
  const SegmentPoints segment_points(segmentation);
  std::vector<SegmentLabel> labels =
      LabelSegments(evidence, cloud, segmentation, segment_points, classes, options);
  SemanticMap map;
  map.classes = classes;
  map.segment_of_point = segmentation.segment_of_point;
  const SupportFinder supports(cloud, index, segmentation);
  map.objects = MakeObjects(labels, cloud, segment_points, supports);
  const std::vector<SegmentPair> duplicates =
      FindDuplicates(map.objects, cloud, segment_points, evidence);
  if (!duplicates.empty()) {
    JoinObjects(duplicates, evidence, options, &labels);
    map.objects = MakeObjects(labels, cloud, segment_points, supports);
  }
  NumberObjects(previous, options.max_object_shift, map);
  const std::vector<ObjectId> object_of_segment = ObjectOfSegment(map.objects, labels.size());
  for (SemanticObject& object : map.objects) {
    object.supporting_object = object_of_segment[object.supporting_segment];
  }
  LabelPoints(labels, object_of_segment, map);
  return map;
}

}  // namespace

void FusionOptions::Validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(std::string("fusion: ") + what);
  };
  evidence.Validate();
  require(min_confidence >= 0 && min_confidence <= 1, "expected min_confidence in [0, 1]");
  require(min_evidence >= 0, "expected min_evidence >= 0");
  require(min_shared_share > 0 && min_shared_share <= 1, "expected 0 < min_shared_share <= 1");
  require(max_part_gap >= 0 && max_relative_part_gap >= 0, "expected part gaps of at least 0");
  require(max_object_shift >= 0, "expected max_object_shift >= 0");
}

SemanticMap BuildSemanticMap(const MapCloud& cloud,
                             const VoxelIndex& index,
                             const Segmentation& segmentation,
                             std::span<const LabelledKeyframe> keyframes,
                             const ClassTable& classes,
                             const FusionOptions& options,
                             const SemanticMap* previous) {
  options.Validate();
  SEMSLAM_CHECK(segmentation.segment_of_point.size() == cloud.size())
      << segmentation.segment_of_point.size() << " labels, " << cloud.size() << " points";
  const std::vector<SeenKeyframe> seen = FindSeenPoints(keyframes, index, classes);
  // Instead of the segmentation, where boxes know more than the geometry.
  std::optional<Segmentation> parted;
  const auto segments = [&]() -> const Segmentation& { return parted ? *parted : segmentation; };
  const auto collect = [&] { return CollectEvidence(seen, segments(), classes, options.evidence); };
  Evidence evidence = collect();
  if (auto with_flat_things = TakeOutFlatThings(cloud, segmentation, seen, evidence, classes)) {
    parted = std::move(with_flat_things);
    evidence = collect();
  }
  for (int round = 0; round < kMaxThingsInASegment - 1; ++round) {
    auto further = SplitMixedSegments(cloud, segments(), seen, evidence, classes, options.evidence);
    if (!further) break;
    parted = std::move(further);
    evidence = collect();
  }
  return LabelMap(cloud, index, segments(), evidence, classes, options, previous);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "loop/loop_correction.h"

#include <map>

#include "semslam/mapping/appearance_update.h"
#include "semslam/mapping/landmark_search.h"

#include "loop/covisible_group.h"

namespace semslam {
namespace {

// What is copied out of the map.
struct Snapshot {
  std::vector<KeyframeId> keyframes;  // One a node of the graph.
  std::map<KeyframeId, int> node_of;
  PoseGraph graph;  // As the map is: before the loop.
  ScaleSpace scale_space;
  std::vector<KeyframeCopy> group;           // The keyframe and its covisible ones.
  std::vector<LandmarkCopy> loop_landmarks;  // Seen at the other end.
};

// An edge between two keyframes as they stand in the snapshot.
void AddEdge(KeyframeId a, KeyframeId b, Snapshot* snapshot) {
  const auto from = snapshot->node_of.find(a);
  const auto to = snapshot->node_of.find(b);
  if (from == snapshot->node_of.end() || to == snapshot->node_of.end()) return;
  const std::vector<Rigid3>& poses = snapshot->graph.T_world_node;
  snapshot->graph.edges.push_back(
      {from->second, to->second, poses[from->second].Inverse() * poses[to->second]});
}

void AddEdges(const LoopEdges& edges, Snapshot* snapshot) {
  for (const auto& [a, b] : edges) AddEdge(a, b, snapshot);
}

// The essential graph: the spanning tree, earlier loops, and pairs that share many landmarks.
void AddEssentialGraph(const Map& map,
                       const LoopEdges& old_loops,
                       int min_shared,
                       Snapshot* snapshot) {
  snapshot->keyframes = map.KeyframeIds();
  for (const KeyframeId id : snapshot->keyframes) {
    const Keyframe& keyframe = map.keyframe(id);
    snapshot->node_of[id] = static_cast<int>(snapshot->graph.T_world_node.size());
    snapshot->graph.T_world_node.push_back(keyframe.T_world_camera);
    snapshot->graph.is_fixed.push_back(keyframe.parent ? 0 : 1);
  }
  for (const KeyframeId id : snapshot->keyframes) {
    const Keyframe& keyframe = map.keyframe(id);
    if (keyframe.parent) AddEdge(*keyframe.parent, id, snapshot);
    for (const CovisibleKeyframe& covisible : keyframe.covisible) {
      const bool is_first_of_two = covisible.id < id;
      if (!is_first_of_two || covisible.id == keyframe.parent) continue;
      if (covisible.num_shared >= min_shared) AddEdge(covisible.id, id, snapshot);
    }
  }
  AddEdges(old_loops, snapshot);
}

std::optional<Snapshot> TakeSnapshot(const Map& map,
                                     const LoopMatch& match,
                                     const LoopEdges& old_loops,
                                     const LoopCorrectionOptions& options) {
  const bool is_there = map.epoch() == match.epoch && map.FindKeyframe(match.keyframe) != nullptr &&
                        map.FindKeyframe(match.place) != nullptr;
  if (!is_there) return std::nullopt;
  Snapshot snapshot;
  snapshot.scale_space = map.scale_space();
  AddEssentialGraph(map, old_loops, options.min_shared_essential, &snapshot);
  for (const KeyframeId id : GroupOf(map, match.keyframe, options.min_shared)) {
    snapshot.group.push_back(CopyKeyframe(map.keyframe(id)));
  }
  snapshot.loop_landmarks = map.CopyLandmarksSeenBy(GroupOf(map, match.place, options.min_shared));
  return snapshot;
}

// What a keyframe of the group, at its corrected pose, shows of the other end.
struct GroupHits {
  KeyframeId keyframe;
  std::vector<LandmarkHit> hits;
};

std::vector<GroupHits> SearchLoopLandmarks(const ProjectionCamera& camera,
                                           const Snapshot& snapshot) {
  constexpr LandmarkSearchOptions kSearch{.radius = 4.0F, .must_agree_well = false};
  std::vector<GroupHits> result;
  for (const KeyframeCopy& keyframe : snapshot.group) {
    result.push_back(
        {keyframe.id, FindLandmarks(camera, keyframe, snapshot.loop_landmarks, kSearch)});
  }
  return result;
}

MapCorrection SolveGraph(const Snapshot& snapshot,
                         const std::vector<Rigid3>& T_world_old,
                         const PoseGraphOptions& options) {
  const PoseGraphSolution solution = OptimizePoseGraph(snapshot.graph, options);
  MapCorrection correction;
  for (std::size_t i = 0; i < snapshot.keyframes.size(); ++i) {
    correction.T_new_old[snapshot.keyframes[i]] =
        solution.T_world_node[i] * T_world_old[i].Inverse();
  }
  return correction;
}

}  // namespace

std::optional<LoopCorrection> CorrectLoop(const PinholeCamera& camera,
                                          double baseline_times_fx,
                                          const LoopMatch& match,
                                          const LoopEdges& old_loops,
                                          const LoopCorrectionOptions& options,
                                          SharedMap& shared_map) {
  std::optional<Snapshot> snapshot =
      shared_map.Read([&](const Map& map) { return TakeSnapshot(map, match, old_loops, options); });
  if (!snapshot) return std::nullopt;
  const std::vector<Rigid3> T_world_old = snapshot->graph.T_world_node;

  // The group goes where the match says, as one.
  const Rigid3 T_new_old =
      match.T_world_keyframe * T_world_old[snapshot->node_of.at(match.keyframe)].Inverse();
  for (KeyframeCopy& keyframe : snapshot->group) {
    keyframe.T_world_camera = T_new_old * keyframe.T_world_camera;
    const int node = snapshot->node_of.at(keyframe.id);
    if (snapshot->graph.is_fixed[node] == 0) {
      snapshot->graph.T_world_node[node] = keyframe.T_world_camera;
    }
  }
  const std::vector<GroupHits> found =
      SearchLoopLandmarks({camera, baseline_times_fx, snapshot->scale_space}, *snapshot);
  LoopCorrection result;
  for (const GroupHits& group : found) {
    const bool is_well_tied = static_cast<int>(group.hits.size()) >= options.min_hits_for_edge;
    if (group.keyframe == match.keyframe || (is_well_tied && group.keyframe != match.place)) {
      result.edges.emplace_back(group.keyframe, match.place);
    }
  }
  AddEdges(result.edges, &*snapshot);  // By the group's corrected poses.
  const MapCorrection correction = SolveGraph(*snapshot, T_world_old, options.pose_graph);

  std::vector<LandmarkId> touched;
  const bool is_committed = shared_map.Write([&](Map& map) {
    if (map.epoch() != match.epoch || map.FindKeyframe(match.keyframe) == nullptr) return false;
    map.Correct(correction);
    for (const GroupHits& group : found) {
      result.num_fused += FuseHits(group.keyframe, group.hits, map);
      for (const LandmarkHit& hit : group.hits) {
        if (const auto landmark = map.ResolveLandmark(hit.landmark)) touched.push_back(*landmark);
      }
    }
    return true;
  });
  if (!is_committed) return std::nullopt;
  UpdateAppearances(shared_map, touched);
  return result;
}

}  // namespace semslam

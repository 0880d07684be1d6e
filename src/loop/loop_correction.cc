// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "loop/loop_correction.h"

#include <map>

#include "semslam/mapping/appearance_update.h"

#include "loop/loop_fusion.h"

namespace semslam {
namespace {

// What is copied out of the map.
struct Snapshot {
  std::vector<KeyframeId> keyframes;  // One a node of the graph.
  std::map<KeyframeId, int> node_of;
  PoseGraph graph;  // As the map is: before the loop.
  BothEnds ends;
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

// The essential graph: the spanning tree, earlier loops, and pairs that share many landmarks.
void AddEssentialGraph(const Map& map, int min_shared, Snapshot* snapshot) {
  snapshot->keyframes = map.KeyframeIds();
  for (const KeyframeId id : snapshot->keyframes) {
    const Keyframe& keyframe = map.keyframe(id);
    snapshot->node_of[id] = static_cast<int>(snapshot->graph.T_world_node.size());
    snapshot->graph.T_world_node.push_back(keyframe.T_world_camera);
    snapshot->graph.is_fixed.push_back(keyframe.parent ? 0 : 1);
  }
  for (const KeyframeId id : snapshot->keyframes) {
    const Keyframe& keyframe = map.keyframe(id);
    if (keyframe.parent && !keyframe.starts_piece) AddEdge(*keyframe.parent, id, snapshot);
    for (const CovisibleKeyframe& covisible : keyframe.covisible) {
      const bool is_first_of_two = covisible.id < id;
      if (!is_first_of_two || covisible.id == keyframe.parent) continue;
      if (covisible.num_shared >= min_shared) AddEdge(covisible.id, id, snapshot);
    }
    for (const KeyframeId partner : keyframe.loop_partners) {
      if (partner < id) AddEdge(partner, id, snapshot);
    }
  }
}

std::optional<Snapshot> TakeSnapshot(const Map& map,
                                     const LoopMatch& match,
                                     const LoopCorrectionOptions& options) {
  if (!Holds(match, map)) return std::nullopt;
  Snapshot snapshot;
  AddEssentialGraph(map, options.min_shared_essential, &snapshot);
  snapshot.ends = CopyBothEnds(map, match, options.min_shared);
  return snapshot;
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
                                          const LoopCorrectionOptions& options,
                                          SharedMap& shared_map) {
  std::optional<Snapshot> snapshot =
      shared_map.Read([&](const Map& map) { return TakeSnapshot(map, match, options); });
  if (!snapshot) return std::nullopt;
  const std::vector<Rigid3> T_world_old = snapshot->graph.T_world_node;

  // The group goes where the match says, as one.
  const Rigid3 T_new_old =
      match.T_world_keyframe * T_world_old[snapshot->node_of.at(match.keyframe)].Inverse();
  for (KeyframeCopy& keyframe : snapshot->ends.group) {
    keyframe.T_world_camera = T_new_old * keyframe.T_world_camera;
    const int node = snapshot->node_of.at(keyframe.id);
    if (snapshot->graph.is_fixed[node] == 0) {
      snapshot->graph.T_world_node[node] = keyframe.T_world_camera;
    }
  }
  const std::vector<GroupHits> found = FindInGroup(camera, baseline_times_fx, snapshot->ends);
  const LoopEdges edges = EdgesToPlace(found, match, options.min_hits_for_edge);
  for (const auto& [a, b] : edges) AddEdge(a, b, &*snapshot);  // By the group's corrected poses.
  const MapCorrection correction = SolveGraph(*snapshot, T_world_old, options.pose_graph);

  const auto fused = shared_map.Write([&](Map& map) -> std::optional<FusedLandmarks> {
    if (!Holds(match, map)) return std::nullopt;
    map.Correct(correction);
    return FuseEnds(found, edges, map);
  });
  if (!fused) return std::nullopt;
  UpdateAppearances(shared_map, fused->touched);
  return LoopCorrection{.num_fused = fused->count};
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "semslam/base/id.h"
#include "semslam/dense/keyframe_cloud.h"
#include "semslam/dense/map_cloud.h"
#include "semslam/geometry/rigid3.h"

namespace semslam {

class VoxelTable;

// A hashed voxel grid in world coordinates that merges the clouds of keyframes and follows their
// poses. Every voxel holds sums of position, normal and colour, weighted by the inverse variance of
// the depth. The sums are integers: taking a keyframe out leaves exactly what there would be if it
// had never been in, and the order of keyframes does not matter. Memory follows the surface: about
// 60 bytes a voxel, plus the clouds themselves. Not thread-safe: belongs to one thread; what
// Extract returns is a value.
class VoxelMap {
 public:
  struct Options {
    double voxel_size = 0.008;  // Metres.
    // A keyframe is integrated anew once its pose moved some of its points further than this share
    // of a voxel.
    double max_shift = 0.5;
    std::uint32_t min_views = 1;  // Extract leaves out voxels that fewer keyframes saw,
    float min_weight = 0.0F;      // and those with less weight than this (1: one pixel at 4 m).
    std::size_t max_voxels = 20'000'000;  // At the limit, points that need a new voxel are refused.
    void Validate() const;                // Throws InputError.
  };

  explicit VoxelMap(const Options& options);
  ~VoxelMap();
  VoxelMap(VoxelMap&&) noexcept;
  VoxelMap& operator=(VoxelMap&&) noexcept;

  // Adds a keyframe. Its id must not be in the map.
  void Integrate(std::shared_ptr<const KeyframeCloud> cloud, const Rigid3& T_world_camera);

  // Takes a keyframe out again. False if it is not in the map.
  bool Remove(KeyframeId id);

  // Moves keyframes; ids that are not in the map are ignored. Only those whose points moved further
  // than max_shift (of a voxel) since they were integrated are integrated anew; a share of 0 makes
  // the map exact. Returns how many were.
  std::size_t UpdatePoses(const std::map<KeyframeId, Rigid3>& T_world_camera);
  std::size_t UpdatePoses(const std::map<KeyframeId, Rigid3>& T_world_camera, double max_shift);

  // The voxels seen well enough, in the order of their keys: the same map gives the same bytes.
  MapCloud Extract() const;
  // Those of the keys (VoxelKey::Pack), one point for each in their order; not finite for a voxel
  // that is not there or not seen well enough.
  MapCloud Extract(std::span<const std::uint64_t> keys) const;

  // What TakeChanges tells, in an order that is the same for the same calls. A voxel that vanishes
  // and comes again while the map is compacted in between is told twice, as vanished and appeared.
  struct Changes {
    std::vector<std::uint64_t> appeared;
    std::vector<std::uint64_t> vanished;
    // From which voxel to which some of a moved keyframe's points went.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> moved;
  };
  // From now on the changes are kept for TakeChanges; all voxels that are there have appeared.
  void RecordChanges();
  // Since the last time.
  Changes TakeChanges();

  bool Contains(KeyframeId id) const { return keyframes_.contains(id); }
  std::size_t num_keyframes() const { return keyframes_.size(); }
  std::size_t num_voxels() const;
  // Points of the keyframes in the map that found no voxel because of max_voxels.
  std::size_t num_refused_points() const;
  // Of the voxels and their table, without the clouds.
  std::size_t memory_bytes() const;

 private:
  struct Entry {
    std::shared_ptr<const KeyframeCloud> cloud;
    Rigid3 T_world_camera;      // As integrated.
    std::vector<bool> refused;  // By point, in the cloud's order; empty: none.
    std::size_t num_refused = 0;
  };

  void Add(Entry& entry);
  void Subtract(const Entry& entry);
  double Shift(const Entry& entry, const Rigid3& T_world_camera) const;

  void Record(std::uint64_t key);
  void RecordMove(const Entry& entry, const Rigid3& T_world_camera);
  void FindChanges();
  void CompactIfSparse();

  Options options_;
  bool records_changes_ = false;
  std::vector<std::uint32_t> changed_;  // Numbers of voxels that were filled or emptied.
  Changes changes_;
  std::map<KeyframeId, Entry> keyframes_;
  std::unique_ptr<VoxelTable> table_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "semslam/base/key_numbers.h"
#include "semslam/segmentation/segmenter.h"

namespace semslam {

// Segments of a voxel map while it grows: again and again the region that has changed most is
// segmented anew, and its segments get the ids of those they take the place of. An id stays with
// its segment while that grows; of segments that turn out to be one the oldest id, which is the
// least, is kept. What a step costs follows the size of a region, not that of the map. Voxels go by
// 64-bit keys: x, y, z in 21 bits each, x in the high ones. Same calls, same ids. Not thread-safe.
class LiveSegmenter {
 public:
  struct Options {
    Segmenter::Options segmentation;
    int block_size = 16;             // Voxels of a cube's side; the map is kept in such cubes.
    std::size_t max_voxels = 25000;  // Of a region. A step costs as much as four fifths of them.
    // How many voxels of a block must have appeared or vanished, and their share in it, before it
    // is worth a step; so is a block most of which is new.
    std::size_t min_changed = 16;
    double min_changed_share = 0.05;
    void Validate() const;  // Throws std::invalid_argument.
  };

  struct Changes {
    std::vector<std::uint64_t> appeared;
    std::vector<std::uint64_t> vanished;
    // From where to where some of the map's points were moved: they take their ids with them.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> moved;
  };

  // Some blocks of the map.
  struct Region {
    std::vector<std::uint64_t> voxels;  // Their keys, block by block.
    std::vector<std::uint64_t> blocks;  // Ascending.
    bool empty() const { return blocks.empty(); }
  };

  explicit LiveSegmenter(const Options& options);

  // Voxels that appeared but are known, or vanished but are not, are no change.
  void Update(const Changes& changes);

  // What lies around the block that has changed most, and around others while there is room; empty
  // if nothing much has changed. There is room as far as the work of a step goes, of which the
  // update takes its part; what the last step took more or less is made good for.
  Region NextRegion() const;
  // The whole map: for when all of it has moved.
  Region WholeMap() const;

  // Segments the region anew; `cloud` has one point for each of its voxels, in their order, not
  // finite for one that is not to be taken. At the region's border, where what lies beyond could
  // tell otherwise, all stays as it was.
  void Segment(const Region& region, const PointCloudView& cloud);

  // 0 for voxels that belong to none or are not known.
  SegmentId IdOf(std::uint64_t voxel) const;
  std::size_t num_segments() const;
  std::size_t num_voxels() const { return num_voxels_; }

 private:
  using VoxelIds = std::vector<std::pair<std::uint64_t, SegmentId>>;
  struct Block {
    VoxelIds voxels;              // Ascending by key.
    std::size_t num_changed = 0;  // Since it was segmented.
    std::size_t rank = 0;         // Its change in `changed_`; 0: not in it.
  };
  // By change, the most first; then by key.
  struct ChangedMore {
    bool operator()(const std::pair<std::size_t, std::uint64_t>& a,
                    const std::pair<std::size_t, std::uint64_t>& b) const {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    }
  };
  class Matching;
  class BlockFinder;

  std::uint64_t BlockOf(std::uint64_t voxel) const;
  bool HasVoxels(std::uint64_t block) const;
  const Block& At(std::uint64_t block) const { return blocks_[numbers_.Find(block)]; }
  Block& At(std::uint64_t block) { return blocks_[numbers_.Find(block)]; }
  std::vector<std::uint64_t> SortedByBlock(const std::vector<std::uint64_t>& voxels,
                                           KeyNumbers& blocks) const;
  void UpdateBlock(std::uint64_t key,
                   std::span<const std::uint64_t> vanished,
                   std::span<const std::uint64_t> appeared);
  void Merge(std::span<const std::uint64_t> vanished,
             std::span<const std::uint64_t> appeared,
             Block& block);
  std::size_t ChangeOf(const Block& block) const;  // 0: not worth a step.
  void Rank(std::uint64_t key, Block& block);      // After its change has changed.
  Region Collect(std::vector<std::uint64_t> blocks) const;
  std::int64_t Allowance() const;
  void Account(std::size_t num_in_region, std::size_t num_segmented);
  bool IsInside(std::uint64_t block, const Region& region) const;
  SegmentId Resolve(SegmentId id) const;
  void Join(SegmentId a, SegmentId b);
  void SetId(std::pair<std::uint64_t, SegmentId>& voxel, SegmentId id);

  Options options_;
  int block_bits_ = 0;
  KeyNumbers numbers_{0};      // Of the blocks.
  std::vector<Block> blocks_;  // By number; those that have lost all voxels stay.
  VoxelIds merged_;            // What a block is merged in; kept to save the allocation.
  // Those worth a step.
  std::set<std::pair<std::size_t, std::uint64_t>, ChangedMore> changed_;
  std::size_t num_voxels_ = 0;
  std::size_t num_updated_ = 0;  // Voxels that the last update told of.
  std::int64_t carried_ = 0;     // Work that the last step left to the next; less than 0: owes it.
  // By id, first that of no segment: the id it was joined to, or itself; and its voxels.
  std::vector<SegmentId> joined_to_ = {0};
  std::vector<std::size_t> num_voxels_of_ = {0};
};

}  // namespace semslam

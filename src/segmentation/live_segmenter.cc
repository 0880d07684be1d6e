// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/segmentation/live_segmenter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "semslam/base/check.h"

#include "segmentation/live_keys.h"

namespace semslam {
namespace {

// Calls visit(key) for the keys around one; at the edge of the key's range those of other blocks,
// kilometres away, are among them, which does no harm.
template <typename Visitor>
void VisitAround(std::uint64_t key, const Visitor& visit) {
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        if (dx == 0 && dy == 0 && dz == 0) continue;
        const std::int64_t step = std::int64_t{dx} * (std::int64_t{1} << (2 * kVoxelAxisBits)) +
                                  std::int64_t{dy} * (std::int64_t{1} << kVoxelAxisBits) + dz;
        visit(key + static_cast<std::uint64_t>(step));
      }
    }
  }
}

std::int64_t SquaredDistance(std::uint64_t a, std::uint64_t b) {
  const auto from = CellOf(a);
  const auto to = CellOf(b);
  std::int64_t sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum += (from[axis] - to[axis]) * (from[axis] - to[axis]);
  }
  return sum;
}

// Work is counted, not timed, so that the same calls give the same regions.
std::int64_t WorkOfStep(std::size_t max_voxels) {
  return static_cast<std::int64_t>(max_voxels - max_voxels / 5);
}

// To take note of a voxel's coming or going, or to look one up, costs so much of segmenting it.
std::int64_t WorkOfBooks(std::size_t num_voxels) {
  constexpr std::size_t kVoxelsForTheWorkOfOne = 8;
  return static_cast<std::int64_t>(num_voxels / kVoxelsForTheWorkOfOne);
}

}  // namespace

void LiveSegmenter::Options::Validate() const {
  segmentation.Validate();
  if (block_size < 2 || !std::has_single_bit(static_cast<unsigned>(block_size))) {
    throw std::invalid_argument("live.block_size: expected a power of two, found " +
                                std::to_string(block_size));
  }
  if (max_voxels == 0) throw std::invalid_argument("live.max_voxels: expected 1 at least, found 0");
  if (!(min_changed_share >= 0 && min_changed_share <= 1)) {
    throw std::invalid_argument("live.min_changed_share: expected a number from 0 to 1, found " +
                                std::to_string(min_changed_share));
  }
}

// Which ids the segments of a region get.
class LiveSegmenter::Matching {
 public:
  // `old_ids` and `segments`: of the region's voxels, before and now; 0 for none.
  Matching(const std::vector<SegmentId>& old_ids,
           const std::vector<SegmentId>& segments,
           std::size_t num_segments)
      : num_in_segment_(num_segments + 1, 0) {
    for (std::size_t i = 0; i < old_ids.size(); ++i) {
      ++num_in_segment_[segments[i]];
      if (old_ids[i] == 0) continue;
      ++num_in_region_[old_ids[i]];
      if (segments[i] != 0) ++shared_[{old_ids[i], segments[i]}];
    }
    // An old segment goes on in the one that has most of it.
    for (const auto& [pair, count] : shared_) {
      auto& [heir, most] = heirs_[pair.first];
      if (count <= most) continue;
      heir = pair.second;
      most = count;
    }
  }

  // By segment, 0 first; may join ids of `live` and adds new ones to it.
  std::vector<SegmentId> Assign(LiveSegmenter& live) const {
    std::vector<SegmentId> ids(num_in_segment_.size(), 0);
    // From the oldest id on, so that it is the one that is kept.
    for (const auto& [old_id, heir] : heirs_) {
      if (!IsMostOf(heir.count, num_in_region_.at(old_id))) continue;
      SegmentId& id = ids[heir.segment];
      if (id == 0) {
        id = old_id;
      } else if (IsMostOf(heir.count, live.num_voxels_of_[old_id])) {
        live.Join(id, old_id);  // All that is known of it is part of the same.
      }
    }
    for (const auto& [pair, count] : shared_) KeepPieces(pair, count, live, ids);
    for (std::size_t segment = 1; segment < ids.size(); ++segment) {
      if (ids[segment] != 0 || num_in_segment_[segment] == 0) continue;
      ids[segment] = static_cast<SegmentId>(live.joined_to_.size());
      live.joined_to_.push_back(ids[segment]);
      live.num_voxels_of_.push_back(0);
    }
    return ids;
  }

 private:
  struct Heir {
    SegmentId segment = 0;
    std::size_t count = 0;
  };

  static bool IsMostOf(std::size_t part, std::size_t whole) { return 2 * part > whole; }

  // Pieces of a segment most of which lies elsewhere may be connected there: they stay what they
  // are.
  void KeepPieces(const std::pair<SegmentId, SegmentId>& pair,
                  std::size_t count,
                  const LiveSegmenter& live,
                  std::vector<SegmentId>& ids) const {
    const auto [old_id, segment] = pair;
    if (ids[segment] != 0 || !IsMostOf(count, num_in_segment_[segment])) return;
    if (IsMostOf(num_in_region_.at(old_id), live.num_voxels_of_[old_id])) return;
    ids[segment] = old_id;
  }

  std::vector<std::size_t> num_in_segment_;
  std::map<SegmentId, std::size_t> num_in_region_;
  std::map<std::pair<SegmentId, SegmentId>, std::size_t> shared_;  // Old, new.
  std::map<SegmentId, Heir> heirs_;
};

LiveSegmenter::LiveSegmenter(const Options& options) : options_(options) {
  options_.Validate();
  block_bits_ = std::countr_zero(static_cast<unsigned>(options_.block_size));
}

std::uint64_t LiveSegmenter::BlockOf(std::uint64_t voxel) const {
  const auto cell = CellOf(voxel);
  return static_cast<std::uint64_t>(cell[0] >> block_bits_) << (2 * kVoxelAxisBits) |
         static_cast<std::uint64_t>(cell[1] >> block_bits_) << kVoxelAxisBits |
         static_cast<std::uint64_t>(cell[2] >> block_bits_);
}

bool LiveSegmenter::HasVoxels(std::uint64_t block) const {
  const std::uint32_t number = numbers_.Find(block);
  return number != KeyNumbers::kNone && !blocks_[number].voxels.empty();
}

SegmentId LiveSegmenter::Resolve(SegmentId id) const {
  while (joined_to_[id] != id) id = joined_to_[id];
  return id;
}

void LiveSegmenter::Join(SegmentId a, SegmentId b) {
  const SegmentId older = std::min(Resolve(a), Resolve(b));
  const SegmentId younger = std::max(Resolve(a), Resolve(b));
  if (older == younger) return;
  joined_to_[younger] = older;
  num_voxels_of_[older] += std::exchange(num_voxels_of_[younger], 0);
}

void LiveSegmenter::SetId(std::pair<std::uint64_t, SegmentId>& voxel, SegmentId id) {
  const SegmentId before = Resolve(voxel.second);
  if (before != 0) --num_voxels_of_[before];
  voxel.second = Resolve(id);
  if (voxel.second != 0) ++num_voxels_of_[voxel.second];
}

std::size_t LiveSegmenter::ChangeOf(const Block& block) const {
  const auto changed = static_cast<double>(block.num_changed);
  const auto size = static_cast<double>(block.voxels.size());
  const bool is_mostly_new = 2 * changed > size;
  const bool is_much =
      block.num_changed >= options_.min_changed && changed >= options_.min_changed_share * size;
  return is_mostly_new || is_much ? block.num_changed : 0;
}

LiveSegmenter::Region LiveSegmenter::Collect(std::vector<std::uint64_t> blocks) const {
  Region region{{}, std::move(blocks)};
  std::sort(region.blocks.begin(), region.blocks.end());
  for (const std::uint64_t block : region.blocks) {
    for (const auto& [key, id] : At(block).voxels) region.voxels.push_back(key);
  }
  return region;
}

void LiveSegmenter::Rank(std::uint64_t key, Block& block) {
  const std::size_t change = ChangeOf(block);
  if (change == block.rank) return;
  if (block.rank > 0) changed_.erase({block.rank, key});
  if (change > 0) changed_.emplace(change, key);
  block.rank = change;
}

// What may be spent on a region, in voxels: the unit of work is to segment one.
std::int64_t LiveSegmenter::Allowance() const {
  return WorkOfStep(options_.max_voxels) + carried_ - WorkOfBooks(num_updated_);
}

// Regions of equal size differ in cost, mostly because the segmenter takes larger voxels where
// points are sparse, as they are where the map is young. So the next region is as much larger or
// smaller as this one cost less or more than it should.
void LiveSegmenter::Account(std::size_t num_in_region, std::size_t num_segmented) {
  const std::int64_t left =
      Allowance() - WorkOfBooks(num_in_region) - static_cast<std::int64_t>(num_segmented);
  const std::int64_t most = WorkOfStep(options_.max_voxels) / 4;  // No step pays for an odd one.
  carried_ = std::clamp(left, -most, most);
}

LiveSegmenter::Region LiveSegmenter::NextRegion() const {
  const auto limit = static_cast<std::int64_t>(options_.max_voxels);
  const auto max_voxels = static_cast<std::size_t>(std::clamp(Allowance(), limit / 2, limit));
  std::vector<std::uint64_t> taken;
  std::set<std::uint64_t> known;
  std::size_t num_voxels = 0;
  for (const auto& [change, start] : changed_) {
    if (!known.insert(start).second) continue;
    // From there over adjacent blocks, the nearest first, as far as the voxels go.
    std::set<std::pair<std::int64_t, std::uint64_t>> open = {{0, start}};
    while (!open.empty()) {
      const std::uint64_t key = open.begin()->second;
      open.erase(open.begin());
      num_voxels += At(key).voxels.size();
      if (num_voxels > max_voxels && !taken.empty()) return Collect(std::move(taken));
      taken.push_back(key);
      VisitAround(key, [&, start = start](std::uint64_t other) {
        if (!HasVoxels(other) || !known.insert(other).second) return;
        open.emplace(SquaredDistance(start, other), other);
      });
    }
  }
  return Collect(std::move(taken));
}

LiveSegmenter::Region LiveSegmenter::WholeMap() const {
  std::vector<std::uint64_t> all;
  all.reserve(blocks_.size());
  for (const std::uint64_t key : numbers_.keys()) {
    if (HasVoxels(key)) all.push_back(key);
  }
  return Collect(std::move(all));
}

bool LiveSegmenter::IsInside(std::uint64_t block, const Region& region) const {
  bool is_inside = true;
  VisitAround(block, [&](std::uint64_t other) {
    is_inside = is_inside && (!HasVoxels(other) || std::binary_search(region.blocks.begin(),
                                                                      region.blocks.end(), other));
  });
  return is_inside;
}

void LiveSegmenter::Segment(const Region& region, const PointCloudView& cloud) {
  SEMSLAM_CHECK(cloud.points.size() == region.voxels.size())
      << cloud.points.size() << " points, " << region.voxels.size() << " voxels";
  const Segmentation found = Segmenter(options_.segmentation).Segment(cloud);
  Account(region.voxels.size(), found.num_voxels);
  std::vector<SegmentId> old_ids;
  old_ids.reserve(region.voxels.size());
  for (const std::uint64_t block : region.blocks) {
    for (const auto& [key, id] : At(block).voxels) old_ids.push_back(Resolve(id));
  }
  SEMSLAM_CHECK(old_ids.size() == region.voxels.size()) << "the map has changed";
  const std::vector<SegmentId> ids =
      Matching(old_ids, found.segment_of_point, found.segments.size()).Assign(*this);

  std::size_t i = 0;
  bool is_any_inside = false;
  for (const std::uint64_t key : region.blocks) {
    Block& block = At(key);
    if (!IsInside(key, region)) {
      i += block.voxels.size();
      continue;
    }
    is_any_inside = true;
    for (auto& voxel : block.voxels) SetId(voxel, ids[found.segment_of_point[i++]]);
    block.num_changed = 0;
    Rank(key, block);
  }
  if (is_any_inside) return;
  // Blocks too full for a region with a border: not again and again.
  for (const std::uint64_t key : region.blocks) {
    At(key).num_changed = 0;
    Rank(key, At(key));
  }
}

SegmentId LiveSegmenter::IdOf(std::uint64_t voxel) const {
  const std::uint64_t block = BlockOf(voxel);
  if (!HasVoxels(block)) return 0;
  const VoxelIds& voxels = At(block).voxels;
  const auto place = Place(voxels, voxel);
  if (place == voxels.end() || place->first != voxel) return 0;
  return Resolve(place->second);
}

std::size_t LiveSegmenter::num_segments() const {
  return static_cast<std::size_t>(std::count_if(num_voxels_of_.begin(), num_voxels_of_.end(),
                                                [](std::size_t n) { return n > 0; }));
}

}  // namespace semslam

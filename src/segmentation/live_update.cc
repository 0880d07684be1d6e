// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <utility>

#include "semslam/base/key_numbers.h"
#include "semslam/segmentation/live_segmenter.h"

#include "segmentation/live_keys.h"
#include "segmentation/radix_sort.h"

namespace semslam {

// Remembers the block of the last voxel: that of the next one is mostly the same.
class LiveSegmenter::BlockFinder {
 public:
  explicit BlockFinder(LiveSegmenter& live) : live_(&live) {}

  // Null if there is none.
  Block* Find(std::uint64_t voxel) {
    const std::uint64_t key = live_->BlockOf(voxel);
    if (block_ != nullptr && key == key_) return block_;
    key_ = key;
    block_ = live_->HasVoxels(key) ? &live_->At(key) : nullptr;
    return block_;
  }
  // Null if it is not known.
  std::pair<std::uint64_t, SegmentId>* FindVoxel(std::uint64_t voxel) {
    Block* block = Find(voxel);
    if (block == nullptr) return nullptr;
    const auto place = Place(block->voxels, voxel);
    return place == block->voxels.end() || place->first != voxel ? nullptr : &*place;
  }

 private:
  LiveSegmenter* live_;
  std::uint64_t key_ = 0;
  Block* block_ = nullptr;
};

void LiveSegmenter::Update(const Changes& changes) {
  BlockFinder finder(*this);
  std::vector<std::pair<std::uint64_t, SegmentId>> carried;
  for (const auto& [from, to] : changes.moved) {
    const auto* voxel = finder.FindVoxel(from);
    if (voxel != nullptr && voxel->second != 0) carried.emplace_back(to, voxel->second);
  }
  KeyNumbers blocks(0);
  const std::vector<std::uint64_t> vanished = SortedByBlock(changes.vanished, blocks);
  const std::vector<std::uint64_t> appeared = SortedByBlock(changes.appeared, blocks);
  num_updated_ = vanished.size() + appeared.size();
  std::size_t v = 0;
  std::size_t a = 0;
  for (const std::uint64_t block : blocks.keys()) {
    const auto of_block = [&](const std::vector<std::uint64_t>& keys, std::size_t& next) {
      const std::size_t first = next;
      while (next < keys.size() && BlockOf(keys[next]) == block) ++next;
      return std::span(keys).subspan(first, next - first);
    };
    UpdateBlock(block, of_block(vanished, v), of_block(appeared, a));
  }
  finder = BlockFinder(*this);  // Blocks have moved.
  for (const auto& [key, id] : carried) {
    auto* voxel = finder.FindVoxel(key);
    if (voxel != nullptr && voxel->second == 0) SetId(*voxel, id);
  }
}

void LiveSegmenter::UpdateBlock(std::uint64_t key,
                                std::span<const std::uint64_t> vanished,
                                std::span<const std::uint64_t> appeared) {
  const std::uint32_t number = numbers_.Insert(key);
  if (number == blocks_.size()) blocks_.emplace_back();
  Block& block = blocks_[number];
  Merge(vanished, appeared, block);
  if (block.voxels.empty()) {
    block.voxels.shrink_to_fit();
    block.num_changed = 0;
  }
  Rank(key, block);
}

// Each once, block by block in the order of their numbers, those of a block by key.
std::vector<std::uint64_t> LiveSegmenter::SortedByBlock(const std::vector<std::uint64_t>& voxels,
                                                        KeyNumbers& blocks) const {
  const std::uint64_t inner = static_cast<std::uint64_t>(options_.block_size) - 1;
  LargeVector<KeyedIndex> order;
  order.reserve(voxels.size());
  std::uint64_t last = 0;
  std::uint64_t number = KeyNumbers::kNone;
  for (const std::uint64_t key : voxels) {
    const std::uint64_t block = BlockOf(key);
    if (number == KeyNumbers::kNone || block != last) number = blocks.Insert(block);
    last = block;
    std::uint64_t place = number;
    for (const std::int64_t c : CellOf(key)) {
      place = place << block_bits_ | (static_cast<std::uint64_t>(c) & inner);
    }
    order.push_back({place, static_cast<std::uint32_t>(order.size())});
  }
  // Few bits, as numbers are small.
  const auto number_bits = static_cast<int>(std::bit_width(blocks.keys().size()));
  RadixSort(order, 3 * block_bits_ + number_bits, 1);
  std::vector<std::uint64_t> sorted;
  sorted.reserve(voxels.size());
  for (const KeyedIndex& item : order) {
    if (sorted.empty() || sorted.back() != voxels[item.index]) sorted.push_back(voxels[item.index]);
  }
  return sorted;
}

void LiveSegmenter::Merge(std::span<const std::uint64_t> vanished,
                          std::span<const std::uint64_t> appeared,
                          Block& block) {
  merged_.clear();
  std::size_t num_removed = 0;
  auto gone = vanished.begin();
  const auto keep_unless_gone = [&](const std::pair<std::uint64_t, SegmentId>& voxel) {
    while (gone != vanished.end() && *gone < voxel.first) ++gone;
    if (gone == vanished.end() || *gone != voxel.first) return merged_.push_back(voxel);
    const SegmentId id = Resolve(voxel.second);
    if (id != 0) --num_voxels_of_[id];
    ++num_removed;
  };
  auto old = block.voxels.cbegin();
  for (const std::uint64_t key : appeared) {
    while (old != block.voxels.cend() && old->first <= key) keep_unless_gone(*old++);
    if (merged_.empty() || merged_.back().first != key) merged_.emplace_back(key, 0);
  }
  std::for_each(old, block.voxels.cend(), keep_unless_gone);
  const std::size_t num_added = merged_.size() + num_removed - block.voxels.size();
  block.voxels.assign(merged_.begin(), merged_.end());
  num_voxels_ += num_added - num_removed;
  block.num_changed += num_added + num_removed;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "dense/voxel_table.h"

#include <algorithm>
#include <limits>

namespace semslam {
namespace {

constexpr std::size_t kMinSlots = 1024;
constexpr std::size_t kMaxLoadNumerator = 4;  // At most 4/5 of the slots are used.
constexpr std::size_t kMaxLoadDenominator = 5;

std::array<std::uint32_t, 3> Weighted(std::uint32_t weight,
                                      const std::array<std::int32_t, 3>& value) {
  return {weight * static_cast<std::uint32_t>(value[0]),
          weight * static_cast<std::uint32_t>(value[1]),
          weight * static_cast<std::uint32_t>(value[2])};
}

}  // namespace

void Voxel::Add(const VoxelSample& sample) {
  const auto position_term = Weighted(sample.weight, sample.position);
  const auto normal_term = Weighted(sample.weight, sample.normal);
  const auto color_term = Weighted(sample.weight, sample.color);
  weight += sample.weight;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    position[axis] += position_term[axis];
    normal[axis] += normal_term[axis];
    color[axis] += color_term[axis];
  }
}

void Voxel::Subtract(const VoxelSample& sample) {
  const auto position_term = Weighted(sample.weight, sample.position);
  const auto normal_term = Weighted(sample.weight, sample.normal);
  const auto color_term = Weighted(sample.weight, sample.color);
  weight -= sample.weight;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    position[axis] -= position_term[axis];
    normal[axis] -= normal_term[axis];
    color[axis] -= color_term[axis];
  }
}

Voxel* VoxelTable::Find(std::uint64_t key) {
  if (slots_.empty()) return nullptr;
  const std::uint32_t number = slots_[SlotOf(key)];
  return number == 0 ? nullptr : &At(number - 1);
}

const Voxel* VoxelTable::Find(std::uint64_t key) const {
  if (slots_.empty()) return nullptr;
  const std::uint32_t number = slots_[SlotOf(key)];
  return number == 0 ? nullptr : &At(number - 1);
}

Voxel* VoxelTable::FindOrCreate(std::uint64_t key, std::size_t max_voxels) {
  if (slots_.empty()) Rehash(kMinSlots);
  std::size_t slot = SlotOf(key);
  const bool full = num_voxels() >= max_voxels;
  if (slots_[slot] != 0) {
    Voxel& found = At(slots_[slot] - 1);
    return found.weight == 0 && full ? nullptr : &found;
  }
  if (full) return nullptr;
  if ((size_ + 1) * kMaxLoadDenominator > slots_.size() * kMaxLoadNumerator) {
    Rehash(slots_.size() * 2);
    slot = SlotOf(key);
  }
  Voxel& voxel = Append(key);
  slots_[slot] = static_cast<std::uint32_t>(size_);
  ++num_empty_;  // Until its first sample.
  return &voxel;
}

std::uint16_t VoxelTable::BeginPass() {
  if (pass_ == std::numeric_limits<std::uint16_t>::max()) {
    for (std::size_t i = 0; i < size_; ++i) At(i).last_pass = 0;
    pass_ = 0;
  }
  return ++pass_;
}

std::size_t VoxelTable::memory_bytes() const {
  return slots_.size() * sizeof(std::uint32_t) + blocks_.size() * sizeof(Block);
}

Voxel& VoxelTable::Append(std::uint64_t key) {
  if (size_ == blocks_.size() * kBlockSize) blocks_.push_back(std::make_unique<Block>());
  Voxel& voxel = At(size_++);
  voxel = Voxel();
  voxel.key_halves = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
  return voxel;
}

std::size_t VoxelTable::SlotOf(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = HomeOf(key);
  while (slots_[slot] != 0 && At(slots_[slot] - 1).key() != key) slot = (slot + 1) & mask;
  return slot;
}

void VoxelTable::Rehash(std::size_t num_slots) {
  slots_.assign(num_slots, 0);
  for (std::size_t i = 0; i < size_; ++i) {
    slots_[SlotOf(At(i).key())] = static_cast<std::uint32_t>(i + 1);
  }
}

void VoxelTable::Compact() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    if (At(i).weight != 0) At(kept++) = At(i);
  }
  size_ = kept;
  num_empty_ = 0;
  blocks_.resize((size_ + kBlockSize - 1) / kBlockSize);
  std::size_t num_slots = kMinSlots;
  while (num_slots * kMaxLoadNumerator < size_ * kMaxLoadDenominator) num_slots *= 2;
  Rehash(num_slots);
}

}  // namespace semslam

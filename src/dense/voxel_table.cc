// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "dense/voxel_table.h"

#include <algorithm>
#include <limits>

namespace semslam {
namespace {

constexpr std::size_t kMinLines = 128;
constexpr std::size_t kMaxOfLine = 9;  // Voxels for each line of slots, on average.
// The lowest bits of x, y and z: keys that are equal but for them share a line.
constexpr std::uint64_t kCubeBits =
    std::uint64_t{1} << 42 | std::uint64_t{1} << 21 | std::uint64_t{1};

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
  if (lines_.empty()) return nullptr;
  const Place place = PlaceOf(key);
  return IsUsed(place) ? &At(lines_[place.line].numbers[place.slot]) : nullptr;
}

const Voxel* VoxelTable::Find(std::uint64_t key) const {
  if (lines_.empty()) return nullptr;
  const Place place = PlaceOf(key);
  return IsUsed(place) ? &At(lines_[place.line].numbers[place.slot]) : nullptr;
}

void VoxelTable::PrefetchVoxel(std::uint64_t key) const {
  const Home home = HomeOf(key);
  const Line& line = lines_[home.line];
  for (std::size_t slot = 0; slot < line.num_used; ++slot) {
    if (line.tags[slot] == home.tag) return __builtin_prefetch(&At(line.numbers[slot]));
  }
}

Voxel* VoxelTable::FindOrCreate(std::uint64_t key, std::size_t max_voxels) {
  if (lines_.empty()) Rehash(kMinLines);
  Place place = PlaceOf(key);
  const bool full = num_voxels() >= max_voxels;
  if (IsUsed(place)) {
    Voxel& found = At(lines_[place.line].numbers[place.slot]);
    return found.weight == 0 && full ? nullptr : &found;
  }
  if (full) return nullptr;
  if (size_ + 1 > lines_.size() * kMaxOfLine) {
    Rehash(lines_.size() * 2);
    place = PlaceOf(key);
  }
  Put(place, static_cast<std::uint32_t>(size_));
  ++num_empty_;  // Until its first sample.
  return &Append(key);
}

std::uint16_t VoxelTable::BeginPass() {
  if (pass_ == std::numeric_limits<std::uint16_t>::max()) {
    for (std::size_t i = 0; i < size_; ++i) At(i).last_pass = 0;
    pass_ = 0;
  }
  return ++pass_;
}

std::size_t VoxelTable::memory_bytes() const {
  return lines_.size() * sizeof(Line) + size_ * sizeof(Voxel);
}

Voxel& VoxelTable::Append(std::uint64_t key) {
  if (size_ == blocks_.size() * kBlockSize) blocks_.emplace_back().reserve(kBlockSize);
  ++size_;
  Voxel& voxel = blocks_.back().emplace_back(Voxel());
  voxel.key_halves = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
  return voxel;
}

VoxelTable::Home VoxelTable::HomeOf(std::uint64_t key) const {
  const std::uint64_t hash = VoxelKey::Hash(key & ~kCubeBits);
  const std::uint64_t place_in_cube = (key >> 40 & 4) | (key >> 20 & 2) | (key & 1);
  return {hash & (lines_.size() - 1), static_cast<std::uint8_t>(hash >> 56 << 3 | place_in_cube)};
}

VoxelTable::Place VoxelTable::PlaceOf(std::uint64_t key) const {
  const std::size_t mask = lines_.size() - 1;
  const Home home = HomeOf(key);
  for (std::size_t i = home.line;; i = (i + 1) & mask) {
    const Line& line = lines_[i];
    for (std::size_t slot = 0; slot < line.num_used; ++slot) {
      if (line.tags[slot] == home.tag && At(line.numbers[slot]).key() == key) {
        return {i, slot, home.tag};
      }
    }
    if (line.num_used < kSlotsOfLine) return {i, line.num_used, home.tag};
  }
}

void VoxelTable::Put(const Place& place, std::uint32_t number) {
  Line& line = lines_[place.line];
  line.numbers[place.slot] = number;
  line.tags[place.slot] = place.tag;
  ++line.num_used;
}

void VoxelTable::Rehash(std::size_t num_lines) {
  lines_.assign(num_lines, Line());
  for (std::size_t i = 0; i < size_; ++i) {
    Put(PlaceOf(At(i).key()), static_cast<std::uint32_t>(i));
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
  if (!blocks_.empty()) blocks_.back().resize(size_ - (blocks_.size() - 1) * kBlockSize);
  std::size_t num_lines = kMinLines;
  while (num_lines * kMaxOfLine < size_) num_lines *= 2;
  Rehash(num_lines);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "semslam/base/large_vector.h"
#include "semslam/dense/voxel_index.h"

namespace semslam {

// One observation's share of a voxel's sums. Everything is small enough that 2^17 observations of
// the largest weight fit into 32 bits; the sums are taken modulo 2^32, so that subtracting undoes
// adding whatever came between.
struct VoxelSample {
  std::uint32_t weight = 0;
  std::array<std::int32_t, 3> position{};  // Within the voxel, 1/256 of its size, [0, 256).
  std::array<std::int32_t, 3> normal{};    // Unit vector times 127.
  std::array<std::int32_t, 3> color{};     // [0, 256).
};

struct Voxel {
  std::array<std::uint32_t, 2> key_halves{};  // Low, high: keeps the size a multiple of 4 only.
  std::uint32_t weight = 0;                   // 0: empty, dropped at the next chance.
  std::array<std::uint32_t, 3> position{};
  std::array<std::uint32_t, 3> normal{};
  std::array<std::uint32_t, 3> color{};
  std::uint16_t num_views = 0;
  std::uint16_t last_pass = 0;  // The pass that counted its view last.

  static constexpr std::uint32_t kToldBit = std::uint32_t{1} << 31;  // Keys have 63 bits.

  std::uint64_t key() const {
    return std::uint64_t{key_halves[1] & ~kToldBit} << 32 | key_halves[0];
  }
  // Whether those who are told of the changes believe it to be there.
  bool is_told() const { return (key_halves[1] & kToldBit) != 0; }
  void ToggleTold() { key_halves[1] ^= kToldBit; }
  void Add(const VoxelSample& sample);
  void Subtract(const VoxelSample& sample);
};
static_assert(sizeof(Voxel) == 52);

// Voxels by key: an open-addressing table of 4-byte numbers into blocks of voxels, so that growing
// moves no voxel and no voxel is a heap object of its own. The map is far larger than the caches,
// so what counts is how much memory a look touches: keys of a small cube, which are mostly wanted
// together, share a cache line of slots, and tags spare the looks at voxels of other keys.
class VoxelTable {
 public:
  // Null if there is none.
  Voxel* Find(std::uint64_t key);
  const Voxel* Find(std::uint64_t key) const;
  // For those who will look for many keys: asks for the memory that Find will look at first, and,
  // once that is there, for the voxel it will most likely find. Never in an empty table.
  void PrefetchSlot(std::uint64_t key) const { __builtin_prefetch(&lines_[HomeOf(key).line]); }
  void PrefetchVoxel(std::uint64_t key) const;
  // Makes an empty one if there is none; null if that would exceed max_voxels.
  Voxel* FindOrCreate(std::uint64_t key, std::size_t max_voxels);

  // A new number for a run over one keyframe's points, to count its view of a voxel once.
  std::uint16_t BeginPass();
  // Tells that a voxel's weight fell to zero.
  void CountEmptied() { ++num_empty_; }
  void CountRefilled() { --num_empty_; }
  // Whether so many voxels are empty that they should be dropped, which Compact does.
  bool IsSparse() const { return num_empty_ * 4 > size_; }
  void Compact();

  // Of a voxel, until the next Compact.
  std::uint32_t NumberOf(std::uint64_t key) const {
    const Place place = PlaceOf(key);
    return lines_[place.line].numbers[place.slot];
  }
  Voxel& At(std::size_t number) { return blocks_[number / kBlockSize][number % kBlockSize]; }
  const Voxel& At(std::size_t number) const {
    return blocks_[number / kBlockSize][number % kBlockSize];
  }

  void Prefetch(std::size_t number) const { __builtin_prefetch(&At(number)); }

  std::size_t num_voxels() const { return size_ - num_empty_; }
  std::size_t memory_bytes() const;

  // Calls visit(const Voxel&) for every voxel that is not empty, in no particular order.
  template <typename Visit>
  void ForEach(Visit&& visit) const {
    for (std::size_t i = 0; i < size_; ++i) {
      const Voxel& voxel = At(i);
      if (voxel.weight != 0) visit(voxel);
    }
  }

 private:
  // Of several huge pages; what is not used yet takes no memory.
  static constexpr std::size_t kBlockSize = std::size_t{1} << 17;
  using Block = LargeVector<Voxel>;

  // A cache line of slots, used from the first on.
  static constexpr std::size_t kSlotsOfLine = 12;
  struct alignas(kCacheLine) Line {
    std::array<std::uint32_t, kSlotsOfLine> numbers{};
    std::array<std::uint8_t, kSlotsOfLine> tags{};
    std::uint32_t num_used = 0;
  };
  struct Home {
    std::size_t line;
    std::uint8_t tag;
  };
  // Of a key, or the free slot where it belongs.
  struct Place {
    std::size_t line;
    std::size_t slot;
    std::uint8_t tag;
  };

  Voxel& Append(std::uint64_t key);
  Home HomeOf(std::uint64_t key) const;
  Place PlaceOf(std::uint64_t key) const;
  bool IsUsed(const Place& place) const { return place.slot < lines_[place.line].num_used; }
  void Put(const Place& place, std::uint32_t number);
  void Rehash(std::size_t num_lines);

  LargeVector<Line> lines_;    // A power of two of them, or none.
  std::vector<Block> blocks_;  // Full but for the last.
  std::size_t size_ = 0;
  std::size_t num_empty_ = 0;
  std::uint16_t pass_ = 0;
};

}  // namespace semslam

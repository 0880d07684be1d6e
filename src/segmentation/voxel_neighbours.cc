// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_neighbours.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <emmintrin.h>

#include "semslam/base/large_vector.h"
#include "semslam/base/parallel.h"

namespace semslam {
namespace {

// Walks the rows of three cells around each voxel along with it: the keys ascend, so that the
// places of the rows in the sorted array only ever move up. Of its own row a voxel stands between
// the two others.
class NeighbourWalk {
 public:
  static constexpr std::size_t kMaxNeighbours = 26;
  static constexpr std::size_t kRoom = kMaxNeighbours + 3;  // It writes three beyond what it finds.

  // `keys` are followed by kNumKeysBeyond that are near none.
  NeighbourWalk(const LargeVector<std::uint64_t>& keys,
                const VoxelKeyLayout& layout,
                std::size_t first)
      : keys_(keys.data()), num_keys_(keys.size() - kNumKeysBeyond) {
    std::size_t row = 0;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        // Two's complement makes the sum right for negative steps too.
        offsets_[row] =
            static_cast<std::uint64_t>(std::int64_t{dz} * (std::int64_t{1} << layout.shift_z) +
                                       std::int64_t{dy} * (std::int64_t{1} << layout.shift_y) - 1);
        places_[row] = static_cast<std::size_t>(
            std::lower_bound(keys_, keys_ + num_keys_, keys_[first] + offsets_[row]) - keys_);
        ++row;
      }
    }
  }

  // Writes the neighbours, ascending, from `found` on, and their bits. Returns the end. Voxels must
  // come one after the other.
  std::uint32_t* Collect(std::size_t voxel, std::uint32_t* found, std::uint32_t& bits) {
    const bool has_left = voxel > 0 && keys_[voxel - 1] + 1 == keys_[voxel];
    const std::uint32_t bits_before = bits_;
    bits_ = 0;
    if (has_left && bits_before != 0) {
      for (int row = 0; row < kOwnRow; ++row) found = ShiftRow(row, voxel, bits_before, found);
      found = CollectOwnRow(voxel, has_left, found);
      for (int row = kOwnRow + 1; row < kNumRows; ++row) {
        found = ShiftRow(row, voxel, bits_before, found);
      }
    } else {
      for (int row = 0; row < kOwnRow; ++row) found = CollectRow(row, voxel, found);
      found = CollectOwnRow(voxel, has_left, found);
      for (int row = kOwnRow + 1; row < kNumRows; ++row) found = CollectRow(row, voxel, found);
    }
    bits = bits_;
    return found;
  }

 private:
  static constexpr int kNumRows = 9;
  static constexpr int kOwnRow = 4;

  // Almost without branches: nobody could predict them.
  std::uint32_t* CollectRow(int row, std::size_t voxel, std::uint32_t* found) {
    const std::uint64_t low = keys_[voxel] + offsets_[row];
    std::size_t place = places_[row];
    place += keys_[place] < low ? 1 : 0;
    place += keys_[place] < low ? 1 : 0;
    while (keys_[place] < low) ++place;
    WriteThree(place, found);
    const std::size_t second = place + (keys_[place] == low ? 1 : 0);
    const std::size_t third = second + (keys_[second] == low + 1 ? 1 : 0);
    const std::size_t end = third + (keys_[third] == low + 2 ? 1 : 0);
    bits_ |= static_cast<std::uint32_t>((second - place) + 2 * (third - second) + 4 * (end - third))
             << (3 * row);
    places_[row] = second;  // The next voxel's row begins farther on.
    return found + (end - place);
  }

  // The same for a voxel beside the last one: two of the three cells are known.
  std::uint32_t* ShiftRow(int row,
                          std::size_t voxel,
                          std::uint32_t bits_before,
                          std::uint32_t* found) {
    const std::size_t place = places_[row];
    WriteThree(place, found);
    const std::uint32_t known = bits_before >> (3 * row + 1) & 3;
    const std::size_t num_known = (known & 1) + (known >> 1);
    const std::uint64_t last_key = keys_[voxel] + offsets_[row] + 2;
    const std::uint32_t has_last = keys_[place + num_known] == last_key ? 1 : 0;
    bits_ |= (known | has_last << 2) << (3 * row);
    places_[row] = place + (known & 1);
    return found + num_known + has_last;
  }

  static void WriteThree(std::size_t first, std::uint32_t* found) {
    _mm_storeu_si128(
        reinterpret_cast<__m128i*>(found),
        _mm_add_epi32(_mm_set1_epi32(static_cast<int>(first)), _mm_setr_epi32(0, 1, 2, 3)));
  }

  std::uint32_t* CollectOwnRow(std::size_t voxel, bool has_left, std::uint32_t* found) {
    const bool has_right = keys_[voxel + 1] == keys_[voxel] + 1;
    *found = static_cast<std::uint32_t>(voxel) - 1;
    found += has_left ? 1 : 0;
    *found = static_cast<std::uint32_t>(voxel) + 1;
    found += has_right ? 1 : 0;
    bits_ |= (has_left ? 0b011U : 0b010U) << (3 * kOwnRow);
    bits_ |= (has_right ? 0b100U : 0U) << (3 * kOwnRow);
    return found;
  }

  const std::uint64_t* keys_;
  std::size_t num_keys_;
  std::array<std::uint64_t, kNumRows> offsets_{};
  std::array<std::size_t, kNumRows> places_{};
  std::uint32_t bits_ = 0;  // Of the last voxel; none before the first.
};

VoxelNeighbours::Chunk FindChunk(std::size_t first, std::size_t last, VoxelGrid& grid) {
  constexpr std::size_t kUsualNeighbours = 16;
  constexpr std::size_t kBatchSize = 512;
  VoxelNeighbours::Chunk chunk;
  chunk.begin.resize(last - first + 1);
  chunk.indices.reserve(kUsualNeighbours * (last - first));
  std::vector<std::uint32_t> batch(NeighbourWalk::kMaxNeighbours * kBatchSize +
                                   NeighbourWalk::kRoom);
  NeighbourWalk walk(grid.keys, grid.layout, first);
  for (std::size_t begin = first; begin < last; begin += kBatchSize) {
    const std::size_t num_before = chunk.indices.size();
    std::uint32_t* end = batch.data();
    for (std::size_t voxel = begin; voxel < std::min(begin + kBatchSize, last); ++voxel) {
      end = walk.Collect(voxel, end, grid.neighbour_bits[voxel]);
      chunk.begin[voxel + 1 - first] =
          static_cast<std::uint32_t>(num_before + (end - batch.data()));
    }
    chunk.indices.insert(chunk.indices.end(), batch.data(), end);
  }
  return chunk;
}

}  // namespace

void FindNeighbours(int num_threads, VoxelGrid& grid) {
  constexpr std::size_t kSize = VoxelNeighbours::kChunkSize;
  std::vector<VoxelNeighbours::Chunk> chunks((grid.size() + kSize - 1) / kSize);
  grid.neighbour_bits.resize(grid.size());
  grid.keys.insert(grid.keys.end(), kNumKeysBeyond, std::numeric_limits<std::uint64_t>::max());
  ParallelFor(chunks.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      chunks[i] = FindChunk(i * kSize, std::min((i + 1) * kSize, grid.size()), grid);
    }
  });
  grid.keys.resize(grid.size());
  grid.neighbours = VoxelNeighbours(std::move(chunks));
}

}  // namespace semslam

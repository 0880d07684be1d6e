// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/seed_cells.h"

#include <algorithm>
#include <array>

#include "semslam/base/key_numbers.h"
#include "semslam/base/parallel.h"

#include "segmentation/voxel_groups.h"

namespace semslam {
namespace {

constexpr int kBits = 21;  // Of an axis; one cell is free below the grid's origin.

std::array<std::uint64_t, 27> KeysAround(std::uint64_t key) {
  std::array<std::uint64_t, 27> keys{};
  std::size_t size = 0;
  for (const std::uint64_t z :
       {key - (std::uint64_t{1} << (2 * kBits)), key, key + (std::uint64_t{1} << (2 * kBits))}) {
    for (const std::uint64_t y :
         {z - (std::uint64_t{1} << kBits), z, z + (std::uint64_t{1} << kBits)}) {
      for (const std::uint64_t x : {y - 1, y, y + 1}) keys[size++] = x;
    }
  }
  return keys;
}

}  // namespace

SeedCells::SeedCells(const VoxelGrid& grid, double spacing, int num_threads)
    : cells_per_metre_(static_cast<float>(1.0 / spacing)), cell_of_voxel_(grid.size()) {
  // Each chunk of the voxels numbers its cells on its own; then the chunks in turn give theirs the
  // numbers of all.
  constexpr std::size_t kNumChunks = 8;
  std::vector<std::vector<std::uint64_t>> keys(kNumChunks);
  const auto for_chunks = [&](const auto& body) {
    ParallelFor(kNumChunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t chunk = begin; chunk < end; ++chunk) {
        body(chunk,
             std::span(cell_of_voxel_)
                 .subspan(grid.size() * chunk / kNumChunks, grid.size() * (chunk + 1) / kNumChunks -
                                                                grid.size() * chunk / kNumChunks));
      }
    });
  };
  for_chunks([&](std::size_t chunk, std::span<std::uint32_t> cells) {
    KeyNumbers numbers(cells.size() / 32);
    const Eigen::Vector3f* centroid =
        grid.centroids.data() + (cells.data() - cell_of_voxel_.data());
    std::uint64_t last_key = 0;  // That of no place.
    std::uint32_t last_number = 0;
    for (std::uint32_t& cell : cells) {
      const std::uint64_t key = KeyOf(*centroid++);
      if (key != last_key) last_number = numbers.Insert(key);
      last_key = key;
      cell = last_number;
    }
    keys[chunk] = numbers.keys();
  });
  KeyNumbers numbers(grid.size() / 32);
  std::vector<std::vector<std::uint32_t>> number_of(kNumChunks);
  for (std::size_t chunk = 0; chunk < kNumChunks; ++chunk) {
    for (const std::uint64_t key : keys[chunk]) number_of[chunk].push_back(numbers.Insert(key));
  }
  for_chunks([&](std::size_t chunk, std::span<std::uint32_t> cells) {
    for (std::uint32_t& cell : cells) cell = number_of[chunk][cell];
  });
  cell_keys_ = numbers.keys();
}

std::uint64_t SeedCells::KeyOf(const Eigen::Vector3f& place) const {
  const Eigen::Vector3f position = place.cwiseMax(0.0F) * cells_per_metre_;
  const auto x = static_cast<std::uint64_t>(position.x()) + 1;
  const auto y = static_cast<std::uint64_t>(position.y()) + 1;
  const auto z = static_cast<std::uint64_t>(position.z()) + 1;
  return z << (2 * kBits) | y << kBits | x;
}

void SeedCells::VisitNear(const std::vector<Eigen::Vector3f>& places,
                          int num_threads,
                          const Visitor& visit) const {
  // First the places of each cell, then of each cell and those around it.
  KeyNumbers homes(places.size());
  std::vector<std::uint32_t> home_of_place;
  for (const Eigen::Vector3f& place : places) home_of_place.push_back(homes.Insert(KeyOf(place)));
  const VoxelGroups at_home = GroupVoxels(home_of_place, homes.keys().size(), 1);

  constexpr std::size_t kGrain = 128;
  ParallelFor(num_cells(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> near;
    for (std::size_t cell = first; cell < last; ++cell) {
      near.clear();
      for (const std::uint64_t key : KeysAround(cell_keys_[cell])) {
        const std::uint32_t home = homes.Find(key);
        if (home == KeyNumbers::kNone) continue;
        const auto members = at_home.Of(home);
        near.insert(near.end(), members.begin(), members.end());
      }
      std::sort(near.begin(), near.end());
      visit(static_cast<std::uint32_t>(cell), near);
    }
  });
}

}  // namespace semslam

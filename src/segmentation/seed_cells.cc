// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/seed_cells.h"

#include <algorithm>

#include "semslam/base/key_numbers.h"

namespace semslam {
namespace {

constexpr int kBits = 21;  // Of an axis; one cell is free below the grid's origin.

}  // namespace

SeedCells::SeedCells(const VoxelGrid& grid, double spacing)
    : cells_per_metre_(static_cast<float>(1.0 / spacing)) {
  KeyNumbers numbers(grid.size() / 32);
  cell_of_voxel_.reserve(grid.size());
  std::uint64_t last_key = 0;  // That of no place.
  std::uint32_t last_number = 0;
  for (const Eigen::Vector3f& centroid : grid.centroids) {
    const std::uint64_t key = KeyOf(centroid);
    if (key != last_key) last_number = numbers.Insert(key);
    last_key = key;
    cell_of_voxel_.push_back(last_number);
  }
  cell_keys_ = numbers.keys();
}

std::uint64_t SeedCells::KeyOf(const Eigen::Vector3f& place) const {
  const Eigen::Vector3f position = place.cwiseMax(0.0F) * cells_per_metre_;
  const auto x = static_cast<std::uint64_t>(position.x()) + 1;
  const auto y = static_cast<std::uint64_t>(position.y()) + 1;
  const auto z = static_cast<std::uint64_t>(position.z()) + 1;
  return z << (2 * kBits) | y << kBits | x;
}

SeedCells::Lists SeedCells::FindNear(const std::vector<Eigen::Vector3f>& places) const {
  // First the places of each cell, then of each cell and those around it.
  KeyNumbers homes(places.size());
  std::vector<std::uint32_t> home_of_place;
  for (const Eigen::Vector3f& place : places) home_of_place.push_back(homes.Insert(KeyOf(place)));
  Lists at_home;
  at_home.begin.assign(homes.keys().size() + 1, 0);
  for (const std::uint32_t home : home_of_place) ++at_home.begin[home + 1];
  for (std::size_t i = 0; i + 1 < at_home.begin.size(); ++i) {
    at_home.begin[i + 1] += at_home.begin[i];
  }
  std::vector<std::uint32_t> next(at_home.begin.begin(), at_home.begin.end() - 1);
  at_home.indices.resize(places.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) at_home.indices[next[home_of_place[i]]++] = i;

  Lists near;
  for (const std::uint64_t key : cell_keys_) {
    const std::size_t begin = near.indices.size();
    for (const std::uint64_t z :
         {key - (std::uint64_t{1} << (2 * kBits)), key, key + (std::uint64_t{1} << (2 * kBits))}) {
      for (const std::uint64_t y :
           {z - (std::uint64_t{1} << kBits), z, z + (std::uint64_t{1} << kBits)}) {
        for (const std::uint64_t x : {y - 1, y, y + 1}) {
          const std::uint32_t home = homes.Find(x);
          if (home == KeyNumbers::kNone) continue;
          const auto members = at_home.Of(home);
          near.indices.insert(near.indices.end(), members.begin(), members.end());
        }
      }
    }
    std::sort(near.indices.begin() + static_cast<std::ptrdiff_t>(begin), near.indices.end());
    near.begin.push_back(static_cast<std::uint32_t>(near.indices.size()));
  }
  return near;
}

}  // namespace semslam

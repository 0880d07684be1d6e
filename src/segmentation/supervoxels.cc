// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/supervoxels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "segmentation/radix_sort.h"

namespace semslam {
namespace {

// First come, first served among equal distances; the distances are rounded to buckets. Two levels
// of bits tell which buckets hold something, so that both ends of the queue are reached in constant
// time.
class BucketQueue {
 public:
  struct Entry {
    std::uint32_t voxel = 0;
    std::uint32_t patch = 0;
  };

  BucketQueue() : buckets_(kNumBuckets) {}

  void Push(float distance, Entry entry) {
    const auto bucket = static_cast<std::size_t>(
        std::min(distance * kBucketsPerUnit, static_cast<float>(kNumBuckets - 1)));
    buckets_[bucket].entries.push_back(entry);
    words_[bucket / kWordBits] |= std::uint64_t{1} << (bucket % kWordBits);
    summary_ |= std::uint64_t{1} << (bucket / kWordBits);
  }

  bool empty() const { return summary_ == 0; }

  Entry Pop() {
    const auto word = static_cast<std::size_t>(std::countr_zero(summary_));
    const auto bit = static_cast<std::size_t>(std::countr_zero(words_[word]));
    Bucket& bucket = buckets_[word * kWordBits + bit];
    const Entry entry = bucket.entries[bucket.next++];
    if (bucket.next == bucket.entries.size()) {
      bucket.entries.clear();
      bucket.next = 0;
      words_[word] &= ~(std::uint64_t{1} << bit);
      if (words_[word] == 0) summary_ &= ~(std::uint64_t{1} << word);
    }
    return entry;
  }

 private:
  struct Bucket {
    std::vector<Entry> entries;
    std::size_t next = 0;
  };
  static constexpr std::size_t kWordBits = 64;
  static constexpr std::size_t kNumBuckets = kWordBits * kWordBits;
  static constexpr float kBucketsPerUnit = 1024;

  std::vector<Bucket> buckets_;
  std::array<std::uint64_t, kWordBits> words_{};
  std::uint64_t summary_ = 0;
};

// Where a patch begins.
struct Centre {
  std::uint32_t start = 0;  // A voxel.
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
};

// Per occupied cell of the seed grid the voxel nearest to the mean of the cell's voxels.
std::vector<Centre> PlaceSeeds(const VoxelGrid& grid, double seed_spacing) {
  const float scale = static_cast<float>(1.0 / seed_spacing);
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& centroid : grid.centroids) high = high.cwiseMax(centroid);
  const auto num_bits = static_cast<int>(
      std::bit_width(static_cast<std::uint64_t>(high.maxCoeff() * scale)));  // Of each axis.
  std::vector<KeyedIndex> items(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector3f position = grid.centroids[i].cwiseMax(0.0F) * scale;
    const auto x = static_cast<std::uint64_t>(position.x());
    const auto y = static_cast<std::uint64_t>(position.y());
    const auto z = static_cast<std::uint64_t>(position.z());
    items[i] = {z << (2 * num_bits) | y << num_bits | x, static_cast<std::uint32_t>(i)};
  }
  RadixSort(items, 3 * num_bits);

  std::vector<Centre> seeds;
  for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (; end < items.size() && items[end].key == items[begin].key; ++end) {
      sum += grid.centroids[items[end].index];
    }
    const Eigen::Vector3f mean = sum / static_cast<float>(end - begin);
    const auto nearest = std::min_element(items.begin() + static_cast<std::ptrdiff_t>(begin),
                                          items.begin() + static_cast<std::ptrdiff_t>(end),
                                          [&](const KeyedIndex& a, const KeyedIndex& b) {
                                            return (grid.centroids[a.index] - mean).squaredNorm() <
                                                   (grid.centroids[b.index] - mean).squaredNorm();
                                          });
    seeds.push_back({nearest->index, grid.centroids[nearest->index]});
  }
  return seeds;
}

class Growth {
 public:
  Growth(const VoxelGrid& grid,
         const std::vector<Eigen::Vector3f>& normals,
         const SupervoxelOptions& options)
      : grid_(grid),
        spatial_factor_(static_cast<float>(options.spatial_weight / options.seed_spacing)),
        normal_factor_(static_cast<float>(options.normal_weight)),
        offset_factor_(static_cast<float>(options.offset_weight / options.seed_spacing)),
        offset_tolerance_(static_cast<float>(options.offset_tolerance)),
        voxels_(grid.size()) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      voxels_[i].position = grid.centroids[i];
      voxels_[i].normal = normals[i];
    }
  }

  std::vector<std::uint32_t> Run(const std::vector<Centre>& centres) {
    for (Voxel& voxel : voxels_) {
      voxel.best_offer = std::numeric_limits<float>::max();
      voxel.patch = kNoPatch;
    }
    BucketQueue queue;
    std::vector<GrowingPatch> patches(centres.size());
    for (std::uint32_t i = 0; i < centres.size(); ++i) {
      patches[i].base = centres[i].position;
      voxels_[centres[i].start].best_offer = 0;
      queue.Push(0, {centres[i].start, i});
    }
    while (!queue.empty()) {
      const BucketQueue::Entry entry = queue.Pop();
      Voxel& voxel = voxels_[entry.voxel];
      if (voxel.patch != kNoPatch) continue;
      voxel.patch = entry.patch;
      patches[entry.patch].Add(voxel.position, voxel.normal);
      OfferToNeighbours(entry, patches[entry.patch], queue);
    }
    std::vector<std::uint32_t> patch_of_voxel(voxels_.size());
    for (std::size_t i = 0; i < voxels_.size(); ++i) patch_of_voxel[i] = voxels_[i].patch;
    return patch_of_voxel;
  }

 private:
  // All that a voxel needs, in half a cache line.
  struct Voxel {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    // The least distance it was offered yet: worse offers need no place in the queue.
    float best_offer = 0;
    std::uint32_t patch = kNoPatch;
  };

  struct GrowingPatch {
    float count = 0;
    Eigen::Vector3f base = Eigen::Vector3f::Zero();  // Sums relative to it keep their digits.
    Eigen::Vector3f position_sum = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal_sum = Eigen::Vector3f::Zero();
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();

    void Add(const Eigen::Vector3f& p, const Eigen::Vector3f& unit_normal) {
      count += 1;
      position_sum += p - base;
      normal_sum += unit_normal;
      mean = base + position_sum / count;
      const float norm = normal_sum.norm();
      if (norm > 0) normal = normal_sum / norm;
    }
  };

  void OfferToNeighbours(const BucketQueue::Entry& entry,
                         const GrowingPatch& patch,
                         BucketQueue& queue) {
    const Eigen::Vector3f mean = patch.mean;
    const Eigen::Vector3f normal = patch.normal;
    for (const std::uint32_t index : grid_.NeighboursOf(entry.voxel)) {
      Voxel& voxel = voxels_[index];
      if (voxel.patch != kNoPatch) continue;
      const float cosine = std::clamp(voxel.normal.dot(normal), -1.0F, 1.0F);
      const Eigen::Vector3f away = voxel.position - mean;
      const float offset = std::max(std::abs(normal.dot(away)) - offset_tolerance_, 0.0F);
      const float distance =
          spatial_factor_ * away.norm() + normal_factor_ * (1 - cosine) + offset_factor_ * offset;
      if (distance >= voxel.best_offer) continue;
      voxel.best_offer = distance;
      queue.Push(distance, {index, entry.patch});
    }
  }

  const VoxelGrid& grid_;
  float spatial_factor_;
  float normal_factor_;
  float offset_factor_;
  float offset_tolerance_;
  std::vector<Voxel> voxels_;
};

// The centres of the grown patches, less those that stayed small.
std::vector<Centre> CentresOf(const VoxelGrid& grid,
                              const std::vector<std::uint32_t>& patch_of_voxel,
                              std::size_t num_patches,
                              std::size_t min_voxels) {
  struct Sum {
    std::size_t count = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    std::uint32_t nearest = 0;
    float distance = std::numeric_limits<float>::max();
  };
  std::vector<Sum> sums(num_patches);
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    if (patch_of_voxel[voxel] == kNoPatch) continue;
    Sum& sum = sums[patch_of_voxel[voxel]];
    ++sum.count;
    sum.position += grid.centroids[voxel].cast<double>();
  }
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    if (patch_of_voxel[voxel] == kNoPatch) continue;
    Sum& sum = sums[patch_of_voxel[voxel]];
    const Eigen::Vector3f mean = (sum.position / static_cast<double>(sum.count)).cast<float>();
    const float distance = (grid.centroids[voxel] - mean).squaredNorm();
    if (distance >= sum.distance) continue;
    sum.distance = distance;
    sum.nearest = static_cast<std::uint32_t>(voxel);
  }
  std::vector<Centre> centres;
  for (const Sum& sum : sums) {
    if (sum.count < std::max<std::size_t>(min_voxels, 1)) continue;
    centres.push_back({sum.nearest, grid.centroids[sum.nearest]});
  }
  return centres;
}

}  // namespace

Supervoxels GrowSupervoxels(const VoxelGrid& grid,
                            const std::vector<Eigen::Vector3f>& normals,
                            const SupervoxelOptions& options) {
  std::vector<Centre> centres = PlaceSeeds(grid, options.seed_spacing);
  Growth growth(grid, normals, options);
  Supervoxels result;
  for (int pass = 0; pass < options.num_passes; ++pass) {
    if (pass > 0) {
      centres = CentresOf(grid, result.patch_of_voxel, centres.size(), options.min_voxels);
    }
    result.patch_of_voxel = growth.Run(centres);
  }
  result.num_patches = static_cast<std::uint32_t>(centres.size());
  return result;
}

}  // namespace semslam

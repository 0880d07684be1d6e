// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/supervoxels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "segmentation/radix_sort.h"

namespace semslam {
namespace {

// First come, first served among equal distances; the distances are rounded to buckets, so that
// both ends of the queue are reached in constant time.
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
    Bucket& target = buckets_[bucket];
    target.entries.push_back(entry);
    lowest_ = std::min(lowest_, bucket);
    ++size_;
  }

  bool empty() const { return size_ == 0; }

  Entry Pop() {
    while (buckets_[lowest_].next == buckets_[lowest_].entries.size()) {
      buckets_[lowest_] = {};
      ++lowest_;
    }
    --size_;
    Bucket& bucket = buckets_[lowest_];
    return bucket.entries[bucket.next++];
  }

 private:
  struct Bucket {
    std::vector<Entry> entries;
    std::size_t next = 0;
  };
  static constexpr std::size_t kNumBuckets = 4096;
  static constexpr float kBucketsPerUnit = 1024;

  std::vector<Bucket> buckets_;
  std::size_t lowest_ = 0;
  std::size_t size_ = 0;
};

// What a patch has gathered so far, and where it begins.
struct Centre {
  std::uint32_t start = 0;  // A voxel.
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

// Per occupied cell of the seed grid the voxel nearest to the mean of the cell's voxels.
std::vector<Centre> PlaceSeeds(const VoxelGrid& grid,
                               const std::vector<Eigen::Vector3f>& normals,
                               double seed_spacing) {
  constexpr int kAxisBits = 21;
  const float scale = static_cast<float>(1.0 / seed_spacing);
  std::vector<KeyedIndex> items(grid.size());
  int num_bits = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector3f position = grid.centroids[i].cwiseMax(0.0F) * scale;
    const auto x = static_cast<std::uint64_t>(position.x());
    const auto y = static_cast<std::uint64_t>(position.y());
    const auto z = static_cast<std::uint64_t>(position.z());
    items[i] = {z << (2 * kAxisBits) | y << kAxisBits | x, static_cast<std::uint32_t>(i)};
    num_bits = std::max(num_bits, z > 0 ? 3 * kAxisBits : 2 * kAxisBits);
  }
  RadixSort(items, num_bits);

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
    seeds.push_back({nearest->index, grid.centroids[nearest->index], normals[nearest->index]});
  }
  return seeds;
}

class Growth {
 public:
  Growth(const VoxelGrid& grid,
         const std::vector<Eigen::Vector3f>& normals,
         const SupervoxelOptions& options)
      : grid_(grid),
        normals_(normals),
        spatial_factor_(static_cast<float>(options.spatial_weight / options.seed_spacing)),
        normal_factor_(static_cast<float>(options.normal_weight)) {}

  std::vector<std::uint32_t> Run(const std::vector<Centre>& centres) {
    std::vector<std::uint32_t> patch_of_voxel(grid_.size(), kNoPatch);
    // The least distance a voxel was offered yet: worse offers need no place in the queue.
    std::vector<float> best_offer(grid_.size(), std::numeric_limits<float>::max());
    BucketQueue queue;
    sums_.assign(centres.size(), {});
    for (std::uint32_t i = 0; i < centres.size(); ++i) {
      sums_[i].mean = centres[i].position;
      sums_[i].direction = centres[i].normal;
      best_offer[centres[i].start] = 0;
      queue.Push(0, {centres[i].start, i});
    }
    while (!queue.empty()) {
      const BucketQueue::Entry entry = queue.Pop();
      if (patch_of_voxel[entry.voxel] != kNoPatch) continue;
      patch_of_voxel[entry.voxel] = entry.patch;
      Sum& sum = sums_[entry.patch];
      sum.Add(grid_.centroids[entry.voxel], normals_[entry.voxel]);
      for (const std::uint32_t other : grid_.NeighboursOf(entry.voxel)) {
        if (patch_of_voxel[other] != kNoPatch) continue;
        const float distance = Distance(sum, other);
        if (distance >= best_offer[other]) continue;
        best_offer[other] = distance;
        queue.Push(distance, {other, entry.patch});
      }
    }
    return patch_of_voxel;
  }

 private:
  struct Sum {
    float count = 0;
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Vector3f direction = Eigen::Vector3f::Zero();

    void Add(const Eigen::Vector3f& p, const Eigen::Vector3f& unit_normal) {
      if (count == 0) {  // Sums relative to the first voxel keep their digits.
        base = p;
      }
      count += 1;
      position += p - base;
      normal += unit_normal;
      mean = base + position / count;
      const float norm = normal.norm();
      if (norm > 0) direction = normal / norm;
    }
    Eigen::Vector3f base = Eigen::Vector3f::Zero();
  };

  float Distance(const Sum& sum, std::uint32_t voxel) const {
    const float spatial = (grid_.centroids[voxel] - sum.mean).norm();
    const float cosine = std::clamp(normals_[voxel].dot(sum.direction), -1.0F, 1.0F);
    return spatial_factor_ * spatial + normal_factor_ * (1 - cosine);
  }

  const VoxelGrid& grid_;
  const std::vector<Eigen::Vector3f>& normals_;
  float spatial_factor_;
  float normal_factor_;
  std::vector<Sum> sums_;
};

// The centres of the grown patches, less those that stayed small.
std::vector<Centre> CentresOf(const VoxelGrid& grid,
                              const std::vector<Eigen::Vector3f>& normals,
                              const std::vector<std::uint32_t>& patch_of_voxel,
                              std::size_t num_patches,
                              std::size_t min_voxels) {
  struct Sum {
    std::size_t count = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    std::uint32_t nearest = 0;
    float distance = std::numeric_limits<float>::max();
  };
  std::vector<Sum> sums(num_patches);
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    if (patch_of_voxel[voxel] == kNoPatch) continue;
    Sum& sum = sums[patch_of_voxel[voxel]];
    ++sum.count;
    sum.position += grid.centroids[voxel].cast<double>();
    sum.normal += normals[voxel];
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
    centres.push_back({sum.nearest, (sum.position / static_cast<double>(sum.count)).cast<float>(),
                       sum.normal.normalized()});
  }
  return centres;
}

}  // namespace

Supervoxels GrowSupervoxels(const VoxelGrid& grid,
                            const std::vector<Eigen::Vector3f>& normals,
                            const SupervoxelOptions& options) {
  std::vector<Centre> centres = PlaceSeeds(grid, normals, options.seed_spacing);
  Growth growth(grid, normals, options);
  Supervoxels result;
  for (int pass = 0; pass < options.num_passes; ++pass) {
    if (pass > 0) {
      centres = CentresOf(grid, normals, result.patch_of_voxel, centres.size(), options.min_voxels);
    }
    result.patch_of_voxel = growth.Run(centres);
  }
  result.num_patches = static_cast<std::uint32_t>(centres.size());
  return result;
}

}  // namespace semslam

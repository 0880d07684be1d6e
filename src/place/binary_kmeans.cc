// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "place/binary_kmeans.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>

namespace semslam {
namespace {

// How often each bit is set among the descriptors added. Bits are spread to a byte each, eight at
// a time, and summed in bytes that are emptied before they overflow.
class BitCounter {
 public:
  void Add(const Descriptor& descriptor) {
    for (int byte = 0; byte < kNumBytes; ++byte) {
      sums_[byte] += Spread((descriptor.bits[byte / 8] >> (8 * (byte % 8))) & 0xff);
    }
    ++count_;
    if (++num_pending_ == 255) Flush();
  }

  std::size_t count() const { return count_; }

  // Bits set in more than half of the descriptors.
  Descriptor Majority() {
    Flush();
    Descriptor majority;
    for (int bit = 0; bit < kDescriptorBits; ++bit) {
      const std::uint64_t is_set = 2 * std::size_t{totals_[bit]} > count_;
      majority.bits[bit / 64] |= is_set << (bit % 64);
    }
    return majority;
  }

 private:
  static constexpr int kNumBytes = kDescriptorBits / 8;

  // Bit i of a byte to byte i.
  static std::uint64_t Spread(std::uint64_t byte) {
    const std::uint64_t bits = (byte * 0x0101010101010101) & 0x8040201008040201;
    // Each byte holds 0 or one bit, which the sum carries to the top.
    return ((bits + 0x7f7f7f7f7f7f7f7f) >> 7) & 0x0101010101010101;
  }

  void Flush() {
    for (int bit = 0; bit < kDescriptorBits; ++bit) {
      totals_[bit] += static_cast<std::uint32_t>((sums_[bit / 8] >> (8 * (bit % 8))) & 0xff);
    }
    sums_.fill(0);
    num_pending_ = 0;
  }

  std::array<std::uint64_t, kNumBytes> sums_{};
  std::array<std::uint32_t, kDescriptorBits> totals_{};
  std::size_t count_ = 0;
  int num_pending_ = 0;
};

// Each next centre is a descriptor drawn with a probability that grows with the square of its
// distance to the nearest centre so far (Arthur and Vassilvitskii 2007).
std::vector<Descriptor> DrawCenters(std::span<const Descriptor> descriptors,
                                    int num_clusters,
                                    Random& random) {
  std::vector<Descriptor> centers{
      descriptors[random.Index(static_cast<std::uint32_t>(descriptors.size()))]};
  std::vector<std::uint32_t> squares(descriptors.size(), std::numeric_limits<std::uint32_t>::max());
  while (static_cast<int>(centers.size()) < num_clusters) {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      const auto distance =
          static_cast<std::uint32_t>(HammingDistance(descriptors[i], centers.back()));
      squares[i] = std::min(squares[i], distance * distance);
      total += squares[i];
    }
    if (total == 0) break;  // Every descriptor is a centre already.
    std::uint64_t left = random() % total;
    std::size_t drawn = 0;
    while (left >= squares[drawn]) left -= squares[drawn++];
    centers.push_back(descriptors[drawn]);
  }
  return centers;
}

// The nearest centre of each descriptor, the first of equals. True if any changed.
bool Assign(std::span<const Descriptor> descriptors,
            const std::vector<Descriptor>& centers,
            std::vector<std::uint16_t>& labels) {
  bool has_changed = false;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    std::uint16_t nearest = 0;
    int nearest_distance = kDescriptorBits + 1;
    for (std::size_t c = 0; c < centers.size(); ++c) {
      const int distance = HammingDistance(descriptors[i], centers[c]);
      if (distance < nearest_distance) {
        nearest = static_cast<std::uint16_t>(c);
        nearest_distance = distance;
      }
    }
    has_changed |= labels[i] != nearest;
    labels[i] = nearest;
  }
  return has_changed;
}

// Centres without members stay where they are.
void MoveCenters(std::span<const Descriptor> descriptors,
                 const std::vector<std::uint16_t>& labels,
                 std::vector<Descriptor>& centers) {
  std::vector<BitCounter> counters(centers.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) counters[labels[i]].Add(descriptors[i]);
  for (std::size_t c = 0; c < centers.size(); ++c) {
    if (counters[c].count() > 0) centers[c] = counters[c].Majority();
  }
}

// Sorts descriptors by label, and drops centres without members.
std::vector<Cluster> Gather(std::span<Descriptor> descriptors,
                            const std::vector<std::uint16_t>& labels,
                            const std::vector<Descriptor>& centers) {
  const std::vector<Descriptor> unsorted(descriptors.begin(), descriptors.end());
  std::vector<std::size_t> ends(centers.size() + 1, 0);
  for (const std::uint16_t label : labels) ++ends[label + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
  for (std::size_t i = 0; i < unsorted.size(); ++i) descriptors[next[labels[i]]++] = unsorted[i];
  std::vector<Cluster> clusters;
  for (std::size_t c = 0; c < centers.size(); ++c) {
    const std::span<Descriptor> members = descriptors.subspan(ends[c], ends[c + 1] - ends[c]);
    if (!members.empty()) clusters.push_back({centers[c], members});
  }
  return clusters;
}

}  // namespace

std::vector<Cluster> ClusterBinary(std::span<Descriptor> descriptors,
                                   int num_clusters,
                                   int max_iterations,
                                   Random& random) {
  if (descriptors.empty()) return {};
  std::vector<Descriptor> centers = DrawCenters(descriptors, num_clusters, random);
  std::vector<std::uint16_t> labels(descriptors.size(), std::numeric_limits<std::uint16_t>::max());
  for (int i = 0; i < max_iterations && Assign(descriptors, centers, labels); ++i) {
    MoveCenters(descriptors, labels, centers);
  }
  Assign(descriptors, centers, labels);
  return Gather(descriptors, labels, centers);
}

}  // namespace semslam

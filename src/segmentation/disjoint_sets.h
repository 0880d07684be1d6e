// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace semslam {

// Union-find whose representative is the least member, so that the order of the joins has no
// effect.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::uint32_t Find(std::uint32_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

  // Looks only one step far: false does not mean that it is not.
  bool IsKnownToBeOf(std::uint32_t member, std::uint32_t representative) const {
    return parent_[member] == representative;
  }

  void Join(std::uint32_t a, std::uint32_t b) { JoinRepresentatives(Find(a), Find(b)); }

  // The same for two that are known to represent their sets; returns who represents both.
  std::uint32_t JoinRepresentatives(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t least = std::min(a, b);
    parent_[std::max(a, b)] = least;
    return least;
  }

  // As Find, but changes nothing: several threads may ask.
  std::uint32_t Representative(std::uint32_t member) const {
    while (parent_[member] != member) member = parent_[member];
    return member;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace semslam

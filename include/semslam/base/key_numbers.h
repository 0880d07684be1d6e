// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace semslam {

// Numbers 64-bit keys in the order in which they come; open addressing.
class KeyNumbers {
 public:
  explicit KeyNumbers(std::size_t expected) : slots_(std::bit_ceil(2 * expected + 16)) {}

  // The key's number; that of the next new one if it is not known yet.
  std::uint32_t Insert(std::uint64_t key) {
    Slot& slot = slots_[Place(key)];
    if (slot.number == kNone) {
      slot = {key, static_cast<std::uint32_t>(keys_.size())};
      keys_.push_back(key);
      if (2 * keys_.size() > slots_.size()) {
        Grow();
        return static_cast<std::uint32_t>(keys_.size() - 1);
      }
    }
    return slot.number;
  }

  // kNone if it is not known.
  std::uint32_t Find(std::uint64_t key) const { return slots_[Place(key)].number; }

  const std::vector<std::uint64_t>& keys() const { return keys_; }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kNone;
  };

  // Where the key is or would be put.
  std::size_t Place(std::uint64_t key) const {
    constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15ULL;  // Of the golden ratio.
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = (key * kFactor >> 24) & mask;
    while (slots_[place].number != kNone && slots_[place].key != key) place = (place + 1) & mask;
    return place;
  }

  void Grow() {
    slots_.assign(2 * slots_.size(), {});
    for (std::uint32_t i = 0; i < keys_.size(); ++i) slots_[Place(keys_[i])] = {keys_[i], i};
  }

  std::vector<Slot> slots_;
  std::vector<std::uint64_t> keys_;
};

}  // namespace semslam

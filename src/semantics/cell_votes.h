// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "semslam/base/key_numbers.h"

#include "semantics/cell.h"

namespace semslam {

inline constexpr std::uint32_t kMinVotes = 3;  // Boxes that hold a cell.

// Where a thing lies. Both ascending.
struct Place {
  std::vector<Cell> core;   // Cells that most of its boxes hold,
  std::vector<Cell> reach;  // and all that some do: downhill from the core.
};

// How many boxes hold each cell; each of these votes for its cells.
class CellVotes {
 public:
  // All cells of one box, in any order; each counts once.
  void AddBox(std::span<const Cell> cells);

  // The place around the most voted cell (the first of several); and removes its votes. Nothing if
  // no cell has enough.
  std::optional<Place> TakePlace();

 private:
  template <typename MayStep>
  std::vector<std::uint32_t> Flood(std::uint32_t start, const MayStep& may_step) const;
  std::vector<Cell> CellsOf(const std::vector<std::uint32_t>& numbers) const;

  // By the cells' numbers.
  KeyNumbers numbers_{256};
  std::vector<std::uint32_t> votes_;     // 0: taken.
  std::vector<std::uint32_t> last_box_;  // That voted.
  std::uint32_t num_boxes_ = 0;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/cell_votes.h"

#include <algorithm>

namespace semslam {
namespace {

constexpr std::uint32_t kMinVotesInReach = 2;  // One box alone may be wrong.
constexpr double kMinShareOfVotesInReach = 0.25;
constexpr double kMinShareOfVotes = 0.5;  // Of the most voted cell of the same thing.

}  // namespace

void CellVotes::AddBox(std::span<const Cell> cells) {
  ++num_boxes_;
  for (const Cell cell : cells) {
    const std::uint32_t number = numbers_.Insert(cell);
    if (number == votes_.size()) {
      votes_.push_back(0);
      last_box_.push_back(0);
    }
    if (last_box_[number] == num_boxes_) continue;
    last_box_[number] = num_boxes_;
    ++votes_[number];
  }
}

// The cells that can be reached from `start` by steps that `may_step` allows.
template <typename MayStep>
std::vector<std::uint32_t> CellVotes::Flood(std::uint32_t start, const MayStep& may_step) const {
  std::vector<bool> is_reached(votes_.size(), false);
  is_reached[start] = true;
  std::vector<std::uint32_t> reached = {start};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const std::uint32_t from = reached[i];
    ForEachNeighbour(numbers_.keys()[from], [&](Cell next) {
      const std::uint32_t to = numbers_.Find(next);
      if (to == KeyNumbers::kNone || is_reached[to] || votes_[to] == 0) return;
      if (!may_step(votes_[from], votes_[to])) return;
      is_reached[to] = true;
      reached.push_back(to);
    });
  }
  return reached;
}

std::vector<Cell> CellVotes::CellsOf(const std::vector<std::uint32_t>& numbers) const {
  std::vector<Cell> cells;
  cells.reserve(numbers.size());
  for (const std::uint32_t number : numbers) cells.push_back(numbers_.keys()[number]);
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::optional<Place> CellVotes::TakePlace() {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < votes_.size(); ++i) {
    const bool is_before = numbers_.keys()[i] < numbers_.keys()[best];
    if (votes_[i] > votes_[best] || (votes_[i] == votes_[best] && is_before)) best = i;
  }
  if (votes_.empty() || votes_[best] < kMinVotes) return std::nullopt;
  const auto most = static_cast<double>(votes_[best]);
  const double min_votes = std::max<double>(kMinVotes, kMinShareOfVotes * most);
  const double min_reach = std::max<double>(kMinVotesInReach, kMinShareOfVotesInReach * most);
  Place place;
  place.core =
      CellsOf(Flood(best, [&](std::uint32_t, std::uint32_t to) { return to >= min_votes; }));
  place.reach = CellsOf(Flood(best, [&](std::uint32_t from, std::uint32_t to) {
    return to >= min_reach && (to <= from || to >= min_votes);
  }));
  const std::vector<std::uint32_t> slope = Flood(
      best, [&](std::uint32_t from, std::uint32_t to) { return to <= from || to >= min_votes; });
  for (const std::uint32_t number : slope) votes_[number] = 0;
  return place;
}

}  // namespace semslam

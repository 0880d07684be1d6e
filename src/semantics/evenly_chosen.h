// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace semslam {

// All items of a vector or span if they are few, else every n-th, so that they are `max_count` or
// less.
template <typename Items>
std::vector<typename Items::value_type> EvenlyChosen(const Items& items, std::size_t max_count) {
  const std::size_t step = std::max<std::size_t>(1, (items.size() + max_count - 1) / max_count);
  std::vector<typename Items::value_type> chosen;
  for (std::size_t i = 0; i < items.size(); i += step) chosen.push_back(items[i]);
  return chosen;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/huffman.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace semslam {
namespace {

// Joins the two rarest nodes of a tree until one is left. Leaves, from the rarest on, are nodes 0
// to counts.size() - 1; joined nodes follow, and become more frequent as well.
std::vector<int> DepthsOfLeaves(const std::vector<std::uint32_t>& counts) {
  const std::size_t num_leaves = counts.size();
  std::vector<std::uint32_t> weights = counts;
  std::vector<std::size_t> parents(2 * num_leaves - 1, 0);
  std::size_t leaf = 0;
  std::size_t joined = num_leaves;
  const auto take_rarest = [&] {
    const bool is_leaf =
        leaf < num_leaves && (joined == weights.size() || weights[leaf] <= weights[joined]);
    return is_leaf ? leaf++ : joined++;
  };
  while (weights.size() < parents.size()) {
    const std::size_t first = take_rarest();
    const std::size_t second = take_rarest();
    parents[first] = parents[second] = weights.size();
    weights.push_back(weights[first] + weights[second]);
  }
  std::vector<int> depths(parents.size(), 0);  // The root, which is the last one, has depth 0.
  for (std::size_t i = parents.size() - 1; i-- > 0;) depths[i] = depths[parents[i]] + 1;
  depths.resize(num_leaves);
  return depths;
}

// Of each symbol; 0 for those that do not occur.
std::vector<int> CodeLengths(const std::vector<std::uint32_t>& counts, int max_length) {
  std::vector<std::pair<std::uint32_t, std::size_t>> order;  // Count, symbol.
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) order.emplace_back(counts[i], i);
  }
  std::sort(order.begin(), order.end());
  std::vector<int> lengths(counts.size(), 0);
  if (order.size() == 1) {  // A code has one bit at least.
    lengths[order.front().second] = 1;
    return lengths;
  }
  std::vector<std::uint32_t> sorted;
  for (const auto& [count, symbol] : order) sorted.push_back(count);
  std::vector<int> depths = DepthsOfLeaves(sorted);
  // Too long codes get shorter if the counts differ less.
  while (*std::max_element(depths.begin(), depths.end()) > max_length) {
    for (std::uint32_t& count : sorted) count = (count + 1) / 2;
    depths = DepthsOfLeaves(sorted);
  }
  for (std::size_t i = 0; i < order.size(); ++i) lengths[order[i].second] = depths[i];
  return lengths;
}

std::uint16_t Reversed(unsigned bits, int length) {
  unsigned result = 0;
  for (int i = 0; i < length; ++i) result |= (bits >> i & 1U) << (length - 1 - i);
  return static_cast<std::uint16_t>(result);
}

}  // namespace

std::vector<HuffmanCode> MakeHuffmanCodes(const std::vector<std::uint32_t>& counts,
                                          int max_length) {
  const std::vector<int> lengths = CodeLengths(counts, max_length);
  std::vector<HuffmanCode> codes(counts.size());
  unsigned next = 0;
  for (int length = 1; length <= max_length; ++length) {
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (lengths[i] != length) continue;
      codes[i] = {Reversed(next++, length), static_cast<std::uint16_t>(length)};
    }
    next <<= 1;
  }
  return codes;
}

}  // namespace semslam

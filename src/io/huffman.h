// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace semslam {

// The code of a symbol, as it goes into a stream whose bits are filled from the lowest on.
struct HuffmanCode {
  std::uint16_t bits = 0;
  std::uint16_t length = 0;  // 0: the symbol does not occur.
};

// The best code for symbols that occur `counts` times, none longer than `max_length` (for which it
// may be a little worse than the best): lengths by Huffman's algorithm, bits in canonical order
// (RFC 1951, 3.2.2). `counts`: some above 0, in all below 2^31; at most 2^max_length of them.
std::vector<HuffmanCode> MakeHuffmanCodes(const std::vector<std::uint32_t>& counts, int max_length);

}  // namespace semslam

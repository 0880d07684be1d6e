// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace semslam {

// Compresses bytes to a zlib stream (RFC 1950 and 1951), some times faster than zlib does it:
// Huffman codes of single bytes and, if `find_runs`, of runs of one byte. Nothing else is searched:
// of pictures, filtered for PNG, it would find little.
std::string Deflate(const std::vector<std::uint8_t>& bytes, bool find_runs);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace semslam {

// The byte code of compressed PCD files, known as LZF. A byte c < 32: c + 1 literal bytes follow.
// Else it repeats earlier output: the upper 3 bits are the length - 2 (7: the next byte is added to
// it), the lower 5 bits and the next byte the distance - 1. (Written here because PCL's copy of it
// lives in a library that loads VTK and some sixty others.)
std::string CompressLzf(std::string_view bytes);

// Nothing unless the code is valid and gives exactly `size` bytes.
std::optional<std::string> DecompressLzf(std::string_view code, std::size_t size);

}  // namespace semslam

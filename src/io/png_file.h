// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace semslam {

// What the header of a PNG file says.
struct PngHeader {
  int width = 0;
  int height = 0;
  int bit_depth = 0;     // Of a channel, or of a palette index.
  int num_channels = 0;  // 1 for grey and for palette images.
  bool has_palette = false;
};

// Walks over all chunks of a PNG file, checks their lengths and check sums up to the end mark, and
// returns the header. OpenCV's reader may fill the missing part of a truncated file with zeros, and
// libpng prints to the console. Throws InputError whose text starts with `name`.
PngHeader CheckPng(const std::string& name, std::string_view bytes);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace semslam {

struct PcdField {
  std::string name;
  char type = 'F';        // F: float, U: unsigned, I: signed.
  std::size_t size = 4;   // Bytes of a value.
  std::size_t count = 1;  // Values of a point.
};

enum class PcdEncoding { kAscii, kBinary, kCompressed };

struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t num_points = 0;
  PcdEncoding encoding = PcdEncoding::kAscii;
  std::size_t data_start = 0;  // Byte after the header.

  std::size_t PointSize() const;  // Bytes.
};

// Parses the header of a PCD file (PCL's own reader crashes on an empty file, on noise and on
// negative sizes, and asks for the memory of any number of points); `name` stands in the messages
// of InputError.
PcdHeader ParsePcdHeader(const std::string& name, std::string_view bytes);

}  // namespace semslam

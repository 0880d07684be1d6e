// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "semslam/io/cloud_io.h"

namespace semslam {

// One number of every point, as four bytes, for a file.
struct CloudColumn {
  std::string name;
  char type = 'F';  // F: 32-bit float, U: 32-bit unsigned.
  void (*write)(const CloudView& cloud, std::size_t point, char* four_bytes) = nullptr;
};

// Checks the lengths of all columns (std::logic_error).
void CheckLengths(const CloudView& cloud);

// The columns of these groups that the cloud has, in the order of the groups.
std::vector<CloudColumn> PositionColumns();
std::vector<CloudColumn> NormalColumns(const CloudView& cloud,
                                       const std::string& x,
                                       const std::string& y,
                                       const std::string& z);
std::vector<CloudColumn> PackedColorColumn(const CloudView& cloud);
std::vector<CloudColumn> LabelColumns(const CloudView& cloud);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace semslam {

// A file of src/io/report, as it was when the library was built.
struct PageFile {
  const char* name;
  const char* text;
};

// By name with ending. The build writes page_files.cc.
std::span<const PageFile> PageFiles();

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "semslam/base/embedded_text.h"

namespace semslam {

// The files of src/io/report, by name with ending. The build writes page_files.cc.
std::span<const EmbeddedText> PageFiles();

}  // namespace semslam

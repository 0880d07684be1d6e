// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "semslam/semantics/class_table.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// The detections in a JSON text as RecordedDetector describes it; boxes in pixels. Throws
// InputError that names `file` and the entry.
std::vector<Detection> ParseJsonDetections(const std::string& text,
                                           const std::string& file,
                                           const ClassTable& classes);

}  // namespace semslam

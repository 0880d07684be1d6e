// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "semslam/base/binary_stream.h"
#include "semslam/semantics/class_table.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// Names and interest; the rest follows from the names.
void WriteClassTable(const ClassTable& classes, BinaryWriter* writer);
// Throws InputError if the bytes are no class table.
ClassTable ReadClassTable(BinaryReader* reader);

void WriteDetections(const std::vector<Detection>& detections, BinaryWriter* writer);
// Throws InputError for detections that no network of so many classes makes.
std::vector<Detection> ReadDetections(BinaryReader* reader, std::size_t num_classes);

}  // namespace semslam

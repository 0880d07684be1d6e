// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "semslam/base/time.h"
#include "semslam/io/tum_dataset.h"

namespace semslam {

// The pairs of an associations file, in its order, which must be that of time.
std::vector<TumDataset::Entry> ReadAssociations(const std::filesystem::path& sequence,
                                                const std::filesystem::path& associations);

// The pairs of rgb.txt and depth.txt that lie within the time difference: nearest first, each image
// once; in the order of time.
std::vector<TumDataset::Entry> AssociateByTime(const std::filesystem::path& sequence,
                                               TimeNs max_time_difference);

}  // namespace semslam

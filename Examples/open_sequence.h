// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

#include "semslam/config/settings.h"
#include "semslam/io/tum_dataset.h"

// A recorded sequence of the settings' camera. `associations` as TumDataset understands it.
inline semslam::TumDataset OpenSequence(const std::filesystem::path& folder,
                                        const std::filesystem::path& associations,
                                        const semslam::Settings& settings) {
  semslam::TumDataset::Options options;
  options.width = settings.camera.width;
  options.height = settings.camera.height;
  options.depth_factor = settings.depth_factor;
  return {folder, associations, options};
}

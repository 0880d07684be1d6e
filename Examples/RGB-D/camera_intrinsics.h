// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <optional>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/config/settings.h"

#include "progress_line.h"

// The settings to go on with: with the camera's own field of view if that is asked for, and then
// warned about, for it is not calibrated. Warns too if the settings' focal lengths look like those
// of another camera. Throws semslam::InputError if the camera gives no field of view.
semslam::Settings WithIntrinsics(const semslam::Settings& settings,
                                 const std::filesystem::path& settings_path,
                                 const std::optional<semslam::PinholeCamera::Parameters>& nominal,
                                 bool use_nominal,
                                 ProgressLine& progress);

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/render/scene_file.h"

namespace semslam {

// The scenes that come with the library: the files of config/scenes, built in.
std::vector<std::string> SceneNames();
// The text of its file. Throws InputError if there is no such scene.
std::string SceneText(const std::string& name);
// One of SceneNames(), or the path of a scene file (docs/scene-files.md). Painted, on `num_threads`
// as ParallelFor. Throws InputError if there is no such scene, or the file is wrong.
StagedScene MakeScene(const std::string& name_or_path, std::uint64_t seed, int num_threads = 0);

// The cameras of the TUM RGB-D benchmark's freiburg1 (with lens distortion) and freiburg3
// sequences, and an uncalibrated Xtion: TUM1, TUM3, Xtion. Throws InputError if there is no such
// camera.
std::vector<std::string> CameraNames();
PinholeCamera::Parameters CameraByName(const std::string& name);

}  // namespace semslam

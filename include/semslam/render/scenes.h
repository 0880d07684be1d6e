// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/render/camera_path.h"
#include "semslam/render/scene.h"

namespace semslam {

// A scene and the way a camera goes through it.
struct StagedScene {
  Scene scene;
  CameraPath path;
};

// A desk at a wall with the objects of objects.h, and a camera that sweeps before it at 0.8 to 1.6
// m. The seed moves the objects and the camera, and picks colours and prints.
StagedScene MakeDeskScene(std::uint64_t seed);

// Nothing but a wall full of posters and sheets, which the camera passes at about 1.2 m.
StagedScene MakeWallScene(std::uint64_t seed);

// The scenes that MakeScene knows.
std::vector<std::string> SceneNames();
// Throws InputError if there is no such scene.
StagedScene MakeScene(const std::string& name, std::uint64_t seed);

// The cameras of the TUM RGB-D benchmark's freiburg1 (with lens distortion) and freiburg3
// sequences, and an uncalibrated Xtion: TUM1, TUM3, Xtion. Throws InputError if there is no such
// camera.
std::vector<std::string> CameraNames();
PinholeCamera::Parameters CameraByName(const std::string& name);

}  // namespace semslam

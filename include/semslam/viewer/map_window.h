// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "semslam/viewer/map_scene.h"

namespace semslam {

struct MapWindowOptions {
  std::string title = "semslam";
  int width = 1280;  // Pixels.
  int height = 800;
  ColorMode color = ColorMode::kPhoto;
  // Asked a few times a second: true closes the window. May be empty.
  std::function<bool()> should_close;
};

// Shows a map in a window until it is closed. The mouse turns, moves (right button, or with shift)
// and zooms (wheel); a click on an object tells about it. Throws InputError if there is no screen
// or no OpenGL 3.3. One window at a time in a process.
void ShowMap(const MapScene& scene, const MapWindowOptions& options);

}  // namespace semslam

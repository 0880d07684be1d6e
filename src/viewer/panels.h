// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "semslam/viewer/map_scene.h"
#include "semslam/viewer/orbit_camera.h"

namespace semslam {

// What the user chose in the panels of a window.
struct ViewChoices {
  ColorMode color = ColorMode::kPhoto;
  OverlayOptions overlay;
  bool eye_dome = true;
};

// Parts of panels; called between the begin and end of one. True where something was changed.
bool ChooseColors(ColorMode* color);
// Buttons of viewpoints; turns the camera, and the caller fits it.
bool ChooseViewpoint(OrbitCamera* camera);
// The objects, one a line; a click selects one, or with a second click none.
bool ChooseObject(std::span<const ObjectRecord> objects,
                  std::span<const ClassRecord> classes,
                  std::optional<std::uint32_t>* selected);
void TellObject(const ObjectRecord& object, std::span<const ClassRecord> classes);
// A line of a table: name on the left, value on the right.
void TellFact(const char* name, const std::string& value);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace semslam {

// A file of config/scenes, as it was when the library was built.
struct BuiltInScene {
  const char* name;
  const char* text;
};

// By name. The build writes built_in_scenes.cc.
std::span<const BuiltInScene> BuiltInScenes();

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "semslam/base/embedded_text.h"

namespace semslam {

// The files of config/scenes, by name. The build writes built_in_scenes.cc.
std::span<const EmbeddedText> BuiltInScenes();

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "semslam/render/camera_path.h"
#include "semslam/render/scene.h"

namespace semslam {

// A scene and the way a camera goes through it.
struct StagedScene {
  Scene scene;
  CameraPath path;
};

// Reads a scene from its text in YAML; docs/scene-files.md describes it. What the text leaves open,
// the seed decides: the same text and seed give the same scene on every machine. The scene's
// materials are not painted yet: Scene::Paint does it.
// Throws InputError "FILE:LINE: WHERE: expected ..., found ..." for what is no such text; `file` is
// only for that. Whatever the text, it takes bounded time and memory.
StagedScene ParseScene(const std::string& text, const std::string& file, std::uint64_t seed);

// The same from a file, painted. Throws InputError if it cannot be read, too.
StagedScene LoadScene(const std::filesystem::path& path, std::uint64_t seed, int num_threads = 0);

}  // namespace semslam

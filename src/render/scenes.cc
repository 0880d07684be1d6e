// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/scenes.h"

#include "semslam/base/error.h"

#include "render/built_in_scenes.h"
#include "render/scene_node.h"

namespace semslam {
namespace {

bool IsPath(const std::string& scene) { return scene.find_first_of("./\\") != std::string::npos; }

}  // namespace

std::vector<std::string> SceneNames() {
  std::vector<std::string> names;
  for (const EmbeddedText& scene : BuiltInScenes()) names.emplace_back(scene.name);
  return names;
}

std::string SceneText(const std::string& name) {
  for (const EmbeddedText& scene : BuiltInScenes()) {
    if (name == scene.name) return scene.text;
  }
  throw InputError("scene " + name + ": unknown, expected one of " + JoinNames(SceneNames()) +
                   " or a .yaml file");
}

StagedScene MakeScene(const std::string& name_or_path, std::uint64_t seed, int num_threads) {
  if (IsPath(name_or_path)) return LoadScene(name_or_path, seed, num_threads);
  StagedScene staged = ParseScene(SceneText(name_or_path), name_or_path + ".yaml", seed);
  staged.scene.Paint(num_threads);
  return staged;
}

std::vector<std::string> CameraNames() { return {"TUM1", "TUM3", "Xtion"}; }

PinholeCamera::Parameters CameraByName(const std::string& name) {
  if (name == "TUM1") {
    return {.fx = 517.306408,
            .fy = 516.469215,
            .cx = 318.643040,
            .cy = 255.313989,
            .k1 = 0.262383,
            .k2 = -0.953104,
            .p1 = -0.005358,
            .p2 = 0.002628,
            .k3 = 1.163314};
  }
  if (name == "TUM3") return {.fx = 535.4, .fy = 539.2, .cx = 320.1, .cy = 247.6};
  if (name == "Xtion") return {.fx = 525.0, .fy = 525.0, .cx = 319.5, .cy = 239.5};
  throw InputError("camera " + name + ": unknown, expected one of " + JoinNames(CameraNames()));
}

}  // namespace semslam

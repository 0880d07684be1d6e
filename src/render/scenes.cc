// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/scenes.h"

#include "semslam/base/error.h"

namespace semslam {
namespace {

std::string Listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

std::vector<std::string> SceneNames() { return {"desk", "wall"}; }

StagedScene MakeScene(const std::string& name, std::uint64_t seed) {
  if (name == "desk") return MakeDeskScene(seed);
  if (name == "wall") return MakeWallScene(seed);
  throw InputError("scene " + name + ": unknown, expected one of " + Listed(SceneNames()));
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
  throw InputError("camera " + name + ": unknown, expected one of " + Listed(CameraNames()));
}

}  // namespace semslam

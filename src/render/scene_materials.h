// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "semslam/render/scene.h"

#include "render/scene_node.h"
#include "render/scene_values.h"

namespace semslam {

// The materials that a scene file defines by name, and the reading of those it uses.
class MaterialShelf {
 public:
  // The file's map of name to material.
  void Define(const SceneNode& materials, SceneDice& dice);

  // The name of a defined one, a plain colour '#rrggbb', or a map: pattern, color, second, scale,
  // contrast, specular, shininess, emission.
  Material Read(const SceneNode& node, SceneDice& dice) const;

 private:
  std::map<std::string, Material> materials_;
};

}  // namespace semslam

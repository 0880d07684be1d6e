// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "semslam/render/scene.h"

#include "render/scene_materials.h"
#include "render/scene_node.h"
#include "render/scene_values.h"

namespace semslam {

// Makes the objects that a scene file asks for: ready-made ones, the file's own models, single
// shapes, and groups of parts.
class ObjectWorkshop {
 public:
  MaterialShelf& materials() { return materials_; }

  // The file's map of name to model. The nodes must outlive this object.
  void Define(const SceneNode& models);

  // Reads `object`, `shape` or `parts` and what belongs to it. `reader` then still has the keys
  // that say where it stands.
  Object Make(MapReader& reader, SceneDice& dice) const;

 private:
  Object MakeNamed(MapReader& reader, SceneDice& dice) const;
  Object MakeOfParts(const SceneNode& parts, SceneDice& dice) const;
  void AddPart(const SceneNode& part, SceneDice& dice, Object* object) const;

  MaterialShelf materials_;
  std::map<std::string, const SceneNode*> models_;
};

}  // namespace semslam

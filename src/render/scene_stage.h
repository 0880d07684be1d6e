// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "semslam/render/scene.h"

#include "render/scene_layout.h"
#include "render/scene_node.h"
#include "render/scene_objects.h"
#include "render/scene_values.h"

namespace semslam {

// Puts the objects of a scene file where it says, one entry of `objects` after the other.
class SceneStage {
 public:
  SceneStage(const ObjectWorkshop& workshop, Scene* scene)
      : workshop_(workshop), scene_(*scene), layout_(scene) {}

  // An object, a group, a scatter or a row; `repeat` and `chance` apply to each.
  void Add(const SceneNode& entry, SceneDice& dice);

  const SceneLayout& layout() const { return layout_; }

 private:
  void AddOnce(const SceneNode& entry, SceneDice& dice);
  void AddGroup(MapReader& reader, SceneDice& dice);
  void AddObject(MapReader& reader, SceneDice& dice);
  void Scatter(MapReader& reader, SceneDice& dice);
  // One copy; false if no place was found for it.
  bool ScatterOne(
      const SceneNode& choice, const Surface& surface, double gap, double margin, SceneDice& dice);
  void AddRow(MapReader& reader, SceneDice& dice);

  // Of the key `on` or `hang`; none without either.
  std::optional<Surface> ReadSurface(MapReader& reader, SceneDice& dice) const;
  std::string ReadNewName(MapReader& reader, SceneDice& dice) const;
  void Place(const SceneNode& entry,
             const std::string& name,
             const Object& object,
             const Rigid3& T_world_object);
  void CountStep(const SceneNode& entry);

  const ObjectWorkshop& workshop_;
  const Scene& scene_;
  SceneLayout layout_;
  std::size_t num_steps_ = 0;
  std::size_t num_triangles_ = 0;
};

}  // namespace semslam

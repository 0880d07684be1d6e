// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "semslam/geometry/rigid3.h"
#include "semslam/render/scene.h"

#include "render/scene_shapes.h"

namespace semslam {

// A rectangle on a surface, in any direction.
struct Footprint {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();
  double angle = 0;

  Eigen::Vector2d AxisX() const;
  Eigen::Vector2d AxisY() const;
  // The smallest upright rectangle around it: half its size.
  Eigen::Vector2d Extent() const;
};

// True if they are nearer to each other than `gap` (by the separating axes of two rectangles).
bool AreClose(const Footprint& a, const Footprint& b, double gap);

// A surface of something in the scene, where other things stand or hang: a desk's top, a wall's
// face.
struct Surface {
  std::string key;        // Of the surface: "desk/1"; the front of "wall" is "wall/front".
  bool is_front = false;  // Upright: things hang on it.
  Rigid3 T_world_surface;
  // Where things may be, in the surface's own x and y (its z, for a front).
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

// An object about to be placed.
struct Candidate {
  Object object;
  SceneAngles angles;
};

// What stands where. Names are those the scene file gives.
class SceneLayout {
 public:
  explicit SceneLayout(Scene* scene) : scene_(scene) {}

  bool Has(const std::string& name) const { return placed_.count(name) > 0; }
  std::vector<std::string> Names() const;
  // Of an object with a name.
  const Rigid3& PoseOf(const std::string& name) const { return placed_.at(name).T_world_object; }
  std::size_t NumPlaces(const std::string& name) const { return placed_.at(name).places.size(); }
  // "desk": its topmost place; "shelf/2": the second from below. None: no such name or place.
  std::optional<Surface> FindTop(const std::string& name_and_place) const;
  std::optional<Surface> FindFront(const std::string& name) const;

  // Where on a surface an object's footprint is if the object is at (x, y).
  static Footprint FootprintOf(const Candidate& candidate,
                               const Surface& surface,
                               const Eigen::Vector2d& at);
  // True if it is inside the surface, `margin` from its edge, and `gap` from all that is there.
  bool IsFree(const Footprint& footprint, const Surface& surface, double gap, double margin) const;
  // The pose of an object that stands on, or hangs at, a surface: touching it, plus `height`.
  static Rigid3 PoseOn(const Candidate& candidate,
                       const Surface& surface,
                       const Eigen::Vector2d& at,
                       double height);

  // Adds it to the scene. An empty name is none.
  void Place(const std::string& name, const Object& object, const Rigid3& T_world_object);
  void Occupy(const Surface& surface, const Footprint& footprint);

 private:
  struct Placed {
    Rigid3 T_world_object;
    std::vector<StandingPlace> places;
    Eigen::Vector3f low;
    Eigen::Vector3f high;
  };

  Scene* scene_;
  std::map<std::string, Placed> placed_;
  std::map<std::string, std::vector<Footprint>> occupied_;  // By the surface's key.
};

}  // namespace semslam

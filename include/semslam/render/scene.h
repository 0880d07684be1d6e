// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/geometry/oriented_box.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/render/mesh.h"
#include "semslam/render/texture.h"

namespace semslam {

// A texture yet to be made: drawing takes far longer than setting up a scene, and is done for all
// of them at once. Gives a CV_8UC3 picture, the same one at every call.
using Picture = std::function<cv::Mat()>;

// How a surface looks. Colours are BGR, gamma-coded, 0 to 1.
struct Material {
  std::shared_ptr<const Texture> texture;          // None: plain, or not yet drawn.
  std::shared_ptr<const Picture> picture;          // What Scene::Paint makes the texture of.
  Eigen::Vector2f repeats_per_metre{1, 1};         // Of the texture, along u and v.
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();  // Multiplies the texture.
  float specular = 0;                              // Strength of the highlight.
  float shininess = 40;                            // Its exponent: larger is smaller and sharper.
  float emission = 0;                              // Light of its own, for screens.
};

// A shape with one material, in the frame of the object it belongs to.
struct ObjectPart {
  TriangleMesh mesh;
  Material material;
};

// A level rectangle that things can stand on, along the axes of its object's frame.
struct StandingPlace {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  Eigen::Vector2f half_size = Eigen::Vector2f::Zero();
};

// Something with a name: a mug, a wall. Frame: z up, y away from who sits before it, origin where
// it stands.
struct Object {
  std::string class_name;
  std::vector<ObjectPart> parts;
  std::vector<StandingPlace> places = {};  // From below; none: the top of its box.
};

// An object that stands in the scene; its id is its value in the label images.
struct Instance {
  std::uint16_t id = 0;
  std::string class_name;
  OrientedBox box;  // In world, with the axes of the object's frame; encloses all its parts.
};

struct ScenePart {
  TriangleMesh mesh;  // In world.
  Material material;
  std::uint16_t instance_id = 0;
};

// A lamp: a disc that looks down, and hangs where shadows come from.
struct Light {
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();
  Eigen::Vector3f intensity = Eigen::Vector3f::Ones();  // BGR, linear: radiance of white at 1 m.
  float radius = 0;                                     // Metres; 0 gives hard shadows.
};

// All that can be seen. World: z up, metres.
class Scene {
 public:
  // Returns the id: 1, 2, ... in the order of adding. 0 stays for "nothing there".
  std::uint16_t Add(const Object& object, const Rigid3& T_world_object);
  void AddLight(const Light& light) { lights_.push_back(light); }
  // Draws the textures of all materials that have a picture. `num_threads` as ParallelFor.
  void Paint(int num_threads);
  // Light from everywhere, linear BGR: on faces that look up, and down.
  void SetAmbient(const Eigen::Vector3f& from_above, const Eigen::Vector3f& from_below);

  const std::vector<ScenePart>& parts() const { return parts_; }
  const std::vector<Instance>& instances() const { return instances_; }
  const std::vector<Light>& lights() const { return lights_; }
  const Eigen::Vector3f& ambient_above() const { return ambient_above_; }
  const Eigen::Vector3f& ambient_below() const { return ambient_below_; }

 private:
  std::vector<ScenePart> parts_;
  std::vector<Instance> instances_;
  std::vector<Light> lights_;
  Eigen::Vector3f ambient_above_ = Eigen::Vector3f::Constant(0.3F);
  Eigen::Vector3f ambient_below_ = Eigen::Vector3f::Constant(0.15F);
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/scene.h"

#include <limits>
#include <map>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"

namespace semslam {
namespace {

// The box of an object along the axes of its frame.
OrientedBox BoundingBox(const Object& object, const Rigid3& T_world_object) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = -low;
  for (const ObjectPart& part : object.parts) {
    for (const Eigen::Vector3f& position : part.mesh.positions) {
      low = low.cwiseMin(position);
      high = high.cwiseMax(position);
    }
  }
  const Eigen::Vector3d center = 0.5 * (low + high).cast<double>();
  return {T_world_object * Rigid3{Eigen::Quaterniond::Identity(), center},
          0.5 * (high - low).cast<double>()};
}

}  // namespace

std::uint16_t Scene::Add(const Object& object, const Rigid3& T_world_object) {
  SEMSLAM_CHECK(!object.parts.empty()) << object.class_name;
  SEMSLAM_CHECK(instances_.size() < std::numeric_limits<std::uint16_t>::max());
  const auto id = static_cast<std::uint16_t>(instances_.size() + 1);
  instances_.push_back({id, object.class_name, BoundingBox(object, T_world_object)});
  for (const ObjectPart& part : object.parts) {
    parts_.push_back({Transformed(part.mesh, T_world_object), part.material, id});
  }
  return id;
}

void Scene::Paint(int num_threads) {
  // Each picture once, in the order of the parts; many parts may share one.
  std::map<const Picture*, std::size_t> index_of_picture;
  std::vector<std::shared_ptr<const Picture>> pictures;
  for (const ScenePart& part : parts_) {
    const std::shared_ptr<const Picture>& picture = part.material.picture;
    if (picture && index_of_picture.try_emplace(picture.get(), pictures.size()).second)
      pictures.push_back(picture);
  }
  std::vector<std::shared_ptr<const Texture>> textures(pictures.size());
  ParallelFor(pictures.size(), 1, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      textures[i] = std::make_shared<const Texture>((*pictures[i])());
  });
  for (ScenePart& part : parts_) {
    if (!part.material.picture) continue;
    part.material.texture = textures[index_of_picture.at(part.material.picture.get())];
    part.material.picture = nullptr;
  }
}

void Scene::SetAmbient(const Eigen::Vector3f& from_above, const Eigen::Vector3f& from_below) {
  ambient_above_ = from_above;
  ambient_below_ = from_below;
}

}  // namespace semslam

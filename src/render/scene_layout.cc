// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_layout.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace semslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHangingGap = 0.0005;  // Metres between a wall and what hangs at it.

struct Bounds {
  Vector3d low;
  Vector3d high;
};

Bounds BoundsOf(const Object& object, const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3f turn = rotation.cast<float>().toRotationMatrix();
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = -low;
  for (const ObjectPart& part : object.parts) {
    for (const Eigen::Vector3f& position : part.mesh.positions) {
      const Eigen::Vector3f turned = turn * position;
      low = low.cwiseMin(turned);
      high = high.cwiseMax(turned);
    }
  }
  return {low.cast<double>(), high.cast<double>()};
}

}  // namespace

Vector2d Footprint::AxisX() const { return {std::cos(angle), std::sin(angle)}; }
Vector2d Footprint::AxisY() const { return {-std::sin(angle), std::cos(angle)}; }
Vector2d Footprint::Extent() const {
  return half_size.x() * AxisX().cwiseAbs() + half_size.y() * AxisY().cwiseAbs();
}

bool AreClose(const Footprint& a, const Footprint& b, double gap) {
  const Vector2d between = b.center - a.center;
  const auto reach = [](const Footprint& footprint, const Vector2d& axis) {
    return footprint.half_size.x() * std::abs(footprint.AxisX().dot(axis)) +
           footprint.half_size.y() * std::abs(footprint.AxisY().dot(axis));
  };
  for (const Vector2d& axis : {a.AxisX(), a.AxisY(), b.AxisX(), b.AxisY()}) {
    if (std::abs(between.dot(axis)) > reach(a, axis) + reach(b, axis) + gap) return false;
  }
  return true;
}

std::vector<std::string> SceneLayout::Names() const {
  std::vector<std::string> names;
  for (const auto& [name, unused] : placed_) names.push_back(name);
  return names;
}

std::optional<Surface> SceneLayout::FindTop(const std::string& name_and_place) const {
  const std::size_t slash = name_and_place.find('/');
  const std::string name = name_and_place.substr(0, slash);
  const auto found = placed_.find(name);
  if (found == placed_.end()) return std::nullopt;
  const std::vector<StandingPlace>& places = found->second.places;
  std::size_t index = places.size();
  if (slash != std::string::npos) {
    const char* end = name_and_place.data() + name_and_place.size();
    const auto parsed = std::from_chars(name_and_place.data() + slash + 1, end, index);
    if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  }
  if (index < 1 || index > places.size()) return std::nullopt;
  const StandingPlace& place = places[index - 1];
  const Vector3d center = place.center.cast<double>();
  const Vector2d half = place.half_size.cast<double>();
  return Surface{name + '/' + std::to_string(index), false,
                 found->second.T_world_object * Rigid3{Eigen::Quaterniond::Identity(), center},
                 -half, half};
}

std::optional<Surface> SceneLayout::FindFront(const std::string& name) const {
  const auto found = placed_.find(name);
  if (found == placed_.end()) return std::nullopt;
  const Placed& placed = found->second;
  const Vector3d center(0.5 * (placed.low.x() + placed.high.x()), placed.low.y(), 0);
  const double half_width = 0.5 * (placed.high.x() - placed.low.x());
  return Surface{name + "/front", true,
                 placed.T_world_object * Rigid3{Eigen::Quaterniond::Identity(), center},
                 Vector2d(-half_width, placed.low.z()), Vector2d(half_width, placed.high.z())};
}

Footprint SceneLayout::FootprintOf(const Candidate& candidate,
                                   const Surface& surface,
                                   const Vector2d& at) {
  Footprint footprint;
  if (surface.is_front) {
    const Bounds bounds = BoundsOf(candidate.object, candidate.angles.Rotation());
    footprint.center =
        at + 0.5 * Vector2d(bounds.low.x() + bounds.high.x(), bounds.low.z() + bounds.high.z());
    footprint.half_size =
        0.5 * Vector2d(bounds.high.x() - bounds.low.x(), bounds.high.z() - bounds.low.z());
    return footprint;
  }
  const Bounds bounds = BoundsOf(candidate.object, candidate.angles.tilt);
  const Vector2d center = 0.5 * (bounds.low + bounds.high).head<2>();
  footprint.angle = candidate.angles.yaw;
  footprint.center = at + center.x() * footprint.AxisX() + center.y() * footprint.AxisY();
  footprint.half_size = 0.5 * (bounds.high - bounds.low).head<2>();
  return footprint;
}

bool SceneLayout::IsFree(const Footprint& footprint,
                         const Surface& surface,
                         double gap,
                         double margin) const {
  const Vector2d extent = footprint.Extent().array() + margin;
  if (((footprint.center - extent).array() < surface.low.array()).any()) return false;
  if (((footprint.center + extent).array() > surface.high.array()).any()) return false;
  const auto others = occupied_.find(surface.key);
  if (others == occupied_.end()) return true;
  return std::none_of(others->second.begin(), others->second.end(),
                      [&](const Footprint& other) { return AreClose(footprint, other, gap); });
}

Rigid3 SceneLayout::PoseOn(const Candidate& candidate,
                           const Surface& surface,
                           const Vector2d& at,
                           double height) {
  const Bounds bounds = BoundsOf(candidate.object, candidate.angles.Rotation());
  const Vector3d p_surface = surface.is_front
                                 ? Vector3d(at.x(), -bounds.high.y() - kHangingGap - height, at.y())
                                 : Vector3d(at.x(), at.y(), height - bounds.low.z());
  return surface.T_world_surface * Rigid3{candidate.angles.Rotation(), p_surface};
}

void SceneLayout::Place(const std::string& name,
                        const Object& object,
                        const Rigid3& T_world_object) {
  scene_->Add(object, T_world_object);
  if (name.empty()) return;
  const Bounds bounds = BoundsOf(object, Eigen::Quaterniond::Identity());
  Placed placed = {T_world_object, object.places, bounds.low.cast<float>(),
                   bounds.high.cast<float>()};
  if (placed.places.empty()) {
    StandingPlace top;
    top.center = {0.5F * (placed.low.x() + placed.high.x()),
                  0.5F * (placed.low.y() + placed.high.y()), placed.high.z()};
    top.half_size = 0.5F * (placed.high - placed.low).head<2>();
    placed.places.push_back(top);
  }
  placed_.insert_or_assign(name, std::move(placed));
}

void SceneLayout::Occupy(const Surface& surface, const Footprint& footprint) {
  occupied_[surface.key].push_back(footprint);
}

}  // namespace semslam

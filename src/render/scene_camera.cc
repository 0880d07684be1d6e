// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_camera.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "render/scene_shapes.h"

namespace semslam {
namespace {

constexpr Limits kPlace = {-kMaxSceneSize, kMaxSceneSize};
constexpr std::size_t kMaxWaypoints = 1000;
constexpr double kSteepest = 0.05;  // Level part of a view's direction: 3 degrees off the vertical.
constexpr int kSamples = 16;        // A waypoint.

Waypoint ReadWaypoint(const SceneNode& given, const Rigid3& T_world_from, SceneDice& dice) {
  const SceneNode& node = Chosen(given, dice);
  MapReader reader(node);
  reader.Find("repeat");
  const Eigen::Vector3d eye = ReadVector(reader.Get("eye"), dice, kPlace);
  const Eigen::Vector3d target = ReadVector(reader.Get("target"), dice, kPlace);
  reader.Finish();
  if ((target - eye).head<2>().norm() < kSteepest * (target - eye).norm() + 1e-6)
    node.Fail("expected a target aside of the eye, found one straight above, below or at it");
  return {T_world_from * eye, T_world_from * target};
}

std::vector<Waypoint> ReadWaypoints(const SceneNode& node,
                                    const Rigid3& T_world_from,
                                    SceneDice& dice) {
  if (node.kind != SceneNode::Kind::kList) node.FailExpected("a list of waypoints");
  std::vector<Waypoint> waypoints;
  for (const SceneNode& item : node.items) {
    const SceneNode* repeat = item.Find("repeat");
    const int count = repeat == nullptr ? 1 : ReadCount(*repeat, dice, {0, kMaxWaypoints});
    const auto numbers = dice.numbers;
    for (int i = 0; i < count; ++i) {
      if (repeat != nullptr) dice.numbers["i"] = i;
      waypoints.push_back(ReadWaypoint(item, T_world_from, dice));
    }
    dice.numbers = numbers;
    if (waypoints.size() > kMaxWaypoints)
      item.Fail("expected at most " + std::to_string(kMaxWaypoints) + " waypoints, found more");
  }
  if (waypoints.size() < 2)
    node.Fail("expected at least 2 waypoints, found " + std::to_string(waypoints.size()));
  return waypoints;
}

// Metres from waypoint to waypoint, on average. Fails where the view turns over the vertical.
double MetresPerWaypoint(const SceneNode& node,
                         const std::vector<Waypoint>& waypoints,
                         CameraPath::Options options) {
  options.seconds_per_waypoint = 1;
  options.sway_m = 0;
  const CameraPath path(waypoints, options);
  const std::size_t num_spans = waypoints.size() - (options.closed ? 0 : 1);
  double length = 0;
  for (std::size_t i = 1; i <= num_spans * kSamples; ++i) {
    const double time = static_cast<double>(i) / kSamples;
    const Waypoint view = path.ViewAt(time);
    const Eigen::Vector3d direction = view.p_world_target - view.p_world_eye;
    if (direction.head<2>().norm() < kSteepest * direction.norm() + 1e-6) {
      node.Fail(
          "expected views that turn little from waypoint to waypoint, found a turn over the "
          "vertical after waypoint " +
          std::to_string((i - 1) / kSamples));
    }
    length += (view.p_world_eye - path.ViewAt(time - 1.0 / kSamples).p_world_eye).norm();
  }
  return length / static_cast<double>(num_spans);
}

}  // namespace

CameraPath ReadCameraPath(const SceneNode& node, const SceneLayout& layout, SceneDice& dice) {
  MapReader reader(node);
  Rigid3 T_world_from;
  if (const SceneNode* from = reader.Find("from")) {
    const std::string name = ReadWord(*from, dice);
    if (!layout.Has(name)) from->FailExpected("the name of an object");
    T_world_from = layout.PoseOf(name);
  }
  CameraPath::Options options;
  options.seed = dice.random();
  if (const SceneNode* closed = reader.Find("closed")) options.closed = ReadSwitch(*closed, dice);
  if (const SceneNode* sway = reader.Find("sway"))
    options.sway_m = ReadNumber(*sway, dice, {0, 0.1});
  if (const SceneNode* angle = reader.Find("sway_angle"))
    options.sway_angle = ReadNumber(*angle, dice, {0, 10}) * std::numbers::pi / 180.0;
  const SceneNode& list = reader.Get("waypoints");
  const std::vector<Waypoint> waypoints = ReadWaypoints(list, T_world_from, dice);
  const double metres = MetresPerWaypoint(list, waypoints, options);
  const SceneNode* seconds = reader.Find("seconds_per_waypoint");
  if (const SceneNode* speed = reader.Find("speed")) {
    if (seconds != nullptr) speed->Fail("expected speed or seconds_per_waypoint, found both");
    if (metres < 1e-4) speed->Fail("expected no speed for a camera that stands still, found one");
    options.seconds_per_waypoint = metres / ReadNumber(*speed, dice, {0.001, 20});
  } else if (seconds != nullptr) {
    options.seconds_per_waypoint = ReadNumber(*seconds, dice, {0.01, 1000});
  }
  reader.Finish();
  return CameraPath(waypoints, options);
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "semslam/base/random.h"
#include "semslam/render/objects.h"
#include "semslam/render/scenes.h"

namespace semslam {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kPi = std::numbers::pi;
constexpr double kDeskHeight = 0.74;
constexpr double kWallY = 0.47;  // The desk's middle is at x = y = 0.

Rigid3 At(const Vector3d& p_world, double yaw_deg = 0) {
  return {ExpSO3({0, 0, yaw_deg * kPi / 180.0}), p_world};
}

// Puts objects on the desk, each a little aside from where it is said to stand.
class DeskBuilder {
 public:
  explicit DeskBuilder(std::uint64_t seed) : random_(seed) {}

  std::uint64_t NextSeed() { return random_(); }
  double Uniform(double low, double high) { return random_.Uniform(low, high); }

  void Place(const Object& object, double x, double y, double yaw_deg, double z = kDeskHeight) {
    const double aside_x = random_.Uniform(-0.02, 0.02);
    const double aside_y = random_.Uniform(-0.015, 0.015);
    const double turn = random_.Uniform(-8, 8);
    scene_.Add(object, At({x + aside_x, y + aside_y, z}, yaw_deg + turn));
  }
  void Fix(const Object& object, const Rigid3& T_world_object) {
    scene_.Add(object, T_world_object);
  }

  Scene& scene() { return scene_; }

 private:
  Random random_;
  Scene scene_;
};

void AddRoom(DeskBuilder& desk) {
  constexpr float kWidth = 6.0F;
  constexpr float kDepth = 4.5F;
  constexpr float kHeight = 2.7F;
  const double middle_y = kWallY - 0.5 * kDepth;
  desk.Fix(MakeFloor(kWidth, kDepth, desk.NextSeed()), At({0, middle_y, 0}));
  desk.Fix(MakeCeiling(kWidth, kDepth, desk.NextSeed()), At({0, middle_y, kHeight}));
  desk.Fix(MakeWall(kWidth, kHeight, desk.NextSeed()), At({0, kWallY, 0}));
  desk.Fix(MakeWall(kWidth, kHeight, desk.NextSeed()), At({0, kWallY - kDepth, 0}, 180));
  desk.Fix(MakeWall(kDepth, kHeight, desk.NextSeed()), At({-0.5 * kWidth, middle_y, 0}, 90));
  desk.Fix(MakeWall(kDepth, kHeight, desk.NextSeed()), At({0.5 * kWidth, middle_y, 0}, -90));
  desk.scene().SetAmbient(Vector3f(0.27F, 0.26F, 0.25F), Vector3f(0.12F, 0.13F, 0.14F));
  desk.scene().AddLight({{0.7F, -1.3F, 2.55F}, {1.75F, 1.95F, 2.1F}, 0.25F});  // Lamp.
  desk.scene().AddLight({{-2.6F, -0.9F, 1.9F}, {3.4F, 3.1F, 2.9F}, 0.4F});     // Window.
}

// What hangs on the wall between x = -1.3 and x = 1.3.
void AddWallDecoration(DeskBuilder& desk) {
  const auto hang = [&](const Object& object, double x, double z) {
    desk.Fix(object,
             At({x + desk.Uniform(-0.04, 0.04), kWallY - 0.003, z + desk.Uniform(-0.03, 0.03)}));
  };
  hang(MakePoster(0.50F, 0.70F, desk.NextSeed()), -1.15, 1.25);
  hang(MakePoster(0.42F, 0.30F, desk.NextSeed()), 0.02, 1.38);
  hang(MakePoster(0.21F, 0.297F, desk.NextSeed()), -0.72, 1.42);
  hang(MakePoster(0.21F, 0.297F, desk.NextSeed()), 0.02, 1.02);
  hang(MakePoster(0.40F, 0.55F, desk.NextSeed()), 0.80, 1.36);
  hang(MakePoster(0.30F, 0.42F, desk.NextSeed()), 1.28, 1.15);
}

// A row of standing books from x on to the right, spines to the front, and a stack of lying ones.
void AddBooks(DeskBuilder& desk) {
  double x = -0.83;
  for (int i = 0; i < 5; ++i) {
    const Vector3f size(static_cast<float>(desk.Uniform(0.19, 0.27)),
                        static_cast<float>(desk.Uniform(0.13, 0.18)),
                        static_cast<float>(desk.Uniform(0.018, 0.045)));
    x += size.z() + 0.002;
    const Eigen::Quaterniond upright = ExpSO3({0, -0.5 * kPi, 0});
    const Vector3d center(x, kWallY - 0.03 - 0.5 * size.y(), kDeskHeight + 0.5 * size.x());
    desk.Fix(MakeBook(size, desk.NextSeed()), {upright, center});
  }
  double height = kDeskHeight;
  for (int i = 0; i < 3; ++i) {
    const Vector3f size(0.25F - 0.02F * static_cast<float>(i),
                        0.18F - 0.015F * static_cast<float>(i),
                        static_cast<float>(desk.Uniform(0.018, 0.04)));
    desk.Place(MakeBook(size, desk.NextSeed()), -0.66, -0.1, desk.Uniform(-12, 12), height);
    height += size.z();
  }
}

void AddDeskObjects(DeskBuilder& desk) {
  desk.Fix(MakeDesk({1.7F, 0.86F, static_cast<float>(kDeskHeight)}, desk.NextSeed()),
           At({0, 0, 0}));
  desk.Place(MakeMonitor(0.47F, 0.29F, desk.NextSeed()), -0.30, 0.22, 12);
  desk.Place(MakeMonitor(0.41F, 0.27F, desk.NextSeed()), 0.31, 0.24, -10);
  desk.Place(MakeKeyboard(desk.NextSeed()), -0.06, -0.17, 0);
  desk.Place(MakeMouse(desk.NextSeed()), 0.27, -0.20, 0);
  desk.Place(MakeMug(desk.NextSeed()), -0.41, -0.12, desk.Uniform(-70, 40));
  desk.Place(MakeMug(desk.NextSeed()), 0.50, 0.00, desk.Uniform(-180, 180));
  desk.Place(MakeTeddyBear(0.27F, desk.NextSeed()), 0.71, 0.14, -22);
  desk.Place(MakeTelephone(desk.NextSeed()), 0.60, -0.24, -15);
  desk.Place(MakePenHolder(desk.NextSeed()), -0.02, 0.10, 0);
  desk.Place(MakeCardboardBox({0.16F, 0.12F, 0.10F}, desk.NextSeed()), 0.03, 0.30, 20);
  desk.Place(MakePaper(desk.NextSeed()), -0.44, -0.29, 14);
  desk.Place(MakePaper(desk.NextSeed()), 0.37, -0.28, -20);
  AddBooks(desk);
}

CameraPath MakeDeskPath(DeskBuilder& desk) {
  constexpr int kWaypoints = 12;
  std::vector<Waypoint> waypoints;
  for (int i = 0; i < kWaypoints; ++i) {
    const double phase = 2.0 * kPi * i / kWaypoints;
    const Vector3d eye(0.60 * std::sin(phase) + desk.Uniform(-0.05, 0.05),
                       -0.92 + 0.16 * std::cos(2 * phase) + desk.Uniform(-0.06, 0.06),
                       1.30 + 0.14 * std::cos(phase) + desk.Uniform(-0.05, 0.05));
    const Vector3d target(0.22 * std::sin(phase) + desk.Uniform(-0.06, 0.06),
                          0.08 + desk.Uniform(-0.05, 0.05), 0.86 + desk.Uniform(-0.04, 0.04));
    waypoints.push_back({eye, target});
  }
  return CameraPath(waypoints, {.seconds_per_waypoint = 1.1, .seed = desk.NextSeed()});
}

}  // namespace

StagedScene MakeDeskScene(std::uint64_t seed) {
  DeskBuilder desk(seed);
  AddRoom(desk);
  AddWallDecoration(desk);
  AddDeskObjects(desk);
  CameraPath path = MakeDeskPath(desk);
  return {desk.scene(), std::move(path)};
}

StagedScene MakeWallScene(std::uint64_t seed) {
  DeskBuilder wall(seed);
  AddRoom(wall);
  for (int column = 0; column < 7; ++column) {
    for (int row = 0; row < 3; ++row) {
      const auto width = static_cast<float>(wall.Uniform(0.25, 0.42));
      const auto height = static_cast<float>(wall.Uniform(0.3, 0.5));
      wall.Fix(
          MakePoster(width, height, wall.NextSeed()),
          At({0.48 * (column - 3) + wall.Uniform(-0.02, 0.02), kWallY - 0.003, 0.55 + 0.6 * row}));
    }
  }
  std::vector<Waypoint> waypoints;
  for (int i = 0; i < 12; ++i) {
    const double phase = 2.0 * kPi * i / 12;
    const Vector3d eye(0.8 * std::sin(phase), -0.75 + wall.Uniform(-0.1, 0.1),
                       1.2 + 0.2 * std::cos(phase));
    waypoints.push_back(
        {eye, {eye.x() + 0.1 * std::cos(phase), kWallY, eye.z() + wall.Uniform(-0.1, 0.1)}});
  }
  const CameraPath path(waypoints, {.seconds_per_waypoint = 1.2, .seed = wall.NextSeed()});
  return {wall.scene(), path};
}

}  // namespace semslam

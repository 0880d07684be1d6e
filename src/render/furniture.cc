// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// What stands in a room.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "semslam/base/random.h"
#include "semslam/render/objects.h"
#include "semslam/render/patterns.h"

#include "render/drawing.h"
#include "render/object_parts.h"

namespace semslam {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

// One of some usual colours of wood.
Vector3f WoodColor(Random& random) {
  const Vector3f colors[] = {{0.36F, 0.55F, 0.74F},
                             {0.5F, 0.66F, 0.78F},
                             {0.2F, 0.33F, 0.5F},
                             {0.66F, 0.74F, 0.8F},
                             {0.16F, 0.22F, 0.32F}};
  return colors[random.Index(5)];
}

Material Metal() { return Plastic(Vector3f::Constant(0.42F), 0.4F); }

}  // namespace

Object MakeDesk(const Vector3f& size, std::uint64_t seed) {
  Random random(seed);
  constexpr float kTop = 0.03F;
  constexpr float kLeg = 0.05F;
  const TriangleMesh top =
      RoundedBoxOn({size.x(), size.y(), kTop}, 0.006F, {0, 0, size.z() - kTop});
  const float x = 0.5F * (size.x() - kLeg) - 0.03F;
  const float y = 0.5F * (size.y() - kLeg) - 0.03F;
  TriangleMesh legs;
  for (const float side : {-x, x}) {
    for (const float end : {-y, y})
      legs.Append(BoxOn({kLeg, kLeg, size.z() - kTop}, {side, end, 0}));
    legs.Append(BoxOn({0.03F, 2 * y, 0.05F}, {side, 0, size.z() - kTop - 0.05F}));
  }
  legs.Append(BoxOn({2 * x, 0.02F, 0.25F}, {0, y, size.z() - kTop - 0.3F}));
  return {"desk",
          {{WithPlanarUv(top, -0.5F * size.head<2>()), Wooden(WoodColor(random), seed)},
           {legs, Metal()}}};
}

Object MakeChair(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = RandomColor(random, random.Uniform(0.1, 0.7), random.Uniform(0.25, 0.6));
  constexpr float kSeat = 0.46F;
  TriangleMesh cushions = RoundedBoxOn({0.48F, 0.46F, 0.08F}, 0.035F, {0, 0, kSeat});
  cushions.Append(Placed(MakeRoundedBox({0.44F, 0.06F, 0.5F}, 0.028F), {-0.12F, 0, 0},
                         {0, 0.25F, kSeat + 0.38F}));
  TriangleMesh frame = Translated(MakeCylinder(0.025F, kSeat - 0.08F, 20), {0, 0, 0.08F});
  const std::vector<Vector3f> spine = {{0, 0.1F, kSeat - 0.01F},
                                       {0, 0.24F, kSeat - 0.01F},
                                       {0, 0.29F, kSeat + 0.1F},
                                       {0, 0.3F, kSeat + 0.3F}};
  frame.Append(MakeTube(SmoothLine(spine), 0.02F));
  TriangleMesh casters;
  for (int i = 0; i < 5; ++i) {
    const float angle = 2 * kPi * (static_cast<float>(i) + 0.25F) / 5;
    const Vector3f out(std::cos(angle), std::sin(angle), 0);
    const std::vector<Vector3f> spoke = {{0, 0, 0.11F}, 0.3F * out + Vector3f(0, 0, 0.07F)};
    frame.Append(MakeTube(spoke, 0.02F, 10));
    casters.Append(Translated(MakeEllipsoid({0.026F, 0.026F, 0.028F}, 16),
                              0.3F * out + Vector3f(0, 0, 0.028F)));
  }
  for (const float side : {-0.27F, 0.27F}) {
    const std::vector<Vector3f> arm = {{0.7F * side, 0.05F, kSeat + 0.01F},
                                       {side, 0.05F, kSeat + 0.02F},
                                       {side, 0.05F, kSeat + 0.2F}};
    frame.Append(MakeTube(arm, 0.014F));
    casters.Append(RoundedBoxOn({0.055F, 0.26F, 0.03F}, 0.012F, {side, 0.02F, kSeat + 0.2F}));
  }
  return {"chair",
          {{cushions, Woven(color, seed)},
           {frame, Plastic(Vector3f::Constant(0.2F), 0.3F)},
           {casters, Plastic(Vector3f::Constant(0.1F), 0.2F)}}};
}

Object MakeSofa(const Vector3f& size, std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = RandomColor(random, random.Uniform(0.15, 0.6), random.Uniform(0.4, 0.7));
  constexpr float kArm = 0.16F;
  constexpr float kFoot = 0.07F;
  const float seat = 0.5F * size.z();
  TriangleMesh body = RoundedBoxOn({size.x(), size.y(), seat - kFoot}, 0.04F, {0, 0, kFoot});
  body.Append(RoundedBoxOn({size.x(), 0.24F, size.z() - kFoot}, 0.07F,
                           {0, 0.5F * size.y() - 0.12F, kFoot}));
  for (const float side : {-1.0F, 1.0F}) {
    body.Append(RoundedBoxOn({kArm, size.y(), 0.75F * size.z() - kFoot}, 0.06F,
                             {side * 0.5F * (size.x() - kArm), 0, kFoot}));
  }
  const int num_seats = std::max(1, static_cast<int>((size.x() - 2 * kArm) / 0.6F));
  const float width = (size.x() - 2 * kArm) / static_cast<float>(num_seats);
  TriangleMesh cushions;
  TriangleMesh pillows;
  for (int i = 0; i < num_seats; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * width - 0.5F * size.x() + kArm;
    cushions.Append(
        RoundedBoxOn({0.97F * width, size.y() - 0.22F, 0.12F}, 0.045F, {x, -0.11F, seat - 0.01F}));
    if (random.Uniform() < 0.35) continue;
    pillows.Append(Placed(MakeRoundedBox({0.42F, 0.13F, 0.38F}, 0.06F), {-0.3F, 0, 0},
                          {x, 0.5F * size.y() - 0.33F, seat + 0.28F}));
  }
  TriangleMesh feet;
  for (const float x : {-0.44F, 0.44F}) {
    for (const float y : {-0.4F, 0.4F})
      feet.Append(
          Translated(MakeCylinder(0.025F, kFoot + 0.02F, 16), {x * size.x(), y * size.y(), 0}));
  }
  Object sofa{"sofa",
              {{body, Woven(color, seed)},
               {cushions, Woven(0.93F * color, seed + 1)},
               {feet, Plastic(Vector3f::Constant(0.15F))}}};
  sofa.places.push_back({{0, -0.15F, seat + 0.11F},
                         {0.5F * size.x() - kArm, std::max(0.05F, 0.5F * size.y() - 0.2F)}});
  const Vector3f bright = RandomColor(random, 0.5, 0.75);
  if (!pillows.triangles.empty()) {
    sofa.parts.push_back({pillows, Printed(
                                       [=] {
                                         return DrawMotif({256, 256}, bright, seed);
                                       },
                                       0.5F, 0.4F)});
  }
  return sofa;
}

Object MakeBookshelf(const Vector3f& size, std::uint64_t seed) {
  Random random(seed);
  constexpr float kBoard = 0.022F;
  constexpr float kPlinth = 0.06F;
  TriangleMesh wood;
  for (const float side : {-0.5F, 0.5F})
    wood.Append(BoxOn({kBoard, size.y(), size.z()}, {side * (size.x() - kBoard), 0, 0}));
  wood.Append(BoxOn({size.x() - 2 * kBoard, 0.006F, size.z()}, {0, 0.5F * size.y() - 0.003F, 0}));
  wood.Append(BoxOn({size.x() - 2 * kBoard, kBoard, kPlinth}, {0, -0.5F * size.y() + 0.02F, 0}));
  Object shelf{"shelf", {}};
  const int num_spaces = std::max(1, static_cast<int>((size.z() - kPlinth) / 0.34F));
  const float step = (size.z() - kPlinth - kBoard) / static_cast<float>(num_spaces);
  for (int i = 0; i <= num_spaces; ++i) {
    const float z = kPlinth + step * static_cast<float>(i);
    wood.Append(
        WithPlanarUv(BoxOn({size.x() - 2 * kBoard, size.y() - 0.006F, kBoard}, {0, -0.003F, z}),
                     {0.1F * static_cast<float>(i), 0.17F * static_cast<float>(i)}));
    shelf.places.push_back(
        {{0, -0.003F, z + kBoard}, {0.5F * size.x() - kBoard, 0.5F * size.y() - 0.004F}});
  }
  shelf.parts.push_back({wood, Wooden(WoodColor(random), seed)});
  return shelf;
}

Object MakeCabinet(const Vector3f& size, std::uint64_t seed) {
  Random random(seed);
  constexpr float kFront = 0.02F;
  constexpr float kGap = 0.006F;
  constexpr float kPlinth = 0.05F;
  TriangleMesh body =
      BoxOn({size.x(), size.y() - kFront, size.z() - kPlinth}, {0, 0.5F * kFront, kPlinth});
  body.Append(BoxOn({size.x() - 0.04F, size.y() - 0.06F, kPlinth}, {0, 0.02F, 0}));
  const int columns = std::max(1, static_cast<int>(std::lround(size.x() / 0.45F)));
  const int rows = random.Uniform() < 0.5
                       ? std::max(1, static_cast<int>(std::lround(size.z() / 0.3F)))
                       : std::max(1, static_cast<int>(size.z() / 0.9F));
  const float width = size.x() / static_cast<float>(columns);
  const float height = (size.z() - kPlinth) / static_cast<float>(rows);
  TriangleMesh fronts;
  TriangleMesh handles;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vector3f bottom((static_cast<float>(column) + 0.5F) * width - 0.5F * size.x(),
                            -0.5F * (size.y() - kFront),
                            kPlinth + static_cast<float>(row) * height + 0.5F * kGap);
      fronts.Append(RoundedBoxOn({width - kGap, kFront, height - kGap}, 0.003F, bottom));
      const bool is_door = height > 1.2F * width;
      const float side = column % 2 == 0 ? 1.0F : -1.0F;
      const Vector3f grip =
          bottom + Vector3f(is_door ? side * (0.5F * width - 0.04F) : 0, -0.5F * kFront - 0.022F,
                            is_door ? 0.5F * height : 0.7F * height);
      const Vector3f reach = is_door ? Vector3f(0, 0, 0.06F) : Vector3f(0.06F, 0, 0);
      const Vector3f foot(0, 0.022F, 0);
      const std::vector<Vector3f> bow = {grip - reach + foot, grip - reach, grip + reach,
                                         grip + reach + foot};
      handles.Append(MakeTube(bow, 0.005F, 8));
    }
  }
  const bool is_steel = random.Uniform() < 0.4;
  const Vector3f color = is_steel ? RandomColor(random, 0.15, 0.65) : WoodColor(random);
  const Material front = is_steel ? GrainyPlastic(color, seed) : Wooden(color, seed);
  return {"cabinet", {{fronts, front}, {body, front}, {handles, Metal()}}};
}

Object MakeRug(float width, float depth, std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = RandomColor(random, random.Uniform(0.4, 0.8), random.Uniform(0.3, 0.6));
  const Vector3f second = RandomColor(random, random.Uniform(0.3, 0.7), random.Uniform(0.5, 0.8));
  const TriangleMesh pile = BoxOn({width, depth, 0.008F}, Vector3f::Zero());
  return {"rug",
          {{WithPlanarUv(pile, {-0.5F * width, -0.5F * depth}),
            Printed(
                [=] {
                  return DrawRug({768, 768}, color, second, seed);
                },
                width, depth)}}};
}

Object MakeBin(std::uint64_t seed) {
  Random random(seed);
  const std::vector<Eigen::Vector2f> profile = {{0, 0},           {0.11F, 0},      {0.14F, 0.3F},
                                                {0.147F, 0.3F},   {0.147F, 0.31F}, {0.136F, 0.31F},
                                                {0.107F, 0.005F}, {0, 0.005F}};
  TriangleMesh paper;
  for (int i = 0; i < 5; ++i) {
    const Vector3f center(static_cast<float>(random.Uniform(-0.06, 0.06)),
                          static_cast<float>(random.Uniform(-0.06, 0.06)),
                          static_cast<float>(random.Uniform(0.05, 0.24)));
    paper.Append(Translated(MakeEllipsoid({0.05F, 0.045F, 0.04F}, 9), center));
  }
  const Vector3f color = RandomColor(random, random.Uniform(0, 0.6), random.Uniform(0.2, 0.6));
  return {"waste bin",
          {{MakeLathe(profile, 32, false), GrainyPlastic(color, seed)},
           {paper, Printed(
                       [=] {
                         return DrawPage({256, 256}, seed);
                       },
                       0.2F, 0.2F)}}};
}

Object MakePlant(float height, std::uint64_t seed) {
  Random random(seed);
  const float pot = 0.2F * std::min(height, 1.0F) + 0.04F;  // Height of the pot.
  const std::vector<Eigen::Vector2f> profile = {{0, 0},
                                                {0.35F * pot, 0},
                                                {0.47F * pot, 0.85F * pot},
                                                {0.52F * pot, 0.85F * pot},
                                                {0.52F * pot, pot},
                                                {0.46F * pot, pot},
                                                {0.44F * pot, 0.88F * pot},
                                                {0, 0.88F * pot}};
  TriangleMesh stems;
  TriangleMesh leaves;
  const int num_stems = 9 + static_cast<int>(random.Index(6));
  for (int i = 0; i < num_stems; ++i) {
    const auto turn = 2 * kPi *
                      (static_cast<float>(i) + static_cast<float>(random.Uniform(0, 0.7))) /
                      static_cast<float>(num_stems);
    const auto reach = static_cast<float>(random.Uniform(0.08, 0.3)) * height;
    const float top = pot + (height - pot) * static_cast<float>(random.Uniform(0.35, 0.85));
    const Vector3f out(std::cos(turn), std::sin(turn), 0);
    const std::vector<Vector3f> stem = {0.1F * pot * out + Vector3f(0, 0, 0.85F * pot),
                                        0.4F * reach * out + Vector3f(0, 0, 0.5F * (pot + top)),
                                        reach * out + Vector3f(0, 0, top)};
    stems.Append(MakeTube(stem, 0.004F + 0.002F * height, 6));
    for (int k = 0; k < 3; ++k) {  // Leaves along the upper half.
      const float part = 0.5F + 0.25F * static_cast<float>(k);
      const Vector3f foot = stem[1] + (2 * part - 1) * (stem[2] - stem[1]);
      const auto yaw = turn + static_cast<float>(random.Uniform(-0.9, 0.9));
      const auto length = static_cast<float>(random.Uniform(0.16, 0.26)) * height;
      const auto droop = static_cast<float>(random.Uniform(-0.5, 0.4));
      TriangleMesh leaf = MakeEllipsoid({0.5F * length, 0.17F * length, 0.012F * length}, 14);
      leaf = Placed(Translated(std::move(leaf), {0.5F * length, 0, 0}), {0, droop, 0},
                    Vector3f::Zero());
      leaves.Append(Placed(std::move(leaf), {0, 0, yaw}, foot));
    }
  }
  const Vector3f green(0.22F, static_cast<float>(random.Uniform(0.4, 0.55)), 0.24F);
  const NoiseStyle leaf_style = {.color = green, .contrast = 0.5F, .period = 6, .num_octaves = 4};
  const NoiseStyle soil = {.color = {0.12F, 0.16F, 0.22F}, .contrast = 0.5F, .period = 16};
  Material foliage = Printed([=] { return DrawNoise({128, 128}, leaf_style, seed); }, 0.1F, 0.1F);
  foliage.specular = 0.12F;
  const Vector3f clay = RandomColor(random, random.Uniform(0.1, 0.6), random.Uniform(0.4, 0.8));
  return {"pottedplant",
          {{MakeLathe(profile, 32, false), GrainyPlastic(clay, seed)},
           {Translated(MakeCylinder(0.43F * pot, 0.004F), {0, 0, 0.88F * pot}),
            Printed(
                [=] {
                  return DrawNoise({128, 128}, soil, seed);
                },
                0.1F, 0.1F)},
           {stems, Plastic(0.8F * green)},
           {leaves, foliage}}};
}

}  // namespace semslam

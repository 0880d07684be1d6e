// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// More small things that lie about in offices.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>

#include "semslam/base/random.h"
#include "semslam/render/objects.h"
#include "semslam/render/patterns.h"

#include "render/drawing.h"
#include "render/object_parts.h"

namespace semslam {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

}  // namespace

Object MakeBottle(std::uint64_t seed) {
  Random random(seed);
  const auto radius = static_cast<float>(random.Uniform(0.03, 0.042));
  const auto height = static_cast<float>(random.Uniform(0.2, 0.29));
  const float shoulder = 0.68F * height;
  const std::vector<Eigen::Vector2f> profile = {
      {0, 0},
      {0.8F * radius, 0},
      {radius, 0.01F},
      {radius, shoulder},
      {0.8F * radius, shoulder + 0.09F * height},
      {0.4F * radius, shoulder + 0.19F * height},
      {0.38F * radius, 0.93F * height},
  };
  const Vector3f glass = RandomColor(random, random.Uniform(0.2, 0.8), random.Uniform(0.3, 0.75));
  const Vector3f label = RandomColor(random, 0.6, 0.8);
  const float around = 2 * kPi * radius;
  const TriangleMesh band = Translated(
      MakeLathe(
          std::vector<Eigen::Vector2f>{{radius + 0.0006F, 0}, {radius + 0.0006F, 0.4F * height}},
          40, false),
      {0, 0, 0.18F * height});
  return {"bottle",
          {{MakeLathe(profile, 40, true), Plastic(glass, 0.7F)},
           {band, Printed(
                      [=] {
                        return DrawLabel({384, 160}, label, seed);
                      },
                      0.5F * around, 0.4F * height)},
           {Translated(MakeCylinder(0.48F * radius, 0.08F * height, 24), {0, 0, 0.92F * height}),
            Plastic(RandomColor(random, 0.8, 0.6), 0.2F)}}};
}

Object MakeNotebook(std::uint64_t seed) {
  Random random(seed);
  const Vector3f size(0.15F, 0.21F, 0.012F);
  const Vector3f color = RandomColor(random, random.Uniform(0.4, 0.9), random.Uniform(0.3, 0.8));
  TriangleMesh rings;
  for (int i = 0; i < 20; ++i) {  // Open rings of wire along the left edge.
    std::vector<Vector3f> ring;
    const float y = 0.01F * (static_cast<float>(i) - 9.5F);
    for (int k = 0; k <= 8; ++k) {
      const float angle = kPi * (1.25F - 0.19F * static_cast<float>(k));
      ring.emplace_back(-0.5F * size.x() + 0.009F * std::cos(angle), y,
                        0.5F * size.z() + 0.002F + 0.007F * std::sin(angle));
    }
    rings.Append(MakeTube(ring, 0.0009F, 5));
  }
  const auto draw = [=] { return DrawCover({300, 420}, color, seed); };
  return {"notebook",
          {{WithPlanarUv(BoxOn({size.x(), size.y(), 0.002F}, {0, 0, size.z() - 0.002F}),
                         -0.5F * size.head<2>()),
            Printed(draw, size.x(), size.y())},
           {BoxOn({0.97F * size.x(), 0.98F * size.y(), size.z() - 0.002F}, Vector3f::Zero()),
            Plastic({0.82F, 0.88F, 0.9F}, 0)},
           {rings, Plastic(Vector3f::Constant(0.6F), 0.6F)}}};
}

Object MakeLaptop(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = Vector3f::Constant(static_cast<float>(random.Uniform(0.2, 0.7)));
  constexpr float kWidth = 0.34F;
  constexpr float kDepth = 0.235F;
  constexpr float kOpen = -0.3F;  // Radians by which the lid leans back.
  const Vector3f hinge(0, 0.5F * kDepth, 0.018F);
  const auto on_lid = [&](TriangleMesh mesh) {
    return Placed(std::move(mesh), {kOpen, 0, 0}, hinge);
  };
  TriangleMesh keys;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 15; ++column) {
      const bool is_space = row == 0 && column >= 4 && column <= 8;
      if (is_space && column != 6) continue;
      const float width = is_space ? 0.1F : 0.0165F;
      keys.Append(RoundedBoxOn({width, 0.0155F, 0.003F}, 0.001F,
                               {0.0205F * (static_cast<float>(column) - 7.0F),
                                0.0185F * static_cast<float>(row) - 0.018F, 0.017F}));
    }
  }
  const cv::Size pixels(768, 470);
  Material glow = Printed([=] { return DrawScreen(pixels, seed); }, kWidth - 0.03F, kDepth - 0.04F);
  glow.emission = 0.45F;
  const Material shell = GrainyPlastic(color, seed);
  return {
      "laptop",
      {{RoundedBoxOn({kWidth, kDepth, 0.017F}, 0.006F, Vector3f::Zero()), shell},
       {on_lid(RoundedBoxOn({kWidth, 0.008F, kDepth}, 0.003F, Vector3f::Zero())), shell},
       {on_lid(MakeUpright(kWidth - 0.03F, kDepth - 0.04F, {0, -0.0046F, 0.5F * kDepth})), glow},
       {keys, Plastic(Vector3f::Constant(color.x() > 0.45F ? 0.2F : 0.07F), 0.1F)},
       {RoundedBoxOn({0.1F, 0.06F, 0.002F}, 0.0009F, {0, -0.075F, 0.016F}),
        Plastic(0.8F * color, 0.3F)}}};
}

Object MakePhone(std::uint64_t seed) {
  Random random(seed);
  const Vector3f size(0.072F, 0.15F, 0.009F);
  Material glow = Printed([=] { return DrawScreen({240, 480}, seed); }, 0.066F, 0.138F);
  glow.emission = random.Uniform() < 0.5 ? 0.3F : 0.02F;
  glow.specular = 0.4F;
  const TriangleMesh screen = Translated(MakeRectangle(0.066F, 0.138F), {0, 0, size.z() + 0.0002F});
  const Vector3f color = RandomColor(random, 0.2, random.Uniform(0.1, 0.5));
  return {"cell phone",
          {{RoundedBoxOn(size, 0.0035F, Vector3f::Zero()), Plastic(color, 0.4F)}, {screen, glow}}};
}

Object MakeBinder(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = RandomColor(random, random.Uniform(0.1, 0.9), random.Uniform(0.25, 0.8));
  const auto width = static_cast<float>(random.Uniform(0.05, 0.082));
  constexpr float kDepth = 0.28F;
  constexpr float kHeight = 0.318F;
  const Vector3f board(0.003F, kDepth, kHeight);
  TriangleMesh cover;
  for (const float side : {-0.5F, 0.5F})
    cover.Append(BoxOn(board, {side * (width - board.x()), 0, 0}));
  const TriangleMesh spine = BoxOn({width, 0.003F, kHeight}, {0, -0.5F * kDepth, 0});
  const NoiseStyle paper = {
      .color = {0.8F, 0.88F, 0.9F}, .contrast = 0.25F, .period = 64, .num_octaves = 1};
  const auto draw = [=] {
    cv::Mat upright;
    cv::rotate(DrawSpine({640, 144}, color, seed), upright, cv::ROTATE_90_CLOCKWISE);
    return upright;
  };
  return {"binder",
          {{spine, Printed(draw, width, kHeight)},
           {cover, GrainyPlastic(color, seed)},
           {BoxOn({width - 0.008F, kDepth - 0.02F, kHeight - 0.02F}, {0, 0, 0.005F}),
            Printed(
                [=] {
                  return DrawNoise({64, 64}, paper, seed);
                },
                0.02F, 0.3F)}}};
}

Object MakeDeskLamp(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = RandomColor(random, random.Uniform(0, 0.8), random.Uniform(0.15, 0.8));
  const std::vector<Eigen::Vector2f> base = {
      {0, 0}, {0.085F, 0}, {0.085F, 0.012F}, {0.02F, 0.03F}, {0, 0.03F}};
  const std::vector<Vector3f> arm = {
      {0, 0, 0.02F}, {0.02F, 0.03F, 0.2F}, {0, 0.06F, 0.36F}, {0, 0, 0.44F}, {0, -0.08F, 0.45F}};
  const std::vector<Eigen::Vector2f> shade = {{0.075F, 0}, {0.03F, 0.085F},  {0.02F, 0.1F},
                                              {0, 0.1F},   {0.018F, 0.097F}, {0.07F, 0}};
  Material glow = Plastic({0.75F, 0.9F, 1}, 0);
  glow.emission = 1.4F;
  const Vector3f turn(0.5F, 0, 0);
  const Vector3f head(0, -0.12F, 0.365F);
  TriangleMesh body = MakeLathe(base, 36, false);
  body.Append(MakeTube(SmoothLine(arm), 0.008F));
  body.Append(Placed(MakeLathe(shade, 36, false), -turn, head));
  return {"lamp",
          {{body, Plastic(color, 0.4F)},
           {Placed(Translated(MakeEllipsoid(Vector3f::Constant(0.03F), 20), {0, 0, 0.035F}), -turn,
                   head),
            glow}}};
}

Object MakePowerStrip(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = Vector3f::Constant(random.Uniform() < 0.6 ? 0.82F : 0.15F);
  const TriangleMesh body = RoundedBoxOn({0.3F, 0.055F, 0.04F}, 0.008F, Vector3f::Zero());
  TriangleMesh sockets;
  TriangleMesh plugs;
  TriangleMesh cables;
  for (int i = 0; i < 5; ++i) {
    const float x = 0.055F * (static_cast<float>(i) - 2.2F);
    sockets.Append(Translated(MakeCylinder(0.019F, 0.0006F, 24), {x, 0, 0.04F}));
    if (random.Uniform() < 0.4) continue;
    plugs.Append(Translated(MakeCylinder(0.017F, 0.035F, 20), {x, 0, 0.04F}));
    const auto sway = static_cast<float>(random.Uniform(-0.1, 0.1));
    cables.Append(MakeTube(SmoothLine({{x, 0, 0.075F},
                                       {x, 0.02F, 0.1F},
                                       {x + 0.3F * sway, 0.09F, 0.06F},
                                       {x + sway, 0.14F, 0.005F},
                                       {x + 2 * sway, 0.25F, 0.005F}}),
                           0.0035F, 8));
  }
  cables.Append(MakeTube(
      SmoothLine(
          {{0.15F, 0, 0.02F}, {0.2F, 0, 0.006F}, {0.3F, 0.06F, 0.005F}, {0.34F, 0.2F, 0.005F}}),
      0.004F, 8));
  plugs.Append(BoxOn({0.018F, 0.025F, 0.006F}, {0.13F, 0, 0.039F}));
  return {"power strip",
          {{body, Plastic(color)},
           {sockets, Plastic(0.6F * color)},
           {plugs, Plastic(Vector3f::Constant(0.1F))},
           {cables, Plastic(Vector3f::Constant(0.12F))}}};
}

Object MakePrinter(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = Vector3f::Constant(static_cast<float>(random.Uniform(0.2, 0.8)));
  TriangleMesh body = RoundedBoxOn({0.42F, 0.36F, 0.2F}, 0.02F, Vector3f::Zero());
  body.Append(RoundedBoxOn({0.4F, 0.3F, 0.05F}, 0.018F, {0, 0.02F, 0.19F}));
  TriangleMesh dark = BoxOn({0.3F, 0.012F, 0.06F}, {0, -0.18F, 0.09F});
  dark.Append(BoxOn({0.3F, 0.14F, 0.006F}, {0, -0.24F, 0.085F}));
  dark.Append(Placed(MakeRoundedBox({0.14F, 0.07F, 0.012F}, 0.004F), {0.5F, 0, 0},
                     {0.12F, -0.155F, 0.205F}));
  const TriangleMesh sheet = BoxOn({0.21F, 0.18F, 0.004F}, {0, -0.23F, 0.0912F});
  return {"printer",
          {{body, GrainyPlastic(color, seed)},
           {dark, Plastic(0.35F * color, 0.3F)},
           {WithPlanarUv(sheet, {-0.105F, -0.32F}), Printed(
                                                        [=] {
                                                          return DrawPage({256, 362}, seed);
                                                        },
                                                        0.21F, 0.297F)}}};
}

}  // namespace semslam

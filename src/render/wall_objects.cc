// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// What a room is made of, and what is in or on its walls.
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

// Four bars around a rectangle (outer size, at its lower edge) in the plane of a wall.
TriangleMesh MakeFrame(float width, float height, float bar, float depth, const Vector3f& bottom) {
  TriangleMesh frame;
  for (const float side : {-0.5F, 0.5F}) {
    frame.Append(BoxOn({bar, depth, height}, bottom + Vector3f(side * (width - bar), 0, 0)));
  }
  for (const float z : {0.0F, height - bar})
    frame.Append(BoxOn({width - 2 * bar, depth, bar}, bottom + Vector3f(0, 0, z)));
  return frame;
}

}  // namespace

Object MakePoster(float width, float height, std::uint64_t seed) {
  const TriangleMesh sheet = MakeBox({width, 0.004F, height});
  const cv::Size pixels = PixelsFor(width, height, 900);
  return {"poster", {{sheet, Printed([=] { return DrawPoster(pixels, seed); }, width, height)}}};
}

Object MakePicture(float width, float height, std::uint64_t seed) {
  Random random(seed);
  constexpr float kBar = 0.025F;
  const Vector3f color =
      random.Uniform() < 0.5 ? Vector3f::Constant(0.12F) : Vector3f(0.25F, 0.4F, 0.55F);
  const cv::Size pixels = PixelsFor(width, height, 900);
  const bool is_view = random.Uniform() < 0.5;
  const auto draw = [=] {
    return is_view ? DrawOutdoors(pixels, seed) : DrawMotif(pixels, {0.8F, 0.85F, 0.88F}, seed);
  };
  const Vector3f bottom(0, 0, -0.5F * height);
  return {
      "picture",
      {{MakeUpright(width - kBar, height - kBar, {0, -0.004F, 0}), Printed(draw, width, height)},
       {MakeFrame(width, height, kBar, 0.02F, bottom), Plastic(color, 0.2F)}}};
}

Object MakeWhiteboard(float width, float height, std::uint64_t seed) {
  Random random(seed);
  const cv::Size pixels = PixelsFor(width, height, 700);
  Material board = Printed([=] { return DrawWhiteboard(pixels, seed); }, width, height);
  board.specular = 0.15F;
  const float low = -0.5F * height;
  TriangleMesh frame = MakeFrame(width, height, 0.018F, 0.02F, {0, 0, low});
  frame.Append(BoxOn({0.5F * width, 0.07F, 0.012F}, {0, -0.045F, low}));
  Object object{"whiteboard",
                {{MakeUpright(width - 0.02F, height - 0.02F, {0, -0.004F, 0}), board},
                 {frame, Plastic(Vector3f::Constant(0.55F), 0.4F)}}};
  for (int i = 0; i < 4; ++i) {  // Pens on the ledge.
    const float x = width * (0.09F * static_cast<float>(i) - 0.16F);
    const std::vector<Vector3f> pen = {{x, -0.05F, low + 0.021F},
                                       {x + 0.11F, -0.052F, low + 0.021F}};
    object.parts.push_back({MakeTube(pen, 0.009F, 10), Plastic(RandomColor(random, 0.9, 0.6))});
  }
  return object;
}

Object MakeClock(std::uint64_t seed) {
  constexpr float kRadius = 0.15F;
  const TriangleMesh rim =
      Placed(MakeCylinder(kRadius, 0.035F, 48), {0.5F * kPi, 0, 0}, {0, 0.0175F, 0});
  const std::vector<Eigen::Vector2f> disc = {{0, 0}, {0.9F * kRadius, 0}};
  TriangleMesh face = Placed(MakeLathe(disc, 48, false), {-0.5F * kPi, 0, 0}, {0, -0.0185F, 0});
  for (std::size_t i = 0; i < face.positions.size(); ++i) {
    face.uvs[i] =
        Eigen::Vector2f(face.positions[i].x(), face.positions[i].z()).array() + 0.9F * kRadius;
  }
  constexpr float kFace = 1.8F * kRadius;
  return {"clock",
          {{face, Printed(
                      [=] {
                        return DrawClock({256, 256}, seed);
                      },
                      kFace, kFace)},
           {rim, Plastic(Vector3f::Constant(0.15F), 0.3F)}}};
}

Object MakeWindow(float width, float height, std::uint64_t seed) {
  const cv::Size pixels = PixelsFor(width, height, 500);
  Material view = Printed([=] { return DrawOutdoors(pixels, seed); }, width, height);
  view.emission = 0.55F;
  constexpr float kBar = 0.06F;
  TriangleMesh frame = MakeFrame(width, height, kBar, 0.07F, Vector3f::Zero());
  frame.Append(BoxOn({kBar, 0.06F, height - 2 * kBar}, {0, 0, kBar}));
  frame.Append(BoxOn({width + 0.1F, 0.2F, 0.03F}, {0, -0.08F, -0.03F}));  // Sill.
  TriangleMesh handles;
  const std::vector<Vector3f> handle = {{0.02F, -0.035F, 0.5F * height},
                                        {0.02F, -0.075F, 0.5F * height},
                                        {0.02F, -0.075F, 0.5F * height - 0.11F}};
  handles.Append(MakeTube(handle, 0.009F, 10));
  Object window{"window",
                {{frame, Plastic({0.86F, 0.88F, 0.88F}, 0.15F)},
                 {MakeUpright(width - kBar, height - kBar, {0, 0.01F, 0.5F * height}), view},
                 {handles, Plastic(Vector3f::Constant(0.5F), 0.4F)}}};
  window.places.push_back({{0, -0.1F, 0}, {0.5F * width, 0.06F}});
  return window;
}

Object MakeDoor(float width, float height, std::uint64_t seed) {
  Random random(seed);
  constexpr float kBar = 0.07F;
  const float leaf_width = width - 2 * kBar;
  TriangleMesh panels;
  for (const float z : {0.15F, 0.55F * height}) {
    for (const float side : {-0.25F, 0.25F}) {
      panels.Append(RoundedBoxOn({0.36F * leaf_width, 0.02F, 0.36F * height}, 0.008F,
                                 {side * leaf_width, -0.03F, z}));
    }
  }
  const float x = 0.42F * leaf_width;
  const float z = 0.49F * height;
  TriangleMesh handle = MakeTube(
      std::vector<Vector3f>{{x, -0.03F, z}, {x, -0.085F, z}, {x - 0.12F, -0.085F, z}}, 0.01F);
  handle.Append(RoundedBoxOn({0.04F, 0.012F, 0.22F}, 0.005F, {x, -0.034F, z - 0.16F}));
  const bool is_painted = random.Uniform() < 0.5;
  const Vector3f color = is_painted ? RandomColor(random, 0.1, 0.8) : Vector3f(0.3F, 0.47F, 0.64F);
  const Material leaf = is_painted ? GrainyPlastic(color, seed) : Wooden(color, seed);
  return {"door",
          {{BoxOn({leaf_width, 0.03F, height - kBar}, {0, -0.014F, 0}), leaf},
           {panels, leaf},
           {MakeFrame(width, height, kBar, 0.09F, Vector3f::Zero()),
            Plastic({0.7F, 0.74F, 0.76F}, 0.1F)},
           {handle, Plastic(Vector3f::Constant(0.6F), 0.6F)}}};
}

Object MakeRadiator(float width, float height, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh body = BoxOn({width, 0.03F, height - 0.12F}, {0, 0.03F, 0.12F});
  const int num_ribs = std::max(2, static_cast<int>(width / 0.045F));
  for (int i = 0; i < num_ribs; ++i) {
    const float x = width * ((static_cast<float>(i) + 0.5F) / static_cast<float>(num_ribs) - 0.5F);
    body.Append(RoundedBoxOn({0.028F, 0.06F, height - 0.12F}, 0.011F, {x, -0.01F, 0.12F}));
  }
  const float end = 0.5F * width;
  body.Append(MakeTube(
      std::vector<Vector3f>{
          {end - 0.02F, 0.02F, 0.17F}, {end + 0.05F, 0.02F, 0.17F}, {end + 0.05F, 0.02F, 0.01F}},
      0.01F));
  const TriangleMesh knob = Placed(MakeCylinder(0.022F, 0.06F, 20), {0, 0.5F * kPi, 0},
                                   {end + 0.01F, 0.0F, height - 0.06F});
  return {"radiator",
          {{body, GrainyPlastic(RandomColor(random, 0.04, 0.84), seed)},
           {knob, Plastic(Vector3f::Constant(0.75F))}}};
}

Object MakeShelf(float width, float depth, std::uint64_t seed) {
  TriangleMesh board = Translated(MakeBox({width, depth, 0.024F}), {0, 0, -0.012F});
  TriangleMesh brackets;
  for (const float side : {-0.38F, 0.38F}) {
    brackets.Append(BoxOn({0.02F, 0.8F * depth, 0.02F}, {side * width, 0.1F * depth, -0.044F}));
    brackets.Append(BoxOn({0.02F, 0.02F, 0.16F}, {side * width, 0.5F * depth - 0.01F, -0.184F}));
  }
  Object shelf{"shelf",
               {{board, Wooden({0.5F, 0.66F, 0.78F}, seed)},
                {brackets, Plastic(Vector3f::Constant(0.4F), 0.4F)}}};
  shelf.places.push_back({Vector3f::Zero(), {0.5F * width, 0.5F * depth}});
  return shelf;
}

Object MakeFloor(float width, float depth, std::uint64_t seed) {
  const auto draw = [=] { return DrawCarpet({512, 512}, {0.42F, 0.38F, 0.36F}, seed); };
  return {"floor", {{MakeRectangle(width, depth), Printed(draw, 0.8F, 0.8F)}}};
}

Object MakeWall(float width, float height, std::uint64_t seed) {
  const NoiseStyle plaster = {.color = {0.78F, 0.83F, 0.85F},
                              .contrast = 0.07F,
                              .period = 24,
                              .num_octaves = 4,
                              .roughness = 0.95F};
  return {"wall",
          {{MakeUpright(width, height, {0, 0, 0.5F * height}),
            Printed(
                [=] {
                  return DrawNoise({512, 512}, plaster, seed);
                },
                1.0F, 1.0F)}}};
}

Object MakeCeiling(float width, float depth, std::uint64_t seed) {
  const NoiseStyle paint = {.color = {0.88F, 0.9F, 0.9F}, .contrast = 0.05F, .period = 16};
  return {"ceiling",
          {{Placed(MakeRectangle(width, depth), {kPi, 0, 0}, Vector3f::Zero()),
            Printed(
                [=] {
                  return DrawNoise({256, 256}, paint, seed);
                },
                1.0F, 1.0F)}}};
}

}  // namespace semslam

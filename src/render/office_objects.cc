// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Things on a desk that no detector looks for.
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/imgproc.hpp>

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

Object MakeBook(const Vector3f& size, std::uint64_t seed) {
  Random random(seed);
  constexpr float kBoard = 0.0025F;  // Thickness of the cover.
  const Vector3f color = RandomColor(random, random.Uniform(0.15, 0.8), random.Uniform(0.2, 0.85));
  const Vector3f inner(size.x() - 0.008F, size.y() - 0.006F, size.z() - 2 * kBoard);
  const TriangleMesh pages = Translated(MakeBox(inner), {0, 0, 0.5F * size.z()});
  TriangleMesh boards;
  for (const float z : {0.5F * kBoard, size.z() - 0.5F * kBoard}) {
    boards.Append(Translated(MakeBox({size.x(), size.y(), kBoard}), {0, 0, z}));
  }
  const TriangleMesh spine = Translated(MakeBox({size.x(), kBoard, size.z()}),
                                        {0, -0.5F * size.y() + 0.5F * kBoard, 0.5F * size.z()});
  // The cover is upright for a reader who has the spine on the left: turn it so.
  const auto cover = [=] {
    cv::Mat turned;
    cv::rotate(DrawCover(PixelsFor(size.y(), size.x(), 1600), color, seed), turned,
               cv::ROTATE_90_COUNTERCLOCKWISE);
    return turned;
  };
  const auto title = [=] {
    return DrawSpine(PixelsFor(size.x(), size.z(), 2400), color, seed + 1);
  };
  const NoiseStyle paper = {
      .color = {0.8F, 0.88F, 0.9F}, .contrast = 0.25F, .period = 64, .num_octaves = 1};
  return {"book",
          {{WithPlanarUv(boards, {-0.5F * size.x(), -0.5F * size.y()}),
            Printed(cover, size.x(), size.y())},
           {spine, Printed(title, size.x(), size.z())},
           {pages, Printed(
                       [=] {
                         return DrawNoise({64, 64}, paper, seed);
                       },
                       0.3F, 0.02F)}}};
}

Object MakeCardboardBox(const Vector3f& size, std::uint64_t seed) {
  const TriangleMesh body = Translated(MakeBox(size), {0, 0, 0.5F * size.z()});
  return {"box",
          {{body, Printed(
                      [=] {
                        return DrawCardboard({384, 320}, seed);
                      },
                      size.x(), size.z())}}};
}

Object MakeTelephone(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = Vector3f::Constant(static_cast<float>(random.Uniform(0.15, 0.8)));
  const Vector3f key_color = Vector3f::Constant(color.x() > 0.5F ? 0.25F : 0.8F);
  constexpr float kTilt = 0.2F;  // Radians by which the top leans towards the user.
  const Vector3f top_center(0, 0, 0.045F);
  const auto on_top = [&](TriangleMesh mesh, const Vector3f& offset) {
    return Placed(Translated(std::move(mesh), offset), {kTilt, 0, 0}, top_center);
  };
  TriangleMesh base = on_top(MakeRoundedBox({0.19F, 0.21F, 0.03F}, 0.01F), Vector3f::Zero());
  base.Append(Translated(MakeRoundedBox({0.18F, 0.12F, 0.05F}, 0.01F), {0, 0.03F, 0.025F}));
  TriangleMesh keys;
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 3; ++column) {
      keys.Append(on_top(MakeRoundedBox({0.018F, 0.014F, 0.01F}, 0.003F, 1),
                         {0.01F + 0.026F * static_cast<float>(column),
                          -0.07F + 0.021F * static_cast<float>(row), 0.017F}));
    }
  }
  TriangleMesh handset = MakeTube(
      std::vector<Vector3f>{
          {0, -0.075F, 0.045F}, {0, -0.03F, 0.058F}, {0, 0.03F, 0.058F}, {0, 0.075F, 0.045F}},
      0.014F);
  for (const float y : {-0.078F, 0.078F}) {
    handset.Append(Translated(MakeEllipsoid({0.028F, 0.028F, 0.02F}, 24), {0, y, 0.034F}));
  }
  const TriangleMesh display =
      on_top(MakeRoundedBox({0.085F, 0.035F, 0.006F}, 0.002F, 1), {0.04F, 0.07F, 0.015F});
  const std::vector<Vector3f> cord = {{-0.07F, -0.08F, 0.03F},
                                      {-0.12F, -0.1F, 0.006F},
                                      {-0.14F, 0, 0.006F},
                                      {-0.11F, 0.09F, 0.006F},
                                      {-0.07F, 0.1F, 0.02F}};
  return {"telephone",
          {{base, GrainyPlastic(color, seed)},
           {keys, Plastic(key_color)},
           {on_top(handset, {-0.055F, 0, 0}), GrainyPlastic(color * 0.85F, seed + 1)},
           {display, Plastic({0.45F, 0.6F, 0.5F}, 0.4F)},
           {MakeTube(SmoothLine(cord), 0.004F, 8), Plastic(color * 0.6F)}}};
}

Object MakePenHolder(std::uint64_t seed) {
  Random random(seed);
  constexpr float kRadius = 0.038F;
  constexpr float kHeight = 0.1F;
  const std::vector<Eigen::Vector2f> profile = {{0, 0},
                                                {kRadius, 0},
                                                {kRadius, kHeight},
                                                {kRadius - 0.003F, kHeight},
                                                {kRadius - 0.003F, 0.004F},
                                                {0, 0.004F}};
  Object object{"pen holder", {}};
  const NoiseStyle style = {
      .color = RandomColor(random, 0.5, 0.5), .contrast = 0.6F, .period = 12, .num_octaves = 2};
  object.parts.push_back(
      {MakeLathe(profile, 32, false), Printed(
                                          [=] {
                                            return DrawNoise({128, 64}, style, seed);
                                          },
                                          0.24F, 0.1F)});
  for (int i = 0; i < 6; ++i) {
    const auto angle = static_cast<float>(random.Uniform(0, 2 * kPi));
    const Vector3f side(std::cos(angle), std::sin(angle), 0);
    const Vector3f foot = -0.02F * side + 0.01F * Vector3f::UnitZ();
    const Vector3f tip =
        0.036F * side + Vector3f(0, 0, static_cast<float>(random.Uniform(0.14, 0.17)));
    const std::vector<Vector3f> line = {foot, foot + 0.85F * (tip - foot)};
    const std::vector<Vector3f> end = {foot + 0.86F * (tip - foot), tip};
    object.parts.push_back({MakeTube(line, 0.0042F, 8), Plastic(RandomColor(random, 0.9, 0.7))});
    object.parts.push_back({MakeTube(end, 0.0032F, 8), Plastic(Vector3f::Constant(0.15F))});
  }
  return object;
}

Object MakePaper(std::uint64_t seed) {
  const Vector3f size(0.21F, 0.297F, 0.0006F);
  const TriangleMesh sheet = Translated(MakeBox(size), {0, 0, 0.5F * size.z()});
  return {"paper",
          {{WithPlanarUv(sheet, -0.5F * size.head<2>()), Printed(
                                                             [=] {
                                                               return DrawPage({512, 724}, seed);
                                                             },
                                                             size.x(), size.y())}}};
}

}  // namespace semslam

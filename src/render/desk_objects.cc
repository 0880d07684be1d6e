// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// The objects whose classes a detector looks for.
#include <array>
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

constexpr float kKeyPitch = 0.019F;  // Metres from key to key.
constexpr float kKeyGap = 0.0025F;
constexpr int kLegendPixelsPerKey = 20;

// A keyboard's rows from the user's side: widths of the keys in units of a letter key, negative for
// a gap.
std::vector<std::vector<float>> MakeKeyRows() {
  const std::vector<float> numpad = {1, 1, 1};
  std::vector<std::vector<float>> rows = {
      {1.5F, 1.25F, 1.25F, 6, 1.25F, 1.25F, 1.5F, -0.25F, 1, 1, 1, -0.25F, 2, 1},
      {2.25F, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1.75F, -1.25F, 1, -1.25F},
      {1.75F, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1.25F, -3.5F},
      {1.5F, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1.5F, -0.25F, 1, 1, 1, -0.25F},
      {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, -0.25F, 1, 1, 1, -0.25F},
      {1, -1, 1, 1, 1, 1, -0.33F, 1, 1, 1, 1, -0.33F, 1, 1, 1, -0.34F, -0.25F, 1, 1, 1},
  };
  for (std::size_t i = 1; i + 1 < rows.size(); ++i)
    rows[i].insert(rows[i].end(), numpad.begin(), numpad.end());
  return rows;
}

// Key caps with a letter or two on each, seen from above; drawn where the keys are.
cv::Mat DrawLegends(float width, float depth, const Vector3f& color, std::uint64_t seed) {
  Random random(seed);
  const float scale = kLegendPixelsPerKey / kKeyPitch;
  cv::Mat image(cvRound(depth * scale), cvRound(width * scale), CV_8UC3, ToScalar(color));
  const cv::Scalar print = ToScalar(Vector3f::Constant(color.mean() > 0.5F ? 0.1F : 0.92F));
  int row_index = 0;
  for (const std::vector<float>& row : MakeKeyRows()) {
    float x = 0;
    for (const float key_width : row) {
      if (key_width > 0 && key_width < 5) {
        const std::string word = RandomWord(random, true).substr(0, key_width > 1.2F ? 3 : 1);
        const int left = cvRound((x + 0.2F) * kLegendPixelsPerKey);
        const int base =
            image.rows - cvRound((static_cast<float>(row_index) + 0.4F) * kLegendPixelsPerKey);
        cv::putText(image, word, {left, base}, cv::FONT_HERSHEY_SIMPLEX, 0.38, print, 1,
                    cv::LINE_AA);
      }
      x += std::abs(key_width);
    }
    ++row_index;
  }
  return image;
}

TriangleMesh MakeKeys(float width, float depth) {
  TriangleMesh keys;
  float y = -0.5F * depth;
  for (const std::vector<float>& row : MakeKeyRows()) {
    float x = -0.5F * width;
    for (const float key_width : row) {
      const float cap_width = std::abs(key_width) * kKeyPitch;
      if (key_width > 0) {
        const Vector3f size(cap_width - kKeyGap, kKeyPitch - kKeyGap, 0.009F);
        keys.Append(Translated(MakeRoundedBox(size, 0.0018F, 1),
                               {x + 0.5F * cap_width, y + 0.5F * kKeyPitch, 0.0165F}));
      }
      x += cap_width;
    }
    y += kKeyPitch;
  }
  return WithPlanarUv(std::move(keys), {-0.5F * width, -0.5F * depth});
}

// An ellipsoid limb of the bear, turned about the x axis, then about the z axis.
TriangleMesh MakeLimb(const Vector3f& radii, float pitch, float yaw, const Vector3f& center) {
  return Placed(Placed(MakeEllipsoid(radii, 24), {pitch, 0, 0}, Vector3f::Zero()), {0, 0, yaw},
                center);
}

}  // namespace

Object MakeMug(std::uint64_t seed) {
  Random random(seed);
  const auto radius = static_cast<float>(random.Uniform(0.038, 0.046));
  const auto height = static_cast<float>(random.Uniform(0.088, 0.11));
  constexpr float kWall = 0.004F;
  const bool is_plain = random.Uniform() < 0.3;
  const Vector3f color =
      RandomColor(random, random.Uniform(0.0, 0.8), random.Uniform(is_plain ? 0.25 : 0.6, 0.95));
  const std::vector<Eigen::Vector2f> outside = {
      {0, 0}, {radius - 0.004F, 0}, {radius, 0.004F}, {radius, height - 0.001F}};
  const std::vector<Eigen::Vector2f> inside = {
      {radius, height - 0.001F},         {radius - 0.5F * kWall, height},
      {radius - kWall, height - 0.001F}, {radius - kWall, 2 * kWall},
      {radius - 2 * kWall, kWall},       {0, kWall}};
  std::vector<Vector3f> handle;
  for (int i = 0; i <= 14; ++i) {
    const float angle = kPi * (0.5F - static_cast<float>(i) / 14.0F);
    handle.emplace_back(radius - 0.002F + 0.030F * std::cos(angle), 0,
                        (0.5F + 0.32F * std::sin(angle)) * height);
  }
  const float around = 2.0F * kPi * radius;
  Material print = Printed(
      [=] {
        return DrawMotif({512, 192}, color, seed);
      },
      around, height + 0.004F);
  print.specular = 0.35F;
  const Material plain = Plastic(color, 0.35F);
  return {"cup",
          {{MakeLathe(outside, 48, false), is_plain ? plain : print},
           {MakeLathe(inside, 48, false), Plastic(Vector3f(0.88F, 0.92F, 0.94F), 0.3F)},
           {MakeTube(handle, 0.0055F), plain}}};
}

Object MakeKeyboard(std::uint64_t seed) {
  Random random(seed);
  constexpr float kWidth = 21.5F * kKeyPitch;
  constexpr float kDepth = 6 * kKeyPitch;
  const bool dark = random.Uniform() < 0.6;
  const Vector3f body = dark ? Vector3f(0.14F, 0.13F, 0.13F) : Vector3f(0.72F, 0.78F, 0.8F);
  const Vector3f caps = dark ? Vector3f(0.22F, 0.21F, 0.2F) : Vector3f(0.82F, 0.87F, 0.9F);
  const TriangleMesh base = Translated(
      MakeRoundedBox({kWidth + 0.03F, kDepth + 0.035F, 0.016F}, 0.006F), {0, 0.004F, 0.008F});
  Material legends =
      Printed([=] { return DrawLegends(kWidth, kDepth, caps, seed); }, kWidth, kDepth);
  legends.specular = 0.06F;
  return {"keyboard", {{base, GrainyPlastic(body, seed)}, {MakeKeys(kWidth, kDepth), legends}}};
}

Object MakeMouse(std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = Vector3f::Constant(static_cast<float>(random.Uniform(0.12, 0.75)));
  const TriangleMesh body = MakeDome({0.033F, 0.058F, 0.037F}, 32);
  const TriangleMesh seam = Translated(MakeBox({0.0015F, 0.05F, 0.03F}), {0, -0.026F, 0.0195F});
  const TriangleMesh wheel =
      Placed(MakeCylinder(0.011F, 0.008F, 20), {0, 0.5F * kPi, 0}, {-0.004F, -0.027F, 0.026F});
  const std::vector<Vector3f> cable = {{0, 0.057F, 0.003F},
                                       {0.005F, 0.09F, 0.003F},
                                       {0.02F, 0.13F, 0.003F},
                                       {0.025F, 0.17F, 0.003F}};
  Material shell = GrainyPlastic(color, seed);
  shell.specular = 0.25F;
  return {"mouse",
          {{body, shell},
           {seam, Plastic(color * 0.4F)},
           {wheel, Plastic(Vector3f::Constant(0.3F))},
           {MakeTube(SmoothLine(cable), 0.0022F, 8), Plastic(Vector3f::Constant(0.12F))}}};
}

Object MakeMonitor(float screen_width, float screen_height, std::uint64_t seed) {
  Random random(seed);
  const Vector3f color = Vector3f::Constant(random.Uniform() < 0.7 ? 0.16F : 0.7F);
  const float center = 0.13F + 0.5F * screen_height;  // Above the desk.
  const Vector3f size(screen_width + 0.045F, 0.045F, screen_height + 0.055F);
  const TriangleMesh panel = Translated(MakeRoundedBox(size, 0.01F), {0, 0, center});
  const TriangleMesh neck = Translated(MakeBox({0.06F, 0.03F, center}), {0, 0.03F, 0.5F * center});
  const TriangleMesh foot =
      Translated(MakeRoundedBox({0.26F, 0.2F, 0.016F}, 0.006F), {0, 0.03F, 0.008F});
  const TriangleMesh button =
      Placed(MakeCylinder(0.006F, 0.003F, 16), {0.5F * kPi, 0, 0},
             {0.45F * screen_width, -0.0222F, center - 0.5F * screen_height - 0.015F});
  const cv::Size pixels(768, cvRound(768 * screen_height / screen_width));
  Material glow = Printed([=] { return DrawScreen(pixels, seed); }, screen_width, screen_height);
  glow.emission = 0.45F;
  glow.specular = 0.05F;
  const Material shell = GrainyPlastic(color, seed + 1);
  return {"tvmonitor",
          {{panel, shell},
           {neck, shell},
           {foot, shell},
           {button, Plastic(Vector3f(0.3F, 0.7F, 0.3F))},
           {MakeUpright(screen_width, screen_height, {0, -0.0235F, center}), glow}}};
}

Object MakeTeddyBear(float height, std::uint64_t seed) {
  Random random(seed);
  const auto light = static_cast<float>(random.Uniform(0.75, 1.1));
  const Vector3f coats[] = {{0.26F, 0.42F, 0.6F},
                            {0.26F, 0.42F, 0.6F},
                            {0.45F, 0.6F, 0.75F},
                            {0.13F, 0.2F, 0.32F},
                            {0.72F, 0.78F, 0.82F}};
  const Vector3f brown = light * coats[random.Index(5)];
  const Vector3f cream = 0.5F * (brown + light * Vector3f(0.7F, 0.82F, 0.9F));
  TriangleMesh fur =
      MakeLimb({0.20F, 0.17F, 0.25F}, 0, 0, {0, 0, 0.26F});                // Body; units of height.
  fur.Append(MakeLimb({0.185F, 0.17F, 0.17F}, 0, 0, {0, -0.03F, 0.64F}));  // Head.
  TriangleMesh pads;
  TriangleMesh dark;
  for (const float side : {-1.0F, 1.0F}) {
    fur.Append(MakeLimb({0.075F, 0.04F, 0.075F}, 0, 0, {side * 0.15F, -0.01F, 0.79F}));  // Ears.
    fur.Append(MakeLimb({0.07F, 0.07F, 0.17F}, -0.75F, side * 0.5F,
                        {side * 0.22F, -0.1F, 0.36F}));  // Arms.
    fur.Append(
        MakeLimb({0.09F, 0.19F, 0.09F}, 0, side * 0.35F, {side * 0.16F, -0.22F, 0.09F}));  // Legs.
    pads.Append(MakeLimb({0.075F, 0.02F, 0.08F}, 0, side * 0.35F,
                         {side * 0.225F, -0.395F, 0.09F}));  // Soles.
    pads.Append(MakeLimb({0.045F, 0.02F, 0.045F}, 0, 0, {side * 0.15F, -0.045F, 0.79F}));
    dark.Append(MakeLimb({0.02F, 0.02F, 0.022F}, 0, 0, {side * 0.065F, -0.185F, 0.69F}));  // Eyes.
  }
  pads.Append(MakeLimb({0.085F, 0.07F, 0.065F}, 0, 0, {0, -0.175F, 0.605F}));  // Snout.
  pads.Append(MakeLimb({0.13F, 0.05F, 0.16F}, 0, 0, {0, -0.135F, 0.25F}));     // Belly.
  dark.Append(MakeLimb({0.032F, 0.02F, 0.022F}, 0, 0, {0, -0.24F, 0.635F}));   // Nose.
  for (TriangleMesh* mesh : {&fur, &pads, &dark}) {
    for (Vector3f& position : mesh->positions) position *= height / 0.865F;
    for (Eigen::Vector2f& uv : mesh->uvs) uv *= height / 0.865F;
  }
  return {"teddy bear",
          {{fur, Printed(
                     [=] {
                       return DrawFur({256, 256}, brown, seed);
                     },
                     0.16F, 0.16F)},
           {pads, Printed(
                      [=] {
                        return DrawFur({128, 128}, cream, seed + 1);
                      },
                      0.08F, 0.08F)},
           {dark, Plastic(Vector3f::Constant(0.07F), 0.5F)}}};
}

}  // namespace semslam

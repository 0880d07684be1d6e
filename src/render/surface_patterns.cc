// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Patterns of what rooms are made and covered with.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "semslam/base/random.h"
#include "semslam/render/hash.h"
#include "semslam/render/patterns.h"

#include "render/drawing.h"
#include "render/noise.h"

namespace semslam {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

// A number for the cell (x, y) of a pattern, in [0, 1).
float CellValue(std::uint64_t seed, int x, int y) {
  return UnitFloat(HashOf(seed, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)));
}

float Fraction(float value) { return value - std::floor(value); }

}  // namespace

cv::Mat DrawBricks(cv::Size size,
                   const Vector3f& color,
                   const Vector3f& joint,
                   float contrast,
                   std::uint64_t seed) {
  constexpr int kColumns = 4;
  constexpr int kRows = 12;
  constexpr float kJoint = 0.06F;  // Of a brick's width; bricks are three times as wide as high.
  const FractalNoise grain(seed, {20, 20}, 4, 0.8F);
  return PaintPixels(size, [&](const Vector2f& unit) {
    const int row = static_cast<int>(unit.y() * kRows);
    const float along = unit.x() * kColumns + (row % 2 == 0 ? 0.0F : 0.5F);
    const int column = static_cast<int>(along) % kColumns;
    const float x = Fraction(along);
    const float y = Fraction(unit.y() * kRows);
    const float shade = 1.0F + 0.2F * grain.At(unit);
    if (std::min(x, 1 - x) < 0.5F * kJoint || std::min(y, 1 - y) < 1.5F * kJoint)
      return ToPixel(joint, shade);
    return ToPixel(color, shade * (1.0F + contrast * (2 * CellValue(seed, column, row) - 1)));
  });
}

cv::Mat DrawTiles(cv::Size size,
                  const Vector3f& color,
                  const Vector3f& joint,
                  float contrast,
                  std::uint64_t seed) {
  constexpr int kTiles = 4;
  constexpr float kJoint = 0.025F;
  const FractalNoise clouds(seed, {9, 9}, 6, 0.6F);
  const FractalNoise specks(seed + 9, {80, 80}, 2, 0.7F);
  return PaintPixels(size, [&](const Vector2f& unit) {
    const Vector2f at = unit * kTiles;
    const float x = Fraction(at.x());
    const float y = Fraction(at.y());
    if (std::min({x, 1 - x, y, 1 - y}) < 0.5F * kJoint) return ToPixel(joint, 1);
    const float shade = CellValue(seed, static_cast<int>(at.x()), static_cast<int>(at.y())) - 0.5F;
    return ToPixel(color, 1.0F + contrast * (clouds.At(unit) + 0.5F * specks.At(unit) + shade));
  });
}

cv::Mat DrawFabric(cv::Size size,
                   const Vector3f& color,
                   const Vector3f& second,
                   float contrast,
                   std::uint64_t seed) {
  constexpr float kThreads = 64;  // Over and under.
  const FractalNoise wear(seed, {6, 6}, 4, 0.6F);
  return PaintPixels(size, [&](const Vector2f& unit) {
    const int x = static_cast<int>(unit.x() * kThreads);
    const int y = static_cast<int>(unit.y() * kThreads);
    const bool is_warp = (x + y) % 2 == 0;
    const float bulge =
        std::sin(kTwoPi * 0.5F * Fraction((is_warp ? unit.x() : unit.y()) * kThreads));
    const float thread = is_warp ? CellValue(seed, x, 7) : CellValue(seed, 3, y);
    const float shade =
        1.0F + contrast * (0.8F * (bulge - 0.6F) + 0.7F * (thread - 0.5F) + 0.6F * wear.At(unit));
    return ToPixel(CellValue(seed + 1, x, y) < 0.12F ? second : color, shade);
  });
}

cv::Mat DrawRug(cv::Size size, const Vector3f& color, const Vector3f& second, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar(color));
  const int border = size.width / 14;
  const cv::Scalar light = ToScalar(Vector3f(0.62F, 0.74F, 0.8F));
  const auto frame = [&](int inset, int width, const cv::Scalar& paint) {
    const cv::Rect area(inset, inset, size.width - 2 * inset, size.height - 2 * inset);
    cv::rectangle(image, area, paint, width);
  };
  frame(border / 2, border / 3, ToScalar(second));
  frame(border, border / 5, light);
  const int cells = 5 + static_cast<int>(random.Index(3));
  const cv::Scalar accents[] = {ToScalar(second), light, ToScalar(RandomColor(random, 0.6, 0.5))};
  const float step = static_cast<float>(size.width - 3 * border) / static_cast<float>(cells);
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const cv::Point center(cvRound(1.5 * border + (column + 0.5) * step),
                             cvRound(1.5 * border + (row + 0.5) * step));
      const int reach = cvRound(0.42F * step);
      const cv::Point diamond[] = {center + cv::Point(reach, 0), center + cv::Point(0, reach),
                                   center - cv::Point(reach, 0), center - cv::Point(0, reach)};
      cv::fillConvexPoly(image, diamond, 4, accents[(row + column) % 2], cv::LINE_AA);
      cv::circle(image, center, reach / 2, accents[random.Index(3)], cv::FILLED, cv::LINE_AA);
    }
  }
  const FractalNoise pile(seed, {100, 100}, 2, 0.8F);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      auto& pixel = image.at<cv::Vec3b>(y, x);
      const Vector2f unit(static_cast<float>(x) / static_cast<float>(size.width),
                          static_cast<float>(y) / static_cast<float>(size.height));
      const float shade = 1.0F + 0.18F * pile.At(unit);
      for (int k = 0; k < 3; ++k) pixel[k] = cv::saturate_cast<std::uint8_t>(shade * pixel[k]);
    }
  }
  return image;
}

cv::Mat DrawOutdoors(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3);
  const FractalNoise clouds(seed, {3, 5}, 5, 0.55F);
  const FractalNoise leaves(seed + 5, {24, 24}, 4, 0.8F);
  const FractalNoise hills(seed + 11, {3, 1}, 4, 0.5F);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vector2f unit(static_cast<float>(x) / static_cast<float>(size.width),
                          static_cast<float>(y) / static_cast<float>(size.height));
      const float tree_line = 0.62F + 0.12F * hills.At({unit.x(), 0});
      const float cloud = std::clamp(0.5F + 0.8F * clouds.At(unit), 0.0F, 1.0F);
      Vector3f color =
          Vector3f(0.95F, 0.82F, 0.68F) * (1 - cloud) + Vector3f::Constant(0.97F) * cloud;
      if (unit.y() > tree_line) color = Vector3f(0.25F, 0.45F, 0.3F) * (1 + 0.5F * leaves.At(unit));
      image.at<cv::Vec3b>(y, x) = ToPixel(color, 1);
    }
  }
  int x = 0;
  while (x < size.width) {  // Houses before the trees.
    const int width = size.width / 8 + static_cast<int>(random.Index(size.width / 6));
    const int top = cvRound(size.height * random.Uniform(0.45, 0.7));
    const Vector3f wall = RandomColor(random, random.Uniform(0.1, 0.35), random.Uniform(0.55, 0.9));
    cv::rectangle(image, {x, top, width, size.height - top}, ToScalar(wall), cv::FILLED);
    const int pane = std::max(4, width / 7);
    for (int v = top + pane; v + pane < size.height; v += 2 * pane) {
      for (int u = x + pane; u + pane < x + width; u += 2 * pane)
        cv::rectangle(image, {u, v, pane, pane * 5 / 4}, ToScalar(0.45F * wall), cv::FILLED);
    }
    x += width + static_cast<int>(random.Index(size.width / 4));
  }
  return image;
}

cv::Mat DrawWhiteboard(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar({0.93F, 0.94F, 0.94F}));
  const cv::Scalar pens[] = {{60, 40, 40}, {170, 60, 30}, {40, 40, 180}, {60, 130, 40}};
  const auto part = [&](int x, int y, int width, int height) -> cv::Rect {
    return {size.width * x / 1000, size.height * y / 1000, size.width * width / 1000,
            size.height * height / 1000};
  };
  DrawTextLine(image, part(50, 50, 420, 75), pens[random.Index(4)], random);
  DrawParagraph(image, part(60, 190, 380, 560), size.height / 13, pens[random.Index(4)], random);
  DrawDiagram(image, part(520, 90, 380, 330), random);
  for (int i = 0; i < 4; ++i) {
    const cv::Rect box = part(500 + 115 * i, 560 + 60 * (i % 2), 85, 120);
    const cv::Scalar& pen = pens[random.Index(4)];
    cv::rectangle(image, box, pen, 3, cv::LINE_AA);
    DrawTextLine(image, {box.x + 6, box.y + box.height / 3, box.width - 8, box.height / 4}, pen,
                 random);
    if (i > 0)
      cv::arrowedLine(image, {box.x - size.width / 30, box.y + box.height / 2},
                      {box.x, box.y + box.height / 2}, pen, 2, cv::LINE_AA, 0, 0.4);
  }
  return image;
}

cv::Mat DrawClock(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar({0.95F, 0.96F, 0.96F}));
  const cv::Point center(size.width / 2, size.height / 2);
  const double radius = 0.5 * size.width;
  const auto at = [&](double turn, double reach) {
    const double angle = 2 * std::numbers::pi * turn;
    return center + cv::Point(cvRound(reach * radius * std::sin(angle)),
                              cvRound(-reach * radius * std::cos(angle)));
  };
  for (int i = 0; i < 12; ++i)
    cv::line(image, at(i / 12.0, 0.78), at(i / 12.0, 0.92), {30, 30, 30}, i % 3 == 0 ? 7 : 3,
             cv::LINE_AA);
  const double hours = random.Uniform(0, 1);
  cv::line(image, center, at(hours, 0.48), {20, 20, 20}, 7, cv::LINE_AA);
  cv::line(image, center, at(12 * hours, 0.72), {20, 20, 20}, 4, cv::LINE_AA);
  cv::line(image, center, at(random.Uniform(0, 1), 0.8), {40, 40, 200}, 2, cv::LINE_AA);
  return image;
}

cv::Mat DrawLabel(cv::Size size, const Vector3f& color, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar(color));
  const cv::Rect paper(size.width / 12, size.height / 6, size.width * 5 / 6, size.height * 2 / 3);
  cv::rectangle(image, paper, ToScalar(RandomColor(random, 0.25, 0.95)), cv::FILLED);
  DrawTextLine(image, {paper.x + 6, paper.y + paper.height / 8, paper.width - 10, paper.height / 3},
               ToScalar(RandomColor(random, 0.9, 0.35)), random);
  DrawParagraph(image,
                {paper.x + 6, paper.y + paper.height / 2, paper.width - 10, paper.height * 2 / 5},
                std::max(7, paper.height / 9), {50, 45, 45}, random);
  return image;
}

}  // namespace semslam

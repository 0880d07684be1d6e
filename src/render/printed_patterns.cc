// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "semslam/base/random.h"
#include "semslam/render/patterns.h"

#include "render/drawing.h"

namespace semslam {
namespace {

const cv::Scalar kInk(40, 35, 35);

// A colour that stands out from the ground it is printed on.
Eigen::Vector3f PrintOn(const Eigen::Vector3f& ground) {
  if (ground.mean() > 0.5F) return 0.28F * ground;
  return Eigen::Vector3f::Constant(0.9F);
}

// A part of the picture, in thousandths of its size.
cv::Rect Part(const cv::Mat& image, int x, int y, int width, int height) {
  return {image.cols * x / 1000, image.rows * y / 1000, image.cols * width / 1000,
          image.rows * height / 1000};
}

void DrawWindow(cv::Mat& image, const cv::Rect& area, Random& random) {
  const bool dark = random.Uniform() < 0.5;
  const int bar = std::max(10, area.height / 14);
  cv::rectangle(image, area, dark ? cv::Scalar(45, 38, 35) : cv::Scalar(248, 248, 248), cv::FILLED);
  cv::rectangle(image, {area.x, area.y, area.width, bar},
                ToScalar(RandomColor(random, 0.4, dark ? 0.4 : 0.8)), cv::FILLED);
  const cv::Scalar title = dark ? cv::Scalar(230, 230, 230) : kInk;
  DrawTextLine(image, {area.x + bar, area.y + bar / 6, area.width / 3, bar * 2 / 3}, title, random);
  for (int i = 0; i < 3; ++i) {
    cv::circle(image, {area.br().x - bar / 2 - i * bar, area.y + bar / 2}, bar / 4, title, 2,
               cv::LINE_AA);
  }
  const int line = std::max(9, area.height / 26);
  int indent = 1;
  for (int y = area.y + bar + line / 2; y + line < area.br().y; y += line) {
    indent = std::clamp(indent + static_cast<int>(random.Index(3)) - 1, 1, 5);
    if (random.Uniform() < 0.12) continue;
    const int x = area.x + indent * line;
    const int width =
        std::min(area.br().x - x - line, cvRound(area.width * random.Uniform(0.2, 0.85)));
    const cv::Scalar color = ToScalar(RandomColor(random, dark ? 0.5 : 0.7, dark ? 0.95 : 0.45));
    DrawTextLine(image, {x, y, width, line * 7 / 10}, color, random);
  }
  cv::rectangle(image, area, cv::Scalar(90, 90, 90), 1);
}

// What is behind the windows: a photograph, or shapes on one colour.
cv::Mat DrawDesktop(cv::Size size, std::uint64_t seed, Random& random) {
  if (random.Uniform() < 0.5) return DrawOutdoors(size, seed);
  cv::Mat image(size, CV_8UC3, ToScalar(RandomColor(random, 0.5, 0.45)));
  DrawShapes(image, {0, 0, size.width, size.height}, 12, random);
  return image;
}

}  // namespace

cv::Mat DrawPage(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar({0.93F, 0.95F, 0.96F}));
  const int line = std::max(6, size.height / 42);
  DrawTextLine(image, {size.width / 8, size.height / 14, size.width * 3 / 4, line * 2}, kInk,
               random);
  const bool has_diagram = random.Uniform() < 0.6;
  DrawParagraph(image, Part(image, 110, 160, 780, has_diagram ? 380 : 760), line, kInk, random);
  if (has_diagram) DrawDiagram(image, Part(image, 150, 590, 700, 330), random);
  return image;
}

cv::Mat DrawPoster(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3,
                ToScalar(RandomColor(random, random.Uniform(0.1, 0.6), random.Uniform(0.5, 0.95))));
  cv::rectangle(image, Part(image, 30, 25, 940, 950), ToScalar(RandomColor(random, 0.3, 0.9)),
                cv::FILLED);
  DrawShapes(image, Part(image, 60, 210, 880, 480), 28, random);
  DrawTextLine(image, Part(image, 80, 60, 840, 120), kInk, random);
  DrawParagraph(image, Part(image, 80, 720, 400, 240), std::max(7, size.height / 34), kInk, random);
  DrawDiagram(image, Part(image, 540, 720, 380, 220), random);
  return image;
}

cv::Mat DrawScreen(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image = DrawDesktop(size, seed, random);
  const auto kind = random.Index(4);
  if (kind == 0) {  // One large window.
    DrawWindow(image, Part(image, 60, 40, 880, 850), random);
  } else if (kind == 1) {  // Icons on the left, a window on the right.
    for (int i = 0; i < 10; ++i) {
      const cv::Rect icon = Part(image, 30 + 90 * (i / 5), 60 + 165 * (i % 5), 50, 75);
      cv::rectangle(image, icon, ToScalar(RandomColor(random, 0.5, 0.9)), cv::FILLED);
      DrawTextLine(image, {icon.x, icon.br().y + 3, icon.width * 8 / 5, 12}, {240, 240, 240},
                   random);
    }
    DrawWindow(image, Part(image, 330, 110, 600, 720), random);
  } else {
    DrawWindow(image, Part(image, 40, 50, 500, 760), random);
    DrawWindow(image, Part(image, 480, 160, 480, 700), random);
  }
  cv::rectangle(image, Part(image, 0, 930, 1000, 70), cv::Scalar(60, 50, 45), cv::FILLED);
  for (int i = 0; i < 8; ++i) {
    cv::rectangle(image, Part(image, 20 + 60 * i, 943, 40, 45),
                  ToScalar(RandomColor(random, 0.7, 0.9)), cv::FILLED);
  }
  return image;
}

cv::Mat DrawCover(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar(color));
  const cv::Scalar print = ToScalar(PrintOn(color));
  cv::rectangle(image, Part(image, 60, 40, 880, 920), print, 3);
  DrawTextLine(image, Part(image, 120, 100, 760, 110), print, random);
  DrawTextLine(image, Part(image, 120, 220, 760, 70), print, random);
  DrawShapes(image, Part(image, 150, 350, 700, 420), 9, random);
  DrawTextLine(image, Part(image, 300, 850, 500, 55), print, random);
  return image;
}

cv::Mat DrawSpine(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar(color));
  const cv::Scalar print = ToScalar(PrintOn(color));
  const int band = 20 + static_cast<int>(random.Index(60));
  cv::rectangle(image, Part(image, 40, 0, band, 1000), print, cv::FILLED);
  cv::rectangle(image, Part(image, 940 - band, 0, band, 1000),
                ToScalar(RandomColor(random, 0.6, 0.7)), cv::FILLED);
  DrawTextLine(image, Part(image, 160, 200, 500, 550), print, random);
  DrawTextLine(image, Part(image, 700, 320, 170, 330), print, random);
  return image;
}

cv::Mat DrawCardboard(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  const NoiseStyle style = {
      .color = {0.38F, 0.55F, 0.68F}, .contrast = 0.12F, .period = 24, .num_octaves = 3};
  cv::Mat image = DrawNoise(size, style, seed);
  cv::rectangle(image, Part(image, 0, 430, 1000, 120), ToScalar({0.55F, 0.68F, 0.75F}), cv::FILLED);
  cv::rectangle(image, Part(image, 540, 80, 380, 300), ToScalar({0.94F, 0.95F, 0.95F}), cv::FILLED);
  DrawParagraph(image, Part(image, 565, 110, 330, 150), std::max(7, size.height / 22), kInk,
                random);
  int x = 570;
  while (x < 890) {  // Bar code.
    const int width = 4 + static_cast<int>(random.Index(10));
    cv::rectangle(image, Part(image, x, 280, width, 80), kInk, cv::FILLED);
    x += width + 5 + static_cast<int>(random.Index(9));
  }
  DrawTextLine(image, Part(image, 60, 620, 700, 170), ToScalar({0.15F, 0.25F, 0.35F}), random);
  cv::arrowedLine(image, {size.width / 6, size.height / 3}, {size.width / 6, size.height / 10},
                  kInk, 4, cv::LINE_AA, 0, 0.3);
  return image;
}

cv::Mat DrawMotif(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC3, ToScalar(color));
  cv::rectangle(image, Part(image, 0, 150, 1000, 40), ToScalar(RandomColor(random, 0.8, 0.6)),
                cv::FILLED);
  cv::rectangle(image, Part(image, 0, 800, 1000, 40), ToScalar(RandomColor(random, 0.8, 0.6)),
                cv::FILLED);
  DrawShapes(image, Part(image, 30, 240, 940, 520), 14, random);
  DrawTextLine(image, Part(image, 100, 420, 500, 180), kInk, random);
  return image;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace semslam {
namespace {

int IndexBelow(Random& random, int count) {
  return static_cast<int>(random.Index(static_cast<std::uint32_t>(std::max(1, count))));
}

void DrawBars(cv::Mat& image, const cv::Rect& area, Random& random) {
  const int num_bars = 4 + IndexBelow(random, 5);
  for (int i = 0; i < num_bars; ++i) {
    const int height = cvRound(area.height * random.Uniform(0.15, 0.9));
    const int x = area.x + area.width * (2 * i + 1) / (2 * num_bars + 1);
    const cv::Rect bar(x, area.br().y - height, std::max(1, area.width / (2 * num_bars + 1)),
                       height);
    cv::rectangle(image, bar, ToScalar(RandomColor(random, 0.7, 0.7)), cv::FILLED);
  }
}

void DrawCurve(cv::Mat& image, const cv::Rect& area, Random& random) {
  std::vector<cv::Point> curve;
  double level = random.Uniform(0.2, 0.8);
  for (int i = 0; i <= 16; ++i) {
    level = std::clamp(level + random.Uniform(-0.18, 0.18), 0.05, 0.95);
    curve.emplace_back(area.x + area.width * i / 16, area.y + cvRound(area.height * level));
  }
  cv::polylines(image, curve, false, ToScalar(RandomColor(random, 0.8, 0.6)), 2, cv::LINE_AA);
}

}  // namespace

cv::Scalar ToScalar(const Eigen::Vector3f& color) {
  return {255.0 * color[0], 255.0 * color[1], 255.0 * color[2]};
}

Eigen::Vector3f RandomColor(Random& random, double saturation, double brightness) {
  const double hue = random.Uniform(0, 6);
  Eigen::Vector3f color;
  for (int k = 0; k < 3; ++k) {
    const double wrapped = std::fmod(hue + 2.0 * k, 6.0);
    const double pure = std::clamp(std::abs(wrapped - 3.0) - 1.0, 0.0, 1.0);
    color[k] = static_cast<float>(brightness * (1.0 - saturation + saturation * pure));
  }
  return color;
}

std::string RandomWord(Random& random, bool capital) {
  constexpr std::string_view kConsonants = "bcdfghklmnprstvwz";
  constexpr std::string_view kVowels = "aeiou";
  std::string word;
  const int num_letters = 2 + IndexBelow(random, 7);
  for (int i = 0; i < num_letters; ++i) {
    const std::string_view letters = i % 2 == 0 ? kConsonants : kVowels;
    word += letters[random.Index(static_cast<std::uint32_t>(letters.size()))];
  }
  if (capital) word[0] = static_cast<char>(word[0] - 'a' + 'A');
  return word;
}

void DrawTextLine(cv::Mat& image, const cv::Rect& area, const cv::Scalar& color, Random& random) {
  const double scale = area.height / 30.0;
  const int thickness = std::max(1, cvRound(scale * 1.5));
  std::string line;
  while (true) {
    const std::string longer = line + (line.empty() ? "" : " ") + RandomWord(random, line.empty());
    if (cv::getTextSize(longer, cv::FONT_HERSHEY_SIMPLEX, scale, thickness, nullptr).width >
        area.width)
      break;
    line = longer;
  }
  const cv::Point base(area.x, area.y + cvRound(0.8 * area.height));
  cv::putText(image, line, base, cv::FONT_HERSHEY_SIMPLEX, scale, color, thickness, cv::LINE_AA);
}

void DrawParagraph(cv::Mat& image,
                   const cv::Rect& area,
                   int line_height,
                   const cv::Scalar& color,
                   Random& random) {
  const int letter_height = std::max(4, line_height * 7 / 10);
  for (int y = area.y; y + line_height <= area.br().y; y += line_height) {
    const int width =
        random.Uniform() < 0.2 ? cvRound(area.width * random.Uniform(0.3, 0.8)) : area.width;
    DrawTextLine(image, {area.x, y, width, letter_height}, color, random);
  }
}

void DrawDiagram(cv::Mat& image, const cv::Rect& area, Random& random) {
  cv::rectangle(image, area, ToScalar({0.95F, 0.96F, 0.96F}), cv::FILLED);
  if (random.Uniform() < 0.5) {
    DrawBars(image, area, random);
  } else {
    DrawCurve(image, area, random);
    DrawCurve(image, area, random);
  }
  cv::rectangle(image, area, cv::Scalar(60, 60, 60), 2);
}

void DrawShapes(cv::Mat& image, const cv::Rect& area, int num_shapes, Random& random) {
  const int largest = std::max(4, std::min(area.width, area.height) / 3);
  cv::Mat part = image(area);
  for (int i = 0; i < num_shapes; ++i) {
    const cv::Point center(IndexBelow(random, area.width), IndexBelow(random, area.height));
    const int size = largest / 4 + IndexBelow(random, largest * 3 / 4);
    const cv::Scalar color =
        ToScalar(RandomColor(random, random.Uniform(0.2, 0.9), random.Uniform(0.3, 1.0)));
    const int kind = IndexBelow(random, 3);
    if (kind == 0) {
      cv::circle(part, center, size / 2, color, cv::FILLED, cv::LINE_AA);
    } else if (kind == 1) {
      const int height = size / 3 + IndexBelow(random, size);
      cv::rectangle(part, {center.x - size / 2, center.y - height / 2, size, height}, color,
                    cv::FILLED);
    } else {
      std::array<cv::Point, 3> corners;
      for (cv::Point& corner : corners) {
        corner = center + cv::Point(IndexBelow(random, 2 * size) - size,
                                    IndexBelow(random, 2 * size) - size);
      }
      cv::fillConvexPoly(part, corners.data(), 3, color, cv::LINE_AA);
    }
  }
}

}  // namespace semslam

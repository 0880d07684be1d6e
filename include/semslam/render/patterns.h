// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace semslam {

// Pictures for textures, drawn from a seed: the same bytes for the same arguments. All are CV_8UC3,
// BGR; `size` is in pixels. Those marked * repeat without a seam.

// * Noise of several scales around one colour. `period`: cells of the coarsest scale per picture.
struct NoiseStyle {
  Eigen::Vector3f color{0.5F, 0.5F, 0.5F};  // BGR, 0 to 1.
  float contrast = 0.2F;                    // Largest deviation of the brightness.
  int period = 8;
  int num_octaves = 4;
  float roughness = 0.6F;  // Strength of each octave over the one before.
};
cv::Mat DrawNoise(cv::Size size, const NoiseStyle& style, std::uint64_t seed);

// * Wood with the grain along the width.
cv::Mat DrawWood(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed);
// * Looped carpet of flecks of several colours.
cv::Mat DrawCarpet(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed);
// * Short fur: strokes of many directions.
cv::Mat DrawFur(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed);

// * Bricks in courses (1 m by 1 m: 4 by 12 of them), with joints. `contrast`: between bricks.
cv::Mat DrawBricks(cv::Size size,
                   const Eigen::Vector3f& color,
                   const Eigen::Vector3f& joint,
                   float contrast,
                   std::uint64_t seed);
// * 4 by 4 square tiles of stone.
cv::Mat DrawTiles(cv::Size size,
                  const Eigen::Vector3f& color,
                  const Eigen::Vector3f& joint,
                  float contrast,
                  std::uint64_t seed);
// * Woven cloth with some threads of a second colour.
cv::Mat DrawFabric(cv::Size size,
                   const Eigen::Vector3f& color,
                   const Eigen::Vector3f& second,
                   float contrast,
                   std::uint64_t seed);
// A woven rug with borders.
cv::Mat DrawRug(cv::Size size,
                const Eigen::Vector3f& color,
                const Eigen::Vector3f& second,
                std::uint64_t seed);

// What is before a window: sky, trees, houses.
cv::Mat DrawOutdoors(cv::Size size, std::uint64_t seed);
// A whiteboard somebody has written on.
cv::Mat DrawWhiteboard(cv::Size size, std::uint64_t seed);
// A clock's face, as large as the picture.
cv::Mat DrawClock(cv::Size size, std::uint64_t seed);
// A label with a brand and small print; repeats along the width.
cv::Mat DrawLabel(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed);

// A sheet of paper with a heading, lines of text, and now and then a diagram.
cv::Mat DrawPage(cv::Size size, std::uint64_t seed);
// A poster: coloured ground, title, shapes, text.
cv::Mat DrawPoster(cv::Size size, std::uint64_t seed);
// A monitor's content: windows with title bars, lines of code, a picture, a task bar.
cv::Mat DrawScreen(cv::Size size, std::uint64_t seed);
// A book's cover (upright).
cv::Mat DrawCover(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed);
// A book's spine (lying, text along the width).
cv::Mat DrawSpine(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed);
// A cardboard box's side with tape, label and marks.
cv::Mat DrawCardboard(cv::Size size, std::uint64_t seed);
// A band of simple shapes on a plain ground, for mugs; repeats along the width.
cv::Mat DrawMotif(cv::Size size, const Eigen::Vector3f& color, std::uint64_t seed);

}  // namespace semslam

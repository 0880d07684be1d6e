// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/base/random.h"

namespace semslam {

// BGR in 0 to 1 (may be outside) to OpenCV's 0 to 255.
cv::Scalar ToScalar(const Eigen::Vector3f& color);

// A random colour with the given saturation and brightness, 0 to 1.
Eigen::Vector3f RandomColor(Random& random, double saturation, double brightness);

// A made-up word, with a capital if asked for.
std::string RandomWord(Random& random, bool capital);

// One line of words that fits the width of `area`; letters as tall as the area.
void DrawTextLine(cv::Mat& image, const cv::Rect& area, const cv::Scalar& color, Random& random);

// Lines of text, ragged on the right, that fill `area`.
void DrawParagraph(
    cv::Mat& image, const cv::Rect& area, int line_height, const cv::Scalar& color, Random& random);

// A diagram in a frame: bars, a curve, or boxes with arrows.
void DrawDiagram(cv::Mat& image, const cv::Rect& area, Random& random);

// Coloured discs, bars and triangles spread over `area`.
void DrawShapes(cv::Mat& image, const cv::Rect& area, int num_shapes, Random& random);

}  // namespace semslam

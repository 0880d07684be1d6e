// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core/mat.hpp>

namespace semslam {

// How the values of an image go together, for fast and good compression.
enum class PngContent { kPhoto, kFlat };

// The bytes of a PNG file; `image` is CV_8UC1, CV_8UC3 or CV_16UC1, and not empty.
std::string EncodePng(const cv::Mat& image, PngContent content);

// Writes them as a file, whole or not at all. Throws InputError.
void WritePng(const std::filesystem::path& path, const cv::Mat& image, PngContent content);

}  // namespace semslam

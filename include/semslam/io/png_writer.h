// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include <opencv2/core/mat.hpp>

namespace semslam {

// How the values of an image go together, for fast and good compression.
enum class PngContent { kPhoto, kFlat };

// Writes a PNG file, whole or not at all. Throws InputError.
void WritePng(const std::filesystem::path& path, const cv::Mat& image, PngContent content);

}  // namespace semslam

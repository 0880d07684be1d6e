// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include <opencv2/core/types.hpp>

namespace semslam {

// Width and height of the images that the network of an ONNX file takes, if the file fixes them;
// OpenCV knows but does not tell. Nothing too for what is no ONNX file.
std::optional<cv::Size> ReadOnnxInputSize(const std::filesystem::path& path);

}  // namespace semslam

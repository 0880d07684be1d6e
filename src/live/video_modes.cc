// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/video_modes.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include <OpenNI.h>

namespace semslam {
namespace {

std::string FormatName(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return "1 mm";
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return "0.1 mm";
    case openni::PIXEL_FORMAT_SHIFT_9_2:
    case openni::PIXEL_FORMAT_SHIFT_9_3:
      return "shift";
    case openni::PIXEL_FORMAT_RGB888:
      return "RGB888";
    case openni::PIXEL_FORMAT_YUV422:
      return "YUV422";
    case openni::PIXEL_FORMAT_YUYV:
      return "YUYV";
    case openni::PIXEL_FORMAT_GRAY8:
      return "GRAY8";
    case openni::PIXEL_FORMAT_GRAY16:
      return "GRAY16";
    case openni::PIXEL_FORMAT_JPEG:
      return "JPEG";
  }
  return "format " + std::to_string(static_cast<int>(format));
}

// The lower the better; nothing for one that cannot be converted.
std::optional<int> FormatRank(StreamKind kind, std::string_view format) {
  static constexpr std::array<std::string_view, 4> kColor = {"RGB888", "YUV422", "YUYV", "GRAY8"};
  static constexpr std::array<std::string_view, 2> kDepth = {"1 mm", "0.1 mm"};
  const auto rank = [format](const auto& formats) -> std::optional<int> {
    const auto found = std::find(formats.begin(), formats.end(), format);
    if (found == formats.end()) return std::nullopt;
    return static_cast<int>(found - formats.begin());
  };
  return kind == StreamKind::kColor ? rank(kColor) : rank(kDepth);
}

}  // namespace

OpenNi2Mode ToMode(const openni::VideoMode& mode) {
  return {.width = mode.getResolutionX(),
          .height = mode.getResolutionY(),
          .fps = mode.getFps(),
          .format = FormatName(mode.getPixelFormat())};
}

std::vector<OpenNi2Mode> ToModes(const openni::SensorInfo& sensor) {
  std::vector<OpenNi2Mode> modes;
  const openni::Array<openni::VideoMode>& supported = sensor.getSupportedVideoModes();
  for (int i = 0; i < supported.getSize(); ++i) modes.push_back(ToMode(supported[i]));
  return modes;
}

std::string Describe(const OpenNi2Mode& mode) {
  return std::to_string(mode.width) + "x" + std::to_string(mode.height) + ", " +
         std::to_string(mode.fps) + "/s, " + mode.format;
}

std::optional<std::size_t> ChooseMode(
    const std::vector<OpenNi2Mode>& modes, StreamKind kind, int width, int height, int fps) {
  std::optional<std::size_t> best;
  int best_cost = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const std::optional<int> rank = FormatRank(kind, modes[i].format);
    if (!rank || modes[i].width != width || modes[i].height != height) continue;
    constexpr int kRateBeforeFormat = 100;
    const int cost = kRateBeforeFormat * std::abs(modes[i].fps - fps) + *rank;
    if (best && cost >= best_cost) continue;
    best = i;
    best_cost = cost;
  }
  return best;
}

}  // namespace semslam

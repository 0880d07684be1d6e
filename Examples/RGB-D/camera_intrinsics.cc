// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "camera_intrinsics.h"

#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "semslam/base/error.h"

#include "format_line.h"

namespace {

using Values = std::vector<std::pair<std::string, double>>;

// The file's text with other values for some keys: map files keep the text, so it must be true.
std::string Replace(const std::string& text, const Values& values) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    for (const auto& [key, value] : values) {
      if (line.starts_with(key + ":")) line = key + Line(": %.6f", value);
    }
    result += line + "\n";
  }
  return result;
}

}  // namespace

semslam::Settings WithIntrinsics(const semslam::Settings& settings,
                                 const std::filesystem::path& settings_path,
                                 const std::optional<semslam::PinholeCamera::Parameters>& nominal,
                                 bool use_nominal,
                                 ProgressLine& progress) {
  constexpr double kMaxDifference = 0.15;  // Of the focal length; nominal ones are that bad.
  if (!use_nominal) {
    const bool differs = nominal && std::abs(nominal->fx / settings.camera.fx - 1) > kMaxDifference;
    if (differs) {
      progress.Report(
          Line("warning: Camera.fx is %.0f, the camera's field of view makes it %.0f: "
               "are these settings for this camera?",
               settings.camera.fx, nominal->fx));
    }
    return settings;
  }
  if (!nominal) throw semslam::InputError("--device-intrinsics: the camera gives no field of view");
  progress.Report(
      Line("warning: focal lengths %.1f and %.1f by the camera's field of view, without "
           "distortion; a calibration makes the map better",
           nominal->fx, nominal->fy));
  const Values values = {
      {"Camera.fx", nominal->fx}, {"Camera.fy", nominal->fy}, {"Camera.cx", nominal->cx},
      {"Camera.cy", nominal->cy}, {"Camera.k1", 0},           {"Camera.k2", 0},
      {"Camera.p1", 0},           {"Camera.p2", 0},           {"Camera.k3", 0}};
  return semslam::ParseSettings(settings_path, Replace(settings.text, values));
}

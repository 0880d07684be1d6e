// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/trajectory_io.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "semslam/io/atomic_file.h"

#include "io/text_file.h"

namespace semslam {
namespace {

constexpr std::size_t kNumFields = 8;

std::optional<double> ParseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

// Plain decimals exactly; what numpy writes (1.305031102175304000e+09) as well as a double can.
std::optional<TimeNs> ParseAnyTime(std::string_view text) {
  if (const std::optional<TimeNs> exact = ParseTime(text)) return exact;
  const std::optional<double> seconds = ParseNumber(text);
  constexpr double kMaxSeconds = 9.2e9;  // 2^63 ns.
  if (!seconds || std::abs(*seconds) > kMaxSeconds) return std::nullopt;
  return FromSeconds(*seconds);
}

TimedPose ParsePose(const TextFile& file, const TextFile::Line& line) {
  if (line.fields.size() != kNumFields) {
    file.Fail(line, "expected 8 numbers `t tx ty tz qx qy qz qw`, found " +
                        std::to_string(line.fields.size()) + " fields");
  }
  const std::optional<TimeNs> time = ParseAnyTime(line.fields[0]);
  if (!time) file.Fail(line, "expected a time in seconds, found " + Quoted(line.fields[0]));
  std::array<double, kNumFields> values{};
  for (std::size_t i = 1; i < kNumFields; ++i) {
    const std::optional<double> value = ParseNumber(line.fields[i]);
    if (!value) file.Fail(line, "expected a number, found " + Quoted(line.fields[i]));
    values[i] = *value;
  }
  const Eigen::Quaterniond rotation(values[7], values[4], values[5], values[6]);
  constexpr double kMinNorm = 1e-6;
  if (rotation.norm() < kMinNorm) file.Fail(line, "expected a quaternion, found zeros");
  return {*time, {rotation.normalized(), {values[1], values[2], values[3]}}};
}

void AppendNumber(double value, std::string& text) {
  constexpr int kDecimals = 9;
  std::array<char, 400> buffer{};  // The longest double has 309 digits before the point.
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                          std::chars_format::fixed, kDecimals);
  text += ' ';
  text.append(buffer.data(), end);
}

}  // namespace

Trajectory ReadTrajectory(const std::filesystem::path& path) {
  const TextFile file(path);
  Trajectory trajectory;
  for (const TextFile::Line& line : file.lines()) trajectory.push_back(ParsePose(file, line));
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.time < b.time; });
  return trajectory;
}

void WriteTrajectory(const std::filesystem::path& path, const Trajectory& trajectory) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const TimedPose& pose : trajectory) {
    const Eigen::Vector3d& t = pose.T_world_camera.translation;
    Eigen::Quaterniond q = pose.T_world_camera.rotation;
    if (q.w() < 0) q.coeffs() *= -1.0;  // q and -q are the same rotation: write one of them.
    text += FormatTime(pose.time);
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      AppendNumber(value, text);
    }
    text += '\n';
  }
  WriteFileAtomically(path, text);
}

}  // namespace semslam

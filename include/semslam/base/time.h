// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace semslam {

// Integer nanoseconds since the epoch of the recording: exact where a double of seconds since 1970
// is not.
using TimeNs = std::int64_t;

inline constexpr TimeNs kNsPerSecond = 1'000'000'000;

constexpr double ToSeconds(TimeNs duration) { return static_cast<double>(duration) * 1e-9; }
constexpr TimeNs FromSeconds(double seconds) {
  return static_cast<TimeNs>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5));
}

// "1305031102.175304" -> 1305031102175304000, exactly. Nothing unless all of the text is a plain
// decimal number (digits beyond nanoseconds are cut) that fits.
std::optional<TimeNs> ParseTime(std::string_view seconds);

// 1305031102175304000 -> "1305031102.175304". Rounded to the nearest, 0 to 9 decimals.
std::string FormatTime(TimeNs time, int decimals = 6);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/time.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace semslam {
namespace {

bool AllDigits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::optional<TimeNs> ParseTime(std::string_view seconds) {
  const bool negative = seconds.starts_with('-');
  if (negative) seconds.remove_prefix(1);
  const std::size_t point = std::min(seconds.find('.'), seconds.size());
  const std::string_view whole = seconds.substr(0, point);
  const std::string_view fraction = point < seconds.size() ? seconds.substr(point + 1) : "";
  constexpr std::size_t kMaxWholeDigits = 9 + 1;  // 2^63 ns are 9.2e9 s.
  if (whole.empty() || whole.size() > kMaxWholeDigits) return std::nullopt;
  if (!AllDigits(whole) || !AllDigits(fraction)) return std::nullopt;

  std::string digits(whole);
  digits.append(fraction.substr(0, 9));
  digits.append(9 - std::min<std::size_t>(fraction.size(), 9), '0');
  TimeNs value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return negative ? -value : value;
}

std::string FormatTime(TimeNs time, int decimals) {
  decimals = std::clamp(decimals, 0, 9);
  std::uint64_t unit = 1;
  for (int i = decimals; i < 9; ++i) unit *= 10;
  // Unsigned, because the smallest time has no positive counterpart.
  const std::uint64_t magnitude = time < 0 ? 0 - static_cast<std::uint64_t>(time) : time;
  const std::uint64_t rounded = (magnitude + unit / 2) / unit;  // In units of the last decimal.
  std::uint64_t scale = 1;
  for (int i = 0; i < decimals; ++i) scale *= 10;
  std::string text = time < 0 && rounded > 0 ? "-" : "";
  text += std::to_string(rounded / scale);
  if (decimals == 0) return text;
  const std::string fraction = std::to_string(rounded % scale);
  return text + '.' + std::string(decimals - fraction.size(), '0') + fraction;
}

}  // namespace semslam

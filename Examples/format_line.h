// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdarg>
#include <cstdio>
#include <string>

// As printf, at most 255 characters.
[[gnu::format(printf, 1, 2)]] inline std::string Line(const char* format, ...) {
  std::array<char, 256> text{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

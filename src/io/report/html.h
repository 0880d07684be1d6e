// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace semslam {

// Safe as text and in quoted attributes. Bytes that are no UTF-8, and control characters but line
// ends and tabs, become the replacement character.
std::string EscapeHtml(std::string_view text);

std::string Base64(std::string_view bytes);

// The page with each {{name}} replaced by its value; values are not looked at. A name without a
// value is a broken contract.
std::string FillTemplate(std::string_view page,
                         const std::map<std::string, std::string, std::less<>>& values);

// As printf.
[[gnu::format(printf, 1, 2)]] std::string Format(const char* format, ...);

// 1234567 -> "1 234 567", with thin spaces that do not break.
std::string GroupDigits(std::size_t number);

}  // namespace semslam

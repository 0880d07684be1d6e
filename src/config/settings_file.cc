// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/config/settings_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr std::string_view kSpaces = " \t\r";

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

// Without a comment: from a # at the start or after a space to the end, but not inside quotes.
std::string_view WithoutComment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool after_space = i == 0 || kSpaces.find(line[i - 1]) != std::string_view::npos;
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if ((c == '"' || c == '\'') && (after_space || line[i - 1] == ':')) {
      quote = c;
    } else if (c == '#' && after_space) {
      return line.substr(0, i);
    }
  }
  return line;
}

bool IsQuoted(std::string_view value) {
  return value.size() >= 2 && (value.front() == '"' || value.front() == '\'') &&
         value.back() == value.front();
}

bool StartsNested(std::string_view value) {
  return value.empty() || value.starts_with("!!") || value.starts_with('[') ||
         value.starts_with('{');
}

std::string Shown(std::string_view value) {
  constexpr std::size_t kMaxLength = 60;
  std::string text;
  for (const char c : value.substr(0, kMaxLength)) {
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return value.size() > kMaxLength ? text + "..." : text;
}

std::string ToText(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

// "a number > 0", "an integer from 1 to 100".
std::string Expected(const NumberRange& range, bool must_be_integer) {
  std::string kind = must_be_integer ? "an integer" : "a number";
  const bool has_min = std::isfinite(range.min);
  if (has_min && std::isfinite(range.max)) {
    return kind + (range.min_is_allowed ? " from " : " above ") + ToText(range.min) +
           (range.min_is_allowed ? " to " : " and up to ") + ToText(range.max);
  }
  if (has_min) return kind + (range.min_is_allowed ? " >= " : " > ") + ToText(range.min);
  if (std::isfinite(range.max)) return kind + " <= " + ToText(range.max);
  return kind;
}

bool Contains(const NumberRange& range, double value) {
  return value <= range.max && (range.min_is_allowed ? value >= range.min : value > range.min);
}

std::optional<double> ParseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

// The same but for upper case, or for one letter too many or too few. Not for one that is changed:
// Camera.fx and Camera.cx are two keys.
bool LooksLike(std::string_view a, std::string_view b) {
  if (a.size() < b.size()) std::swap(a, b);
  const std::string longer = Lower(a);
  const std::string shorter = Lower(b);
  if (longer.size() == shorter.size()) return longer == shorter;
  if (longer.size() != shorter.size() + 1) return false;
  const auto [differs, unused] = std::mismatch(shorter.begin(), shorter.end(), longer.begin());
  const auto position = differs - shorter.begin();
  return shorter.substr(position) == longer.substr(position + 1);
}

}  // namespace

std::string ReadSettingsText(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw InputError(path.string() + ": expected a settings file, found a folder");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InputError(path.string() +
                     ": cannot read settings: " + std::generic_category().message(errno));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

SettingsFile::SettingsFile(const std::filesystem::path& path)
    : SettingsFile(path.string(), ReadSettingsText(path)) {}

SettingsFile::SettingsFile(std::string name, std::string_view text) : name_(std::move(name)) {
  Parse(text);
}

void SettingsFile::Parse(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // Byte order mark.
  const std::string_view first_line = Trim(text.substr(0, text.find('\n')));
  if (!first_line.starts_with("%YAML:1.") && !first_line.starts_with("%YAML 1.")) {
    Fail("line 1",
         "expected %YAML:1.0, found " + (first_line.empty() ? "nothing" : Shown(first_line)));
  }
  std::string previous_key;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = WithoutComment(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    const std::string_view content = Trim(line);
    if (number == 1 || content.empty() || content == "---" || content == "...") continue;
    if (line.front() == ' ' || line.front() == '\t') {
      const auto previous = entries_.find(previous_key);
      if (previous == entries_.end() || !StartsNested(previous->second.value)) {
        Fail("line " + std::to_string(number), "expected `key: value`, found an indented line");
      }
      previous->second.is_nested = true;
    } else {
      previous_key = ParseEntry(content, number);
    }
  }
  for (const auto& [key, entry] : entries_) {
    if (entry.value.empty() && !entry.is_nested) Fail(key, "expected a value, found nothing");
  }
}

std::string SettingsFile::ParseEntry(std::string_view line, int number) {
  const std::string where = "line " + std::to_string(number);
  const std::size_t colon = line.find(':');
  std::string key(Trim(line.substr(0, colon)));
  if (colon == std::string_view::npos || key.empty() ||
      key.find_first_of(" \t\"'{}[],") != std::string::npos) {
    Fail(where, "expected `key: value`, found " + Shown(line));
  }
  const std::string value(Trim(line.substr(colon + 1)));
  const auto [entry, is_new] = entries_.try_emplace(key);
  if (!is_new) {
    Fail(key, "given twice, in lines " + std::to_string(entry->second.line) + " and " +
                  std::to_string(number));
  }
  entry->second = {
      .line = number, .value = value, .is_nested = !value.empty() && StartsNested(value)};
  return key;
}

void SettingsFile::Fail(const std::string& where, const std::string& message) const {
  throw InputError(name_ + ": " + where + ": " + message);
}

const SettingsFile::Entry* SettingsFile::Find(const std::string& key) {
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  found->second.is_used = true;
  return &found->second;
}

double SettingsFile::ToNumber(const std::string& key,
                              const Entry& entry,
                              const NumberRange& range,
                              bool must_be_integer) const {
  const std::optional<double> value = ParseNumber(entry.value);
  const bool is_valid = value && std::isfinite(*value) && Contains(range, *value) &&
                        (!must_be_integer || *value == std::floor(*value));
  if (!is_valid) {
    Fail(key, "expected " + Expected(range, must_be_integer) + ", found " +
                  (entry.is_nested ? "a list or a matrix" : Shown(entry.value)));
  }
  return *value;
}

void SettingsFile::Read(const std::string& key, double* value, const NumberRange& range) {
  if (const Entry* entry = Find(key)) *value = ToNumber(key, *entry, range, false);
}

void SettingsFile::Read(const std::string& key,
                        std::optional<double>* value,
                        const NumberRange& range) {
  if (const Entry* entry = Find(key)) *value = ToNumber(key, *entry, range, false);
}

void SettingsFile::Read(const std::string& key, int* value, const NumberRange& range) {
  const Entry* entry = Find(key);
  if (entry == nullptr) return;
  NumberRange int_range = range;
  int_range.min = std::max(range.min, static_cast<double>(std::numeric_limits<int>::min()));
  int_range.max = std::min(range.max, static_cast<double>(std::numeric_limits<int>::max()));
  const double number = ToNumber(key, *entry, range, true);
  if (!Contains(int_range, number)) ToNumber(key, *entry, int_range, true);
  *value = static_cast<int>(number);
}

void SettingsFile::Read(const std::string& key, bool* value) {
  const Entry* entry = Find(key);
  if (entry == nullptr) return;
  const std::string text = Lower(entry->value);
  const std::optional<double> number = ParseNumber(text);
  if (text == "true" || number == 1.0) {
    *value = true;
  } else if (text == "false" || number == 0.0) {
    *value = false;
  } else {
    Fail(key, "expected 0, 1, true or false, found " + Shown(entry->value));
  }
}

void SettingsFile::Read(const std::string& key, std::string* value) {
  const Entry* entry = Find(key);
  if (entry == nullptr) return;
  if (entry->is_nested) Fail(key, "expected a text, found a list or a matrix");
  const std::string& text = entry->value;
  *value = IsQuoted(text) ? text.substr(1, text.size() - 2) : text;
}

void SettingsFile::CheckPresent(const std::string& key) const {
  if (Has(key)) return;
  std::string message = "missing";
  for (const auto& [other, entry] : entries_) {
    if (entry.is_used || !LooksLike(key, other)) continue;
    message += "; is it meant by " + other + " in line " + std::to_string(entry.line) + "?";
    break;
  }
  Fail(key, message);
}

void SettingsFile::Require(const std::string& key, double* value, const NumberRange& range) {
  CheckPresent(key);
  Read(key, value, range);
}

void SettingsFile::Require(const std::string& key, int* value, const NumberRange& range) {
  CheckPresent(key);
  Read(key, value, range);
}

void SettingsFile::Require(const std::string& key, bool* value) {
  CheckPresent(key);
  Read(key, value);
}

void SettingsFile::Require(const std::string& key, std::string* value) {
  CheckPresent(key);
  Read(key, value);
}

std::vector<std::string> SettingsFile::UnknownKeys() const {
  std::vector<std::pair<int, std::string>> keys;
  for (const auto& [key, entry] : entries_) {
    const bool is_stock = key.starts_with("Viewer.");
    if (!entry.is_used && !is_stock) keys.emplace_back(entry.line, key);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::string> texts;
  for (const auto& [line, key] : keys) {
    texts.push_back(name_ + ": line " + std::to_string(line) + ": " + key + ": unknown key");
  }
  return texts;
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/darknet_config.h"

#include <charconv>
#include <fstream>
#include <sstream>

#include "semslam/base/error.h"

namespace semslam {
namespace {

std::string WithoutSpaces(const std::string& line) {
  std::string compact;
  for (const char c : line) {
    if (c != ' ' && c != '\t' && c != '\r') compact += c;
  }
  return compact;
}

bool ParseInteger(std::string_view text, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

DarknetConfig DarknetConfig::FromFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot open the network's cfg");
  std::ostringstream text;
  text << file.rdbuf();
  return FromText(text.str(), path.string());
}

DarknetConfig DarknetConfig::FromText(std::string_view text, const std::string& name) {
  DarknetConfig config;
  config.name_ = name;
  std::istringstream lines{std::string(text)};
  std::string raw_line;
  for (int number = 1; std::getline(lines, raw_line); ++number) {
    const std::string line = WithoutSpaces(raw_line.substr(0, raw_line.find('#')));
    if (line.empty() || line[0] == ';') continue;
    const std::string where = name + ":" + std::to_string(number) + ": ";
    if (line[0] == '[') {
      if (line.back() != ']') throw InputError(where + "expected a closing ']'");
      config.sections_.push_back({line.substr(1, line.size() - 2), number, {}});
      continue;
    }
    const auto equals = line.find('=');
    if (equals == std::string::npos || equals == 0 || config.sections_.empty()) {
      throw InputError(where + "expected key=value in a section, found '" + line.substr(0, 60) +
                       "'");
    }
    config.sections_.back().values[line.substr(0, equals)] = line.substr(equals + 1);
  }
  if (config.sections_.empty() ||
      (config.sections_.front().type != "net" && config.sections_.front().type != "network")) {
    throw InputError(name + ": expected a Darknet cfg that begins with [net]");
  }
  return config;
}

void DarknetConfig::SetInputSize(int width, int height) {
  sections_.front().values["width"] = std::to_string(width);
  sections_.front().values["height"] = std::to_string(height);
}

void DarknetConfig::SetInAll(const std::string& type,
                             const std::string& key,
                             const std::string& value) {
  for (Section& section : sections_) {
    if (section.type == type) section.values[key] = value;
  }
}

std::string DarknetConfig::ToText() const {
  std::string text;
  for (const Section& section : sections_) {
    text += "[" + section.type + "]\n";
    for (const auto& [key, value] : section.values) {
      text.append(key).append("=").append(value).append("\n");
    }
    text += "\n";
  }
  return text;
}

int DarknetConfig::Integer(const Section& section, const std::string& key, int fallback) const {
  const auto it = section.values.find(key);
  if (it == section.values.end()) return fallback;
  int value = 0;
  if (!ParseInteger(it->second, value)) {
    throw InputError(Where(section) + key + ": expected a whole number, found '" + it->second +
                     "'");
  }
  return value;
}

std::vector<int> DarknetConfig::Integers(const Section& section, const std::string& key) const {
  std::vector<int> values;
  const auto it = section.values.find(key);
  if (it == section.values.end()) return values;
  std::istringstream items(it->second);
  std::string item;
  while (std::getline(items, item, ',')) {
    if (item.empty()) continue;
    int value = 0;
    if (!ParseInteger(item, value)) {
      throw InputError(Where(section) + key + ": expected whole numbers, found '" + it->second +
                       "'");
    }
    values.push_back(value);
  }
  return values;
}

std::string DarknetConfig::Where(const Section& section) const {
  return name_ + ":" + std::to_string(section.line) + ": [" + section.type + "]: ";
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/class_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

namespace semslam {
namespace {

// Names in the form that Normalise gives.
using SynonymGroup = std::array<std::string_view, 4>;
constexpr std::array<SynonymGroup, 6> kSynonyms = {{
    {"tvmonitor", "monitor", "tv", "screen"},
    {"teddybear", "teddy", "plushbear", "toybear"},
    {"mouse", "computermouse", "", ""},
    {"cup", "mug", "", ""},
    {"cellphone", "mobilephone", "phone", "smartphone"},
    {"diningtable", "table", "desk", ""},
}};

struct KnownClass {
  std::string_view name;
  double max_extent;  // Metres.
};
constexpr double kDefaultMaxExtent = 2.5;
constexpr std::array<KnownClass, 22> kKnownClasses = {{
    {"cup", 0.25},       {"keyboard", 0.65}, {"tvmonitor", 1.6},  {"mouse", 0.2},
    {"teddybear", 0.9},  {"laptop", 0.7},    {"book", 0.5},       {"cellphone", 0.25},
    {"remote", 0.3},     {"bottle", 0.45},   {"wineglass", 0.35}, {"bowl", 0.45},
    {"fork", 0.3},       {"knife", 0.4},     {"spoon", 0.3},      {"scissors", 0.35},
    {"toothbrush", 0.3}, {"apple", 0.2},     {"orange", 0.2},     {"banana", 0.35},
    {"sportsball", 0.4}, {"clock", 0.6},
}};
// A television is as large as a small table; its extent still tells it from a wall.
constexpr std::array<std::string_view, 7> kLargePlanes = {"diningtable", "table", "desk",     "bed",
                                                          "sofa",        "bench", "tvmonitor"};

struct NamedColor {
  std::string_view name;
  Rgb color;
};
constexpr std::array<NamedColor, 5> kPaperColors = {{{"cup", {228, 26, 28}},
                                                     {"keyboard", {0, 160, 70}},
                                                     {"tvmonitor", {30, 90, 220}},
                                                     {"mouse", {255, 165, 0}},
                                                     {"teddybear", {170, 60, 190}}}};

std::string Normalise(std::string_view name) {
  std::string normal;
  for (const char c : name) {
    if (c == ' ' || c == '_' || c == '-' || c == '\t') continue;
    normal += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return normal;
}

// The first name of the group of synonyms, or the name itself.
std::string Canonical(std::string_view name) {
  std::string normal = Normalise(name);
  if (normal.empty()) return normal;
  for (const SynonymGroup& group : kSynonyms) {
    if (std::find(group.begin(), group.end(), normal) != group.end()) return std::string(group[0]);
  }
  return normal;
}

// Hue in turns.
Rgb FromHue(double hue, double saturation, double value) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue * 6, 6.0);
    const double level = value - value * saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(level * 255));
  };
  return {channel(5), channel(3), channel(1)};
}

Rgb ColorOf(const std::string& canonical_name, std::size_t class_id) {
  for (const NamedColor& paper : kPaperColors) {
    if (paper.name == canonical_name) return paper.color;
  }
  // Steps of the golden ratio keep neighbouring ids far apart on the circle of hues.
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double hue = std::fmod(0.08 + static_cast<double>(class_id) * kGoldenRatio, 1.0);
  constexpr std::array<double, 3> kSaturations = {0.85, 0.55, 0.7};
  constexpr std::array<double, 3> kValues = {0.8, 0.95, 0.55};
  return FromHue(hue, kSaturations[class_id % 3], kValues[class_id / 3 % 3]);
}

double MaxExtentOf(const std::string& canonical_name) {
  for (const KnownClass& known : kKnownClasses) {
    if (known.name == canonical_name) return known.max_extent;
  }
  return kDefaultMaxExtent;
}

std::string Trim(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

ClassTable::ClassTable(const std::vector<std::string>& names) {
  if (names.empty()) throw InputError("class names: expected at least one, found none");
  for (const std::string& name : names) {
    const std::string canonical = Canonical(name);
    if (canonical.empty()) {
      throw InputError("class names: number " + std::to_string(entries_.size() + 1) + " is empty");
    }
    for (const Entry& other : entries_) {
      if (Normalise(other.name) == Normalise(name)) {
        throw InputError("class names: '" + name + "' is there twice");
      }
    }
    const bool is_large_plane =
        std::find(kLargePlanes.begin(), kLargePlanes.end(), canonical) != kLargePlanes.end();
    entries_.push_back(
        {name, ColorOf(canonical, entries_.size()), true, MaxExtentOf(canonical), is_large_plane});
  }
}

ClassTable ClassTable::FromFile(const std::filesystem::path& names_file) {
  std::ifstream file(names_file);
  if (!file) throw InputError(names_file.string() + ": cannot open the class names");
  std::vector<std::string> names;
  std::string line;
  while (std::getline(file, line)) names.push_back(Trim(line));
  while (!names.empty() && names.back().empty()) names.pop_back();
  try {
    return ClassTable(names);
  } catch (const InputError& error) {
    throw InputError(names_file.string() + ": " + error.what());
  }
}

std::optional<int> ClassTable::Find(std::string_view name) const {
  const auto position = [this](const auto& matches) -> std::optional<int> {
    const auto it = std::find_if(entries_.begin(), entries_.end(), matches);
    if (it == entries_.end()) return std::nullopt;
    return static_cast<int>(it - entries_.begin());
  };
  const std::string normal = Normalise(name);
  const auto exact = position([&](const Entry& entry) { return Normalise(entry.name) == normal; });
  if (exact) return exact;
  const std::string canonical = Canonical(name);
  return position([&](const Entry& entry) { return Canonical(entry.name) == canonical; });
}

ClassTable ClassTable::WithInterest(const std::vector<std::string>& names) const {
  ClassTable table = *this;
  for (Entry& entry : table.entries_) entry.is_of_interest = names.empty();
  for (const std::string& name : names) {
    const std::optional<int> class_id = Find(name);
    if (!class_id) {
      throw InputError("classes of interest: '" + name + "' is none of the network's " +
                       std::to_string(size()) + " classes");
    }
    table.entries_[static_cast<std::size_t>(*class_id)].is_of_interest = true;
  }
  return table;
}

const ClassTable::Entry& ClassTable::At(int class_id) const {
  SEMSLAM_CHECK(class_id >= 0 && static_cast<std::size_t>(class_id) < entries_.size())
      << "class " << class_id << " of " << entries_.size();
  return entries_[static_cast<std::size_t>(class_id)];
}

}  // namespace semslam

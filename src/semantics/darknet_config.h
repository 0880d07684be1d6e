// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace semslam {

// A Darknet .cfg file: sections of key = value lines, the first being [net].
class DarknetConfig {
 public:
  struct Section {
    std::string type;
    int line = 0;
    std::map<std::string, std::string> values;
  };

  // Throw InputError with file and line.
  static DarknetConfig FromFile(const std::filesystem::path& path);
  static DarknetConfig FromText(std::string_view text, const std::string& name);

  // With another input size and with extra values for every section of a type.
  void SetInputSize(int width, int height);
  void SetInAll(const std::string& type, const std::string& key, const std::string& value);
  std::string ToText() const;

  const std::string& name() const { return name_; }
  const std::vector<Section>& sections() const { return sections_; }
  int input_width() const { return Integer(sections_.front(), "width", 0); }
  int input_height() const { return Integer(sections_.front(), "height", 0); }

  // A whole number; `fallback` if the key is missing. Throws InputError for anything else.
  int Integer(const Section& section, const std::string& key, int fallback) const;
  // Comma-separated whole numbers; empty if the key is missing.
  std::vector<int> Integers(const Section& section, const std::string& key) const;
  // "file:line: [section]: ", for messages.
  std::string Where(const Section& section) const;

 private:
  std::string name_;
  std::vector<Section> sections_;
};

// What a cfg asks for: the number of weights, and the shape of each [yolo] head's output.
struct DarknetShape {
  struct Head {
    int rows = 0;     // Anchors times cells.
    int columns = 0;  // 5 + classes.
  };
  std::uint64_t num_weights = 0;  // Floats in the weights file after its header.
  std::vector<Head> heads;
};

// Follows sizes and channels through the layers. Throws InputError for layers it does not know,
// references to layers that do not exist, and heads that do not fit `num_classes`.
DarknetShape AnalyseDarknet(const DarknetConfig& config, std::size_t num_classes);

// Throws InputError unless the file holds exactly this many weights after a header of 20 bytes (16
// in files before version 0.2).
void CheckDarknetWeights(const std::filesystem::path& weights,
                         const DarknetConfig& config,
                         std::uint64_t num_weights);

}  // namespace semslam

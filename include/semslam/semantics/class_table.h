// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "semslam/dense/rgb.h"

namespace semslam {

inline constexpr int kNoClass = -1;  // Background, or not known.

// The classes of a network in the order of its outputs: name, colour, and whether the user wants
// them in the map. Class ids are positions in this table.
class ClassTable {
 public:
  ClassTable() = default;
  // All classes are of interest at first. Throws InputError for no names, empty or equal ones.
  explicit ClassTable(const std::vector<std::string>& names);

  // One name a line, in the order of the network's outputs; blank lines at the end are ignored.
  static ClassTable FromFile(const std::filesystem::path& names_file);

  std::size_t size() const { return entries_.size(); }
  const std::string& name(int class_id) const { return At(class_id).name; }
  // The classes of the paper have colours of their own; all others get distinct ones by their id.
  Rgb color(int class_id) const { return At(class_id).color; }
  bool is_of_interest(int class_id) const { return At(class_id).is_of_interest; }
  // Longest edge that an instance may have, metres. Larger segments do not take the class.
  double max_extent(int class_id) const { return At(class_id).max_extent; }
  // A table or a bed may be one large plane; a cup may not.
  bool may_be_structural(int class_id) const { return At(class_id).may_be_structural; }

  // By name. Case, spaces, '-' and '_' do not matter, and common synonyms are understood ("tv
  // monitor", "monitor", "tv" all find "tvmonitor").
  std::optional<int> Find(std::string_view name) const;

  // The same table with only these classes of interest; all of them if `names` is empty. Throws
  // InputError for a name that is not found.
  ClassTable WithInterest(const std::vector<std::string>& names) const;

 private:
  struct Entry {
    std::string name;
    Rgb color;
    bool is_of_interest = true;
    double max_extent = 0;
    bool may_be_structural = false;
  };
  const Entry& At(int class_id) const;

  std::vector<Entry> entries_;
};

// What is shown where no class is known.
inline constexpr Rgb kNoClassColor{150, 150, 150};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "semslam/io/instances_io.h"
#include "semslam/io/objects_io.h"

namespace semslam {

// The classes that are evaluated, with the numbers that the measures use: from 1, 0 for all others.
class ClassNumbers {
 public:
  // `wanted`: names; empty for those that truth and result share. Throws InputError for a name that
  // neither knows.
  ClassNumbers(const std::vector<InstanceRecord>& instances,
               const std::vector<ClassRecord>& classes,
               const std::vector<std::string>& wanted);

  // Class number c at c - 1, as the truth names it, or else the result.
  const std::vector<std::string>& names() const { return names_; }
  std::uint32_t OfInstance(std::uint32_t instance) const { return Find(of_instance_, instance); }
  std::uint32_t OfLabel(std::uint32_t label) const { return Find(of_label_, label); }

 private:
  using Numbers = std::map<std::uint32_t, std::uint32_t>;
  static std::uint32_t Find(const Numbers& numbers, std::uint32_t key);

  std::vector<std::string> names_;
  Numbers of_instance_;
  Numbers of_label_;
};

}  // namespace semslam

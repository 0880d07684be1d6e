// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/class_numbers.h"

#include <algorithm>
#include <set>

#include "semslam/base/error.h"
#include "semslam/semantics/class_table.h"

namespace semslam {
namespace {

// True if one of the names is the same class as `name`.
bool IsOneOf(const std::string& name, const std::vector<std::string>& names) {
  return !names.empty() && ClassTable(names).Find(name).has_value();
}

std::vector<std::string> TrueNames(const std::vector<InstanceRecord>& instances) {
  std::set<std::string> names;
  for (const InstanceRecord& instance : instances) {
    if (!instance.class_name.empty()) names.insert(instance.class_name);
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> FoundNames(const std::vector<ClassRecord>& classes) {
  std::vector<std::string> names;
  for (const ClassRecord& entry : classes) names.push_back(entry.name);
  return names;
}

}  // namespace

ClassNumbers::ClassNumbers(const std::vector<InstanceRecord>& instances,
                           const std::vector<ClassRecord>& classes,
                           const std::vector<std::string>& wanted) {
  const std::vector<std::string> true_names = TrueNames(instances);
  const std::vector<std::string> found_names = FoundNames(classes);
  for (const std::string& name : wanted.empty() ? true_names : wanted) {
    const bool is_found = IsOneOf(name, found_names);
    if (IsOneOf(name, names_) || (wanted.empty() && !is_found)) continue;
    if (!is_found && !IsOneOf(name, true_names)) {
      throw InputError("class " + name +
                       ": neither the clip's instances nor the result's class "
                       "table have it");
    }
    names_.push_back(name);
  }
  if (names_.empty()) return;
  const ClassTable table(names_);
  for (const InstanceRecord& instance : instances) {
    const auto found = table.Find(instance.class_name);
    if (found) of_instance_[instance.id] = static_cast<std::uint32_t>(*found) + 1;
  }
  for (const ClassRecord& entry : classes) {
    const auto found = table.Find(entry.name);
    if (found) of_label_[entry.label] = static_cast<std::uint32_t>(*found) + 1;
  }
}

std::uint32_t ClassNumbers::Find(const Numbers& numbers, std::uint32_t key) {
  const auto found = numbers.find(key);
  return found == numbers.end() ? 0 : found->second;
}

}  // namespace semslam

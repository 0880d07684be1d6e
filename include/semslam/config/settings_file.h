// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace semslam {

// What a number may be.
struct NumberRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_is_allowed = true;

  static NumberRange Any() { return {}; }
  static NumberRange Positive() { return Above(0); }
  static NumberRange Above(double min) { return {.min = min, .min_is_allowed = false}; }
  static NumberRange AtLeast(double min) { return {.min = min}; }
  static NumberRange Between(double min, double max) { return {.min = min, .max = max}; }
};

// Throws InputError if the file cannot be read.
std::string ReadSettingsText(const std::filesystem::path& path);

// Strict reader of a flat settings file as OpenCV writes them and ORB-SLAM2's users have them: a
// first line %YAML:1.0, then lines `Key.name: value`, and comments after #. Every error is an
// InputError of one line with file, key, what was found and what is allowed:
//   config/TUM1.yaml: Camera.fx: expected a number > 0, found -517.3
// It remembers which keys were asked for, so that misspelt ones can be told. Not for several
// threads at once.
class SettingsFile {
 public:
  // Throws InputError if the file cannot be read or is not of this form: other first line, a line
  // without colon, a key without value, a key given twice.
  explicit SettingsFile(const std::filesystem::path& path);
  // The same from a text; `name` stands in the messages.
  SettingsFile(std::string name, std::string_view text);

  // Sets *value if the key is there, and leaves it as it is if not. Throws InputError if the value
  // is of another type, not finite or out of range. An int may be written 8 or 8.0; a bool 0, 1,
  // true or false; a text with or without quotes.
  void Read(const std::string& key, double* value, const NumberRange& range = {});
  void Read(const std::string& key, std::optional<double>* value, const NumberRange& range = {});
  void Read(const std::string& key, int* value, const NumberRange& range = {});
  void Read(const std::string& key, bool* value);
  void Read(const std::string& key, std::string* value);

  // The same for a key that must be there: throws InputError if it is missing, and names a key of
  // the file that looks like it.
  void Require(const std::string& key, double* value, const NumberRange& range = {});
  void Require(const std::string& key, int* value, const NumberRange& range = {});
  void Require(const std::string& key, bool* value);
  void Require(const std::string& key, std::string* value);

  bool Has(const std::string& key) const { return entries_.contains(key); }

  // Keys that nobody has asked for so far, in the order of the file; each with its line:
  // "TUM1.yaml: line 12: Camera.fz: unknown key". Those of the published system that mean nothing
  // here (Viewer.*) are left out.
  std::vector<std::string> UnknownKeys() const;

  const std::string& name() const { return name_; }

 private:
  struct Entry {
    int line = 0;
    std::string value;       // As written, without comment.
    bool is_nested = false;  // A matrix or map of several lines: never read here.
    bool is_used = false;
  };

  void Parse(std::string_view text);
  // Returns the key.
  std::string ParseEntry(std::string_view line, int number);
  const Entry* Find(const std::string& key);
  double ToNumber(const std::string& key,
                  const Entry& entry,
                  const NumberRange& range,
                  bool must_be_integer) const;
  void CheckPresent(const std::string& key) const;
  [[noreturn]] void Fail(const std::string& where, const std::string& message) const;

  std::string name_;
  std::map<std::string, Entry> entries_;
};

}  // namespace semslam

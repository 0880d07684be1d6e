// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace semslam {

// All bytes of a file. Throws InputError with the system's reason.
std::string ReadWholeFile(const std::filesystem::path& path);

// The text in quotes as it may appear in a one-line message: cut after 60 bytes, nothing
// unprintable.
std::string Quoted(std::string_view text);

// What stands between spaces, tabs and commas.
std::vector<std::string> SplitFields(std::string_view line);

// A text file of lines with fields between spaces, tabs or commas. Empty lines and lines that start
// with # are left out.
class TextFile {
 public:
  struct Line {
    int number = 0;  // From 1, as editors count.
    std::vector<std::string> fields;
  };

  explicit TextFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<Line>& lines() const { return lines_; }

  // Throws InputError "path:line: message".
  [[noreturn]] void Fail(const Line& line, const std::string& message) const;

 private:
  std::filesystem::path path_;
  std::vector<Line> lines_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace semslam::internal {

// What a failed check throws; the values streamed into it become part of its text.
class CheckError : public std::logic_error {
 public:
  CheckError(const char* file, int line, const char* condition)
      : std::logic_error(condition),
        text_(std::string(file) + ':' + std::to_string(line) + ": check failed: " + condition +
              ' ') {}

  template <typename T>
  CheckError&& operator<<(const T& value) && {
    std::ostringstream stream;
    stream << value;
    text_ += stream.str();
    return std::move(*this);
  }

  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

}  // namespace semslam::internal

// A broken contract between parts of the program: throws a std::logic_error with file, line and
// values.
//   SEMSLAM_CHECK(voxel_size > 0) << "voxel_size = " << voxel_size;
#define SEMSLAM_CHECK(condition) \
  if (condition) {               \
  } else                         \
    throw ::semslam::internal::CheckError(__FILE__, __LINE__, #condition)

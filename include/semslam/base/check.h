// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <stdexcept>

namespace semslam::internal {

// Collects the message of a failed check and throws it at the end of the statement.
class CheckFailure {
 public:
  CheckFailure(const char* file, int line, const char* condition) {
    text_ << file << ':' << line << ": check failed: " << condition << ' ';
  }
  CheckFailure(const CheckFailure&) = delete;
  CheckFailure& operator=(const CheckFailure&) = delete;
  // NOLINTNEXTLINE(bugprone-exception-escape): throwing is what it is for.
  ~CheckFailure() noexcept(false) { throw std::logic_error(text_.str()); }

  template <typename T>
  CheckFailure& operator<<(const T& value) {
    text_ << value;
    return *this;
  }

 private:
  std::ostringstream text_;
};

}  // namespace semslam::internal

// A broken contract between parts of the program: throws std::logic_error with file, line and
// values.
//   SEMSLAM_CHECK(voxel_size > 0) << "voxel_size = " << voxel_size;
#define SEMSLAM_CHECK(condition) \
  if (condition) {               \
  } else                         \
    ::semslam::internal::CheckFailure(__FILE__, __LINE__, #condition)

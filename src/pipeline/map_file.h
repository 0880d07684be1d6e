// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "semslam/base/mapped_file.h"

namespace semslam {

// A map file: a header with version, size and checksum, then the content.
void WriteMapFile(const std::filesystem::path& path, std::string_view content);

// The content of a map file, checked to be what was written. Throws InputError otherwise.
class OpenMapFile {
 public:
  explicit OpenMapFile(const std::filesystem::path& path);
  std::span<const std::byte> content() const { return content_; }

 private:
  MappedFile file_;
  std::span<const std::byte> content_;
};

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/oni_file.h"

#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include "semslam/base/error.h"

namespace semslam {

bool IsOniFile(const std::string& device) {
  std::error_code error;
  return std::filesystem::path(device).extension() == ".oni" ||
         std::filesystem::is_regular_file(device, error);
}

void CheckOniFile(const std::filesystem::path& path) {
  constexpr std::string_view kMagic = "NI10";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(path.string() + ": expected a recording of OpenNI2, found " +
                     (std::filesystem::exists(path, error) ? "no file" : "nothing"));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be read");
  std::array<char, kMagic.size()> start{};
  file.read(start.data(), start.size());
  if (std::string_view(start.data(), static_cast<std::size_t>(file.gcount())) != kMagic) {
    throw InputError(path.string() + ": expected a recording of OpenNI2, which begins with NI10, " +
                     (file.gcount() == 0 ? "found an empty file" : "found something else"));
  }
}

std::filesystem::path RecordingPart(const std::filesystem::path& path, int part) {
  if (part == 1) return path;
  std::filesystem::path name = path.stem();
  name += "_" + std::to_string(part);
  name += path.extension();
  return path.parent_path() / name;
}

}  // namespace semslam

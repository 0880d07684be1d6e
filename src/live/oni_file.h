// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace semslam {

// Whether this names a file rather than a camera.
bool IsOniFile(const std::string& device);

// Throws InputError unless there is a file that begins as a recording of OpenNI2 does. OpenNI2
// itself says nothing of use.
void CheckOniFile(const std::filesystem::path& path);

// OpenNI2 plays a recording that never came to its end as far as it goes, but opens none that was
// whole once and lost its end, where the index is. This is a copy of such a one that looks as if it
// had never been ended, in the folder for temporary files, for as long as this lives.
class UnendedCopy {
 public:
  // Throws InputError if it cannot be made.
  explicit UnendedCopy(const std::filesystem::path& recording);
  UnendedCopy(const UnendedCopy&) = delete;
  UnendedCopy& operator=(const UnendedCopy&) = delete;
  ~UnendedCopy();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The n-th part of a recording: clip.oni, clip_2.oni, ... A camera that was away goes on in another
// file: such files cannot be continued.
std::filesystem::path RecordingPart(const std::filesystem::path& path, int part);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace semslam {

// A file that appears under its name only when it is complete. It is written aside, in the same
// folder, and renamed by Commit. Destroyed without Commit, for example by an exception, it leaves
// no trace, and a file of that name that was there before is untouched. Every error (folder
// missing, not writable, disk full) throws InputError with the path and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  void Write(std::string_view bytes);

  // Closes the file and gives it its name; nothing may be written after that.
  void Commit();

 private:
  [[noreturn]] void Fail(int error_number);

  std::filesystem::path path_;
  std::filesystem::path temporary_path_;
  int descriptor_ = -1;
};

void WriteFileAtomically(const std::filesystem::path& path, std::string_view content);

// Creates the folder, and those above it, if it is not there, and makes sure that a file can be
// written in it. To be called before a long run, not after it. Throws InputError.
void CheckOutputFolder(const std::filesystem::path& folder);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

namespace semslam {
namespace {

std::string Reason(int error_number) { return std::generic_category().message(error_number); }

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw InputError(path_.string() + ": cannot write: there is something that is not a file");
  }
  constexpr int kMaxAttempts = 100;
  for (int attempt = 0; attempt < kMaxAttempts && descriptor_ < 0; ++attempt) {
    temporary_path_ = path_;
    temporary_path_ += ".tmp-" + std::to_string(::getpid()) + '-' + std::to_string(attempt);
    descriptor_ = ::open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) Fail(errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_path_.c_str());
}

void AtomicFile::Write(std::string_view bytes) {
  SEMSLAM_CHECK(descriptor_ >= 0) << path_.string() << " is committed already";
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) Fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::Commit() {
  SEMSLAM_CHECK(descriptor_ >= 0) << path_.string() << " is committed already";
  // Some file systems report a full disk only here.
  if (::close(std::exchange(descriptor_, -1)) != 0 ||
      std::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
    const int error_number = errno;
    ::unlink(temporary_path_.c_str());
    Fail(error_number);
  }
}

void AtomicFile::Fail(int error_number) {
  throw InputError(path_.string() + ": cannot write: " + Reason(error_number));
}

void WriteFileAtomically(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  file.Write(content);
  file.Commit();
}

void CheckOutputFolder(const std::filesystem::path& folder) {
  if (folder.empty()) throw InputError("output folder: expected a path, found an empty text");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(folder.string() + ": cannot create the output folder: " + error.message());
  }
  if (!std::filesystem::is_directory(folder, error)) {
    throw InputError(folder.string() + ": expected a folder, found a file");
  }
  // The only honest test of writing is to write; the file vanishes with its object.
  AtomicFile(folder / "write_test").Write("semslam\n");
}

}  // namespace semslam

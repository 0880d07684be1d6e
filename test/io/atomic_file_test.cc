// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/atomic_file.h"

#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "support/file_size_limit.h"
#include "support/files.h"

namespace semslam {
namespace {

using testing::FileSizeLimit;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::ReadAll;
using testing::TemporaryFolder;

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "a.txt";
  AtomicFile file(path);
  file.Write("one ");
  file.Write("two");
  EXPECT_FALSE(std::filesystem::exists(path));
  file.Commit();
  EXPECT_EQ(ReadAll(path), "one two");
  EXPECT_EQ(folder.NumFiles(), 1u);
}

TEST(AtomicFile, LeavesTheOldFileWhenAnExceptionPasses) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.Write("a.txt", "old");
  EXPECT_THROW(
      {
        AtomicFile file(path);
        file.Write("new");
        throw std::runtime_error("in the middle");
      },
      std::runtime_error);
  EXPECT_EQ(ReadAll(path), "old");
  EXPECT_EQ(folder.NumFiles(), 1u);
}

TEST(AtomicFile, ReplacesTheOldFile) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.Write("a.txt", "a longer old text");
  WriteFileAtomically(path, "new");
  EXPECT_EQ(ReadAll(path), "new");
}

TEST(AtomicFile, LeavesNothingOnAFullDisk) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.Write("a.txt", "old");
  const FileSizeLimit limit(1000);
  const std::string text = InputErrorOf([&] { WriteFileAtomically(path, std::string(5000, 'x')); });
  EXPECT_EQ(text, path.string() + ": cannot write: File too large");
  EXPECT_EQ(ReadAll(path), "old");
  EXPECT_EQ(folder.NumFiles(), 1u);
}

TEST(AtomicFile, NamesTheReasonWhenTheFolderIsMissing) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "no" / "a.txt";
  EXPECT_EQ(InputErrorOf([&] { WriteFileAtomically(path, "x"); }),
            path.string() + ": cannot write: No such file or directory");
}

TEST(AtomicFile, DoesNotReplaceADevice) {
  const std::string text = InputErrorOf([] { WriteFileAtomically("/dev/full", "x"); });
  EXPECT_THAT(text, HasSubstr("/dev/full: cannot write"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(AtomicFile, MayBeReadByOthersAsTheUsersOtherFiles) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder.path() / "a.txt", "x");
  const std::filesystem::path other = folder.Write("b.txt", "x");
  EXPECT_EQ(std::filesystem::status(folder.path() / "a.txt").permissions(),
            std::filesystem::status(other).permissions());
}

TEST(CheckOutputFolder, CreatesFoldersAndLeavesThemEmpty) {
  const TemporaryFolder folder;
  CheckOutputFolder(folder.path() / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "a" / "b"));
}

TEST(CheckOutputFolder, RejectsAFile) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.Write("a", "x");
  EXPECT_THAT(InputErrorOf([&] { CheckOutputFolder(path); }), HasSubstr(path.string() + ": "));
}

TEST(CheckOutputFolder, RejectsAFolderInWhichNothingCanBeWritten) {
  // /proc/self is there and a folder, and not even root can make a file in it.
  EXPECT_THAT(InputErrorOf([] { CheckOutputFolder("/proc/self"); }), HasSubstr("cannot write"));
}

}  // namespace
}  // namespace semslam

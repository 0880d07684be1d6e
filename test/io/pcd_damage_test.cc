// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/base/random.h"
#include "semslam/io/cloud_io.h"

#include "support/files.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::ReadAll;
using testing::TemporaryFolder;

// A compressed file of 20 points with labels, and where its two sizes stand: of the code and of
// what it gives.
class PcdDamageTest : public ::testing::Test {
 protected:
  PcdDamageTest() {
    Random random(3);
    std::vector<Eigen::Vector3f> positions;
    std::vector<std::uint32_t> labels;
    for (int i = 0; i < 20; ++i) {
      positions.emplace_back(static_cast<float>(random.Uniform()), 0.5F, 0.0F);
      labels.push_back(7);
    }
    const std::filesystem::path path = folder_.path() / "whole.pcd";
    WritePcd(path, {.positions = positions, .labels = labels});
    whole_ = ReadAll(path);
    constexpr std::string_view kLastOfHeader = "binary_compressed\n";
    sizes_ = whole_.find(kLastOfHeader) + kLastOfHeader.size();
  }

  // The whole file with another number at that place of the sizes, 0 or 1.
  std::string WithSize(std::size_t which, std::uint32_t size) const {
    std::string bytes = whole_;
    std::memcpy(bytes.data() + sizes_ + which * sizeof(size), &size, sizeof(size));
    return bytes;
  }

  CloudColumns Read(const std::string& bytes) const {
    return ReadPcd(folder_.Write("damaged.pcd", bytes));
  }

  TemporaryFolder folder_;
  std::string whole_;
  std::size_t sizes_ = 0;
};

TEST_F(PcdDamageTest, IsRefusedForEveryTruncation) {
  ASSERT_EQ(Read(whole_).positions.size(), 20u);
  for (std::size_t size = 0; size < whole_.size(); ++size) {
    InputErrorOf([&] { Read(whole_.substr(0, size)); });
  }
}

TEST_F(PcdDamageTest, IsRefusedIfTheCodeIsShorterOrLongerThanItSays) {
  for (const std::uint32_t size : {0U, 1U, 50U}) {
    EXPECT_THAT(InputErrorOf([&] { Read(WithSize(0, size)); }), HasSubstr("decompressed"));
  }
  EXPECT_THAT(InputErrorOf([&] { Read(WithSize(0, 4000000000U)); }), HasSubstr("cut short"));
}

TEST_F(PcdDamageTest, IsRefusedIfTheSizeOfTheDataIsNotThatOfThePoints) {
  for (const std::uint32_t size : {0U, 1U, 319U, 321U, 4000000000U}) {
    EXPECT_THAT(InputErrorOf([&] { Read(WithSize(1, size)); }), HasSubstr("says 320 bytes"));
  }
}

TEST_F(PcdDamageTest, IsRefusedBeforeMemoryIsTakenThatTheCodeCannotFill) {
  std::string bytes = WithSize(1, 200000000U * 16U);
  for (const std::string key : {"WIDTH ", "POINTS "}) {
    bytes.replace(bytes.find(key + "20"), key.size() + 2, key + "200000000");
  }
  EXPECT_THAT(InputErrorOf([&] { Read(bytes); }), HasSubstr("cannot be decompressed"));
}

TEST_F(PcdDamageTest, IsRefusedForARepeatOfWhatIsBeforeTheStart) {
  std::string bytes = whole_;
  bytes[sizes_ + 8] = 0x20;
  EXPECT_THAT(InputErrorOf([&] { Read(bytes); }), HasSubstr("cannot be decompressed"));
}

TEST_F(PcdDamageTest, NeverCrashes) {
  Random random(4);
  int num_refused = 0;
  for (int round = 0; round < 900; ++round) {
    std::string bytes = whole_;
    // Of every second file only the data, of the others mostly the header.
    const std::size_t first = round % 2 == 0 ? sizes_ : 0;
    for (int i = 0; i < 1 + round % 3; ++i) {
      const std::size_t place =
          first + random.Index(static_cast<std::uint32_t>(bytes.size() - first));
      bytes[place] = static_cast<char>(random());
    }
    try {
      EXPECT_LE(Read(bytes).positions.size(), 20u);
    } catch (const InputError&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 100);
}

TEST_F(PcdDamageTest, IsRefusedForNoise) {
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    std::string bytes(1 + random.Index(5000), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    InputErrorOf([&] { Read(bytes); });
  }
}

}  // namespace
}  // namespace semslam

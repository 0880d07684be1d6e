// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/binary_stream.h"

#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/checksum.h"
#include "semslam/base/error.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;

std::span<const std::byte> BytesOf(const BinaryWriter& writer) {
  return std::as_bytes(std::span(writer.bytes().data(), writer.bytes().size()));
}

TEST(BinaryStream, GivesBackWhatWasWritten) {
  BinaryWriter writer;
  writer.Write<std::int16_t>(-3);
  writer.WriteAll(std::span<const float>(std::array{1.5F, -2.0F}));
  writer.WriteText("mug");
  writer.WriteAll(std::span<const double>());
  writer.Write(0.1);
  BinaryReader reader(BytesOf(writer), "file");
  EXPECT_EQ(reader.Read<std::int16_t>(), -3);
  EXPECT_THAT(reader.ReadAll<float>(), ElementsAre(1.5F, -2.0F));
  EXPECT_EQ(reader.ReadText(), "mug");
  EXPECT_TRUE(reader.ReadAll<double>().empty());
  EXPECT_FALSE(reader.is_at_end());
  EXPECT_EQ(reader.ReadNumber("length"), 0.1);
  EXPECT_TRUE(reader.is_at_end());
}

TEST(BinaryStream, DoesNotReadBeyondTheEnd) {
  BinaryWriter writer;
  writer.Write<std::uint32_t>(7);
  BinaryReader reader(BytesOf(writer), "map.bin");
  try {
    reader.Read<double>();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "map.bin: byte 0: expected 8 bytes more, found 4");
  }
}

TEST(BinaryStream, RefusesACountThatTheBytesCannotHold) {
  for (const std::uint64_t count : {std::uint64_t{3}, std::numeric_limits<std::uint64_t>::max()}) {
    BinaryWriter writer;
    writer.Write(count);
    writer.Write<std::uint64_t>(0);
    BinaryReader reader(BytesOf(writer), "map.bin");
    EXPECT_THROW(reader.ReadAll<float>(), InputError) << count;
  }
}

TEST(BinaryStream, RefusesAnIndexOrNumberOutOfItsRange) {
  BinaryWriter writer;
  writer.Write<std::uint32_t>(5);
  writer.Write(std::numeric_limits<double>::quiet_NaN());
  BinaryReader reader(BytesOf(writer), "map.bin");
  EXPECT_THROW(reader.ReadIndex(5, "keyframe"), InputError);
  EXPECT_THROW(reader.ReadNumber("depth"), InputError);
}

TEST(Checksum, ChangesWithEveryByteAndTheLength) {
  std::array<std::byte, 21> bytes{};
  const std::uint64_t sum = AddToChecksum(kChecksumStart, bytes);
  for (std::byte& byte : bytes) {
    byte ^= std::byte{4};
    EXPECT_NE(AddToChecksum(kChecksumStart, bytes), sum);
    byte ^= std::byte{4};
  }
  EXPECT_EQ(AddToChecksum(kChecksumStart, bytes), sum);
  EXPECT_NE(AddToChecksum(kChecksumStart, std::span(bytes).first(8)), sum);
}

}  // namespace
}  // namespace semslam

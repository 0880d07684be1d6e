// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/huffman.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

std::vector<int> LengthsOf(const std::vector<HuffmanCode>& codes) {
  std::vector<int> lengths;
  for (const HuffmanCode& code : codes) lengths.push_back(code.length);
  return lengths;
}

// Sum of 2^-length, in parts of 2^-15: 2^15 if the code uses all there is.
int Used(const std::vector<HuffmanCode>& codes) {
  int sum = 0;
  for (const HuffmanCode& code : codes) sum += code.length > 0 ? 1 << (15 - code.length) : 0;
  return sum;
}

TEST(HuffmanCodes, AreShortForWhatIsFrequent) {
  // Huffman's tree: ((5 9) + 16) + (12 13) = 55, beside 45.
  const auto codes = MakeHuffmanCodes({5, 9, 12, 13, 16, 45}, 15);
  EXPECT_EQ(LengthsOf(codes), (std::vector{4, 4, 3, 3, 3, 1}));
}

TEST(HuffmanCodes, OfOneLengthCountUpAndGoIntoTheStreamLastBitFirst) {
  // RFC 1951, 3.2.2: lengths 3, 3, 3, 3, 3, 2, 4, 4 give 010, 011, 100, 101, 110, 00, 1110, 1111.
  const auto codes = MakeHuffmanCodes({10, 10, 10, 10, 10, 20, 5, 5}, 15);
  ASSERT_EQ(LengthsOf(codes), (std::vector{3, 3, 3, 3, 3, 2, 4, 4}));
  std::vector<int> bits;
  for (const HuffmanCode& code : codes) bits.push_back(code.bits);
  EXPECT_EQ(bits, (std::vector{0b010, 0b110, 0b001, 0b101, 0b011, 0b00, 0b0111, 0b1111}));
}

TEST(HuffmanCodes, OfWhatDoesNotOccurAreMissing) {
  EXPECT_EQ(LengthsOf(MakeHuffmanCodes({0, 3, 0, 4, 0}, 15)), (std::vector{0, 1, 0, 1, 0}));
}

TEST(HuffmanCodes, OfASingleSymbolHaveOneBit) {
  EXPECT_EQ(LengthsOf(MakeHuffmanCodes({0, 7}, 15)), (std::vector{0, 1}));
}

TEST(HuffmanCodes, AreNeverLongerThanAllowed) {
  std::vector<std::uint32_t> counts = {1, 1};  // Fibonacci's numbers: the deepest tree.
  while (counts.size() < 30) counts.push_back(counts[counts.size() - 1] + counts.rbegin()[1]);
  for (const int max_length : {5, 7, 15}) {
    const auto codes = MakeHuffmanCodes(counts, max_length);
    for (const HuffmanCode& code : codes) {
      EXPECT_GT(code.length, 0);
      EXPECT_LE(code.length, max_length);
    }
    EXPECT_EQ(Used(codes), 1 << 15) << max_length;
  }
}

}  // namespace
}  // namespace semslam

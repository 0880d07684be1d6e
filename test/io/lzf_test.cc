// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.h"

#include <string>

#include <gtest/gtest.h>
#include <pcl/io/lzf.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

std::string Noise(std::size_t size, std::uint64_t seed) {
  Random random(seed);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

// Bytes of every kind: empty, short, noise, one value, repeats at every distance up to too far.
std::vector<std::string> Samples() {
  std::vector<std::string> samples = {"", "a", "ab", "abc", "aaaa", "abcabcabcabc"};
  for (const std::size_t size : {31, 32, 33, 64, 65, 1000, 100000}) {
    samples.push_back(Noise(size, size));
    samples.emplace_back(size, 'x');
  }
  for (const std::size_t distance : {1, 2, 3, 255, 256, 257, 8191, 8192, 8193, 20000}) {
    const std::string block = Noise(distance, distance);
    samples.push_back(block + block + block.substr(0, distance / 2));
  }
  for (const std::size_t length : {2, 3, 8, 9, 10, 263, 264, 265, 530}) {
    const std::string block = Noise(length, length);
    samples.push_back(block + Noise(50, 7) + block + Noise(50, 8));
  }
  return samples;
}

TEST(Lzf, GivesBackWhatWasCompressed) {
  for (const std::string& sample : Samples()) {
    EXPECT_EQ(DecompressLzf(CompressLzf(sample), sample.size()), sample) << sample.size();
  }
}

TEST(Lzf, IsReadByPcl) {
  for (const std::string& sample : Samples()) {
    if (sample.empty()) continue;
    const std::string code = CompressLzf(sample);
    std::string result(sample.size(), '\0');
    EXPECT_EQ(pcl::lzfDecompress(code.data(), static_cast<unsigned int>(code.size()), result.data(),
                                 static_cast<unsigned int>(result.size())),
              sample.size());
    EXPECT_EQ(result, sample);
  }
}

TEST(Lzf, ReadsWhatPclCompressed) {
  for (const std::string& sample : Samples()) {
    if (sample.size() < 4) continue;
    std::string code(sample.size() * 2, '\0');
    code.resize(pcl::lzfCompress(sample.data(), static_cast<unsigned int>(sample.size()),
                                 code.data(), static_cast<unsigned int>(code.size())));
    EXPECT_EQ(DecompressLzf(code, sample.size()), sample) << sample.size();
  }
}

TEST(Lzf, MakesLittleOfMuchOfTheSame) {
  EXPECT_LT(CompressLzf(std::string(100000, 'x')).size(), 1200u);
}

TEST(Lzf, GrowsByOneByteIn32AtMost) {
  EXPECT_LE(CompressLzf(Noise(100000, 1)).size(), 100000u + 100000u / 32 + 1);
}

TEST(Lzf, RejectsEveryTruncation) {
  const std::string sample = Noise(100, 1) + std::string(300, 'x') + Noise(20, 2);
  const std::string code = CompressLzf(sample);
  for (std::size_t size = 0; size < code.size(); ++size) {
    EXPECT_FALSE(DecompressLzf(code.substr(0, size), sample.size())) << size;
  }
}

TEST(Lzf, SurvivesNoise) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::optional<std::string> result = DecompressLzf(Noise(200, seed), 300);
    EXPECT_TRUE(!result || result->size() == 300);
  }
}

TEST(Lzf, RejectsARepeatOfWhatIsBeforeTheStart) {
  EXPECT_FALSE(DecompressLzf(std::string("\x00"
                                         "a\x20\x05",
                                         4),
                             4));
}

TEST(Lzf, DoesNotAskForMemoryThatTheCodeCannotFill) {
  EXPECT_FALSE(DecompressLzf("abc", std::size_t{1} << 60));
}

}  // namespace
}  // namespace semslam

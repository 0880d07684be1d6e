// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

#include "semslam/base/check.h"

#include "io/huffman.h"

namespace semslam {
namespace {

using Bytes = std::span<const std::uint8_t>;

// Symbols: bytes, the end of a block, then 29 groups of lengths (RFC 1951, 3.2.5).
constexpr std::size_t kEndOfBlock = 256;
constexpr std::size_t kFirstLengthSymbol = 257;
constexpr std::size_t kNumSymbols = 286;
constexpr int kMinRun = 3;
constexpr int kMaxRun = 258;
constexpr int kMaxCodeLength = 15;
constexpr std::size_t kBlockSize = 1U << 16;  // Bytes that share their codes.

// How a run's length is written.
struct RunSymbol {
  std::uint16_t symbol = 0;
  std::uint8_t extra = 0;
  std::uint8_t num_extra_bits = 0;
};

constexpr std::array<RunSymbol, kMaxRun + 1> MakeRunSymbols() {
  std::array<RunSymbol, kMaxRun + 1> table;
  int length = kMinRun;
  for (std::uint16_t group = 0; group < 28; ++group) {
    const int num_bits = group < 8 ? 0 : group / 4 - 1;
    for (int i = 0; i < 1 << num_bits && length <= kMaxRun; ++i) {
      table[length++] = {static_cast<std::uint16_t>(kFirstLengthSymbol + group),
                         static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(num_bits)};
    }
  }
  table[kMaxRun] = {kNumSymbols - 1, 0, 0};  // Has a group of its own.
  return table;
}

constexpr std::array<RunSymbol, kMaxRun + 1> kRunSymbols = MakeRunSymbols();

// Bits in the order of the stream, behind what the string holds.
class BitWriter {
 public:
  explicit BitWriter(std::string& out) : out_(out), size_(out.size()) {}

  // Must come before bits are added: room for so many.
  void Reserve(std::size_t num_bits) { out_.resize(size_ + num_bits / 8 + 2 * sizeof(pending_)); }
  // At most 56 bits between two calls of Flush.
  void Add(std::uint64_t bits, int num_bits) {
    pending_ |= bits << num_pending_;
    num_pending_ += num_bits;
  }
  void Add(const HuffmanCode& code) { Add(code.bits, code.length); }
  // Writes all whole bytes (x86 is little-endian, as the stream is).
  void Flush() {
    std::memcpy(out_.data() + size_, &pending_, sizeof(pending_));
    const int num_bytes = num_pending_ / 8;
    size_ += static_cast<std::size_t>(num_bytes);
    pending_ >>= 8 * num_bytes;
    num_pending_ -= 8 * num_bytes;
  }
  // Fills up the last byte.
  void Finish() {
    Reserve(0);
    num_pending_ = (num_pending_ + 7) / 8 * 8;
    Flush();
    out_.resize(size_);
  }

 private:
  std::string& out_;
  std::size_t size_;
  std::uint64_t pending_ = 0;
  int num_pending_ = 0;
};

// How many bytes from `first` on are as the one before it; at most kMaxRun.
std::size_t RunLength(Bytes bytes, std::size_t first) {
  const std::size_t last = std::min(bytes.size(), first + kMaxRun);
  const std::uint64_t eight = bytes[first - 1] * 0x0101010101010101ULL;
  std::size_t i = first;
  for (std::uint64_t next = 0; i + sizeof(next) <= last; i += sizeof(next)) {
    std::memcpy(&next, bytes.data() + i, sizeof(next));
    if (next != eight)
      return i - first + static_cast<std::size_t>(std::countr_zero(next ^ eight)) / 8;
  }
  while (i < last && bytes[i] == bytes[first - 1]) ++i;
  return i - first;
}

// Calls on_byte(byte) and on_run(length) for what a block consists of.
template <typename OnByte, typename OnRun>
void ScanRuns(Bytes bytes, const OnByte& on_byte, const OnRun& on_run) {
  on_byte(bytes.front());
  for (std::size_t i = 1; i < bytes.size();) {
    const std::size_t length = bytes[i] == bytes[i - 1] ? RunLength(bytes, i) : 0;
    if (length >= kMinRun) {
      on_run(length);
      i += length;
    } else {
      on_byte(bytes[i++]);
    }
  }
}

using Counts = std::vector<std::uint32_t>;  // Of each symbol.

Counts CountBytes(Bytes bytes) {
  // Four tables: to count up one number again and again is slow.
  std::array<std::array<std::uint32_t, 256>, 4> tables = {};
  for (std::size_t i = 0; i < bytes.size(); ++i) ++tables[i % 4][bytes[i]];
  Counts counts(kNumSymbols, 0);
  for (const auto& table : tables) {
    for (std::size_t i = 0; i < table.size(); ++i) counts[i] += table[i];
  }
  return counts;
}

Counts CountRuns(Bytes bytes) {
  Counts counts(kNumSymbols, 0);
  ScanRuns(
      bytes, [&](std::uint8_t byte) { ++counts[byte]; },
      [&](std::size_t length) { ++counts[kRunSymbols[length].symbol]; });
  return counts;
}

void WriteBytes(Bytes bytes, const std::vector<HuffmanCode>& codes, BitWriter& out) {
  std::size_t i = 0;
  for (; i + 3 <= bytes.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) out.Add(codes[bytes[i + k]]);
    out.Flush();
  }
  for (; i < bytes.size(); ++i) {
    out.Add(codes[bytes[i]]);
    out.Flush();
  }
}

void WriteRuns(Bytes bytes, const std::vector<HuffmanCode>& codes, BitWriter& out) {
  ScanRuns(
      bytes,
      [&](std::uint8_t byte) {
        out.Add(codes[byte]);
        out.Flush();
      },
      [&](std::size_t length) {
        const RunSymbol& run = kRunSymbols[length];
        out.Add(codes[run.symbol]);
        out.Add(run.extra, run.num_extra_bits);
        out.Add(0, 1);  // The code of distance 1.
        out.Flush();
      });
}

// Lengths of the codes, which are all that the reader needs (RFC 1951, 3.2.7).
void WriteCodes(const std::vector<HuffmanCode>& codes, BitWriter& out) {
  constexpr int kNumLengthCodes = 19;
  constexpr std::array<std::size_t, kNumLengthCodes> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                               11, 4,  12, 3, 13, 2, 14, 1, 15};
  Counts counts(kNumLengthCodes, 0);
  for (const HuffmanCode& code : codes) ++counts[code.length];
  ++counts[1];  // The length of the one distance code.
  const std::vector<HuffmanCode> length_codes = MakeHuffmanCodes(counts, 7);
  out.Add(codes.size() - 257, 5);
  out.Add(0, 5);  // One distance code.
  out.Add(kNumLengthCodes - 4, 4);
  for (const std::size_t symbol : kOrder) {
    out.Add(length_codes[symbol].length, 3);
    out.Flush();
  }
  for (const HuffmanCode& code : codes) {
    out.Add(length_codes[code.length]);
    out.Flush();
  }
  out.Add(length_codes[1]);
}

void WriteBlock(Bytes bytes, bool find_runs, bool is_last, BitWriter& out) {
  Counts counts = find_runs ? CountRuns(bytes) : CountBytes(bytes);
  counts[kEndOfBlock] = 1;
  const std::vector<HuffmanCode> codes = MakeHuffmanCodes(counts, kMaxCodeLength);
  constexpr std::size_t kMaxHeader = 4096;
  constexpr std::size_t kMaxRunBits = 6;  // Behind the code of a run.
  std::size_t num_bits = kMaxHeader;
  for (std::size_t i = 0; i < counts.size(); ++i)
    num_bits += counts[i] * (codes[i].length + (i > kEndOfBlock ? kMaxRunBits : 0));
  out.Reserve(num_bits);
  out.Add(is_last ? 1 : 0, 1);
  out.Add(2, 2);  // With codes of its own.
  WriteCodes(codes, out);
  if (find_runs) {
    WriteRuns(bytes, codes, out);
  } else {
    WriteBytes(bytes, codes, out);
  }
  out.Add(codes[kEndOfBlock]);
  out.Flush();
}

// RFC 1950, 8.2: sums modulo the largest prime below 2^16.
std::uint32_t Adler32(Bytes bytes) {
  constexpr std::uint32_t kPrime = 65521;
  constexpr std::size_t kNoOverflow = 4096;  // Bytes before a sum may exceed 32 bits: 5552.
  std::uint32_t sum = 1;
  std::uint32_t sum_of_sums = 0;
  for (std::size_t first = 0; first < bytes.size(); first += kNoOverflow) {
    const Bytes part = bytes.subspan(first, std::min(kNoOverflow, bytes.size() - first));
    // All sums at once: a byte is in those of itself and of all bytes behind.
    sum_of_sums += static_cast<std::uint32_t>(part.size()) * sum;
    std::uint32_t left = static_cast<std::uint32_t>(part.size());
    for (const std::uint8_t byte : part) {
      sum += byte;
      sum_of_sums += left-- * byte;
    }
    sum %= kPrime;
    sum_of_sums %= kPrime;
  }
  return sum_of_sums << 16 | sum;
}

}  // namespace

std::string Deflate(const std::vector<std::uint8_t>& bytes, bool find_runs) {
  SEMSLAM_CHECK(!bytes.empty());
  std::string result = "\x78\x01";  // Deflate, window of 32 KB, fast.
  BitWriter out(result);
  for (std::size_t first = 0; first < bytes.size(); first += kBlockSize) {
    const std::size_t size = std::min(kBlockSize, bytes.size() - first);
    WriteBlock(Bytes(bytes).subspan(first, size), find_runs, first + size == bytes.size(), out);
  }
  out.Finish();
  const std::uint32_t checksum = Adler32(bytes);
  for (int shift = 24; shift >= 0; shift -= 8)
    result += static_cast<char>(checksum >> shift & 0xffU);
  return result;
}

}  // namespace semslam

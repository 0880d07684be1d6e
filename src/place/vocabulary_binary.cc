// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <cstring>

#include "semslam/base/checksum.h"
#include "semslam/base/error.h"

#include "place/vocabulary_file.h"

namespace semslam {
namespace {

using Node = Vocabulary::Node;

// The file: this header, num_nodes descriptors, num_nodes nodes; all little-endian.
struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t branching;
  std::uint32_t depth;
  std::uint32_t num_nodes;
  std::uint64_t checksum;  // Of the whole file with 0 in its place.
  std::array<std::uint64_t, 4> reserved;
};
static_assert(sizeof(Header) == 64 && sizeof(Node) == 12);
static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 8> kMagic = {'s', 'e', 'm', 's', 'l', 'v', 'o', 'c'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kBytesPerNode = sizeof(Descriptor) + sizeof(Node);

std::uint64_t Checksum(Header header, std::span<const std::byte> body) {
  header.checksum = 0;
  return AddToChecksum(AddToChecksum(kChecksumStart, std::as_bytes(std::span(&header, 1))), body);
}

}  // namespace

bool IsBinaryVocabulary(std::span<const std::byte> file) {
  return file.size() >= kMagic.size() &&
         std::memcmp(file.data(), kMagic.data(), kMagic.size()) == 0;
}

VocabularyArrays ParseBinary(std::span<const std::byte> file, const std::filesystem::path& path) {
  const auto fail = [&path](const std::string& what) -> void {
    throw InputError(path.string() + ": " + what);
  };
  Header header{};
  if (file.size() < sizeof(header)) {
    fail("cut short: expected a header of " + std::to_string(sizeof(header)) + " bytes, found " +
         std::to_string(file.size()));
  }
  std::memcpy(&header, file.data(), sizeof(header));
  if (header.version != kVersion) {
    fail("expected version " + std::to_string(kVersion) + " of the format, found " +
         std::to_string(header.version));
  }
  const std::span<const std::byte> body = file.subspan(sizeof(header));
  if (body.size() != header.num_nodes * kBytesPerNode) {
    fail("expected " + std::to_string(sizeof(header) + header.num_nodes * kBytesPerNode) +
         " bytes for " + std::to_string(header.num_nodes) + " nodes, found " +
         std::to_string(file.size()));
  }
  if (Checksum(header, body) != header.checksum) fail("the checksum does not fit the content");
  if (header.branching > kMaxBranching || header.depth > kMaxDepth) {
    fail("expected at most " + std::to_string(kMaxBranching) + " branches and " +
         std::to_string(kMaxDepth) + " levels, found " + std::to_string(header.branching) +
         " and " + std::to_string(header.depth));
  }
  // Header and arrays are multiples of their alignment, and a mapping starts at a page.
  const auto* descriptors = reinterpret_cast<const Descriptor*>(body.data());
  const auto* nodes =
      reinterpret_cast<const Node*>(body.data() + header.num_nodes * sizeof(Descriptor));
  return {static_cast<int>(header.branching),
          static_cast<int>(header.depth),
          {nodes, header.num_nodes},
          {descriptors, header.num_nodes}};
}

std::string FormatBinary(const VocabularyArrays& tree) {
  Header header{.magic = kMagic,
                .version = kVersion,
                .branching = static_cast<std::uint32_t>(tree.branching),
                .depth = static_cast<std::uint32_t>(tree.depth),
                .num_nodes = static_cast<std::uint32_t>(tree.nodes.size()),
                .checksum = 0,
                .reserved = {}};
  std::string file(sizeof(header), '\0');
  const auto append = [&file](std::span<const std::byte> bytes) {
    file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  append(std::as_bytes(tree.descriptors));
  append(std::as_bytes(tree.nodes));
  header.checksum = Checksum(header, std::as_bytes(std::span(file)).subspan(sizeof(header)));
  std::memcpy(file.data(), &header, sizeof(header));
  return file;
}

}  // namespace semslam

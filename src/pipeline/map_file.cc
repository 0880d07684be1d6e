// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/map_file.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "semslam/base/checksum.h"
#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"

namespace semslam {
namespace {

struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t unused;
  std::uint64_t content_size;
  std::uint64_t checksum;  // Of the content.
};
static_assert(sizeof(Header) == 32);

constexpr std::array<char, 8> kMagic = {'s', 'e', 'm', 's', 'l', 'm', 'a', 'p'};
constexpr std::uint32_t kVersion = 2;

}  // namespace

void WriteMapFile(const std::filesystem::path& path, std::string_view content) {
  const Header header{.magic = kMagic,
                      .version = kVersion,
                      .unused = 0,
                      .content_size = content.size(),
                      .checksum = AddToChecksum(kChecksumStart, std::as_bytes(std::span(content)))};
  AtomicFile file(path);
  file.Write({reinterpret_cast<const char*>(&header), sizeof(header)});
  file.Write(content);
  file.Commit();
}

OpenMapFile::OpenMapFile(const std::filesystem::path& path) : file_(path) {
  const auto fail = [&path](const std::string& what) {
    throw InputError(path.string() + ": " + what);
  };
  Header header{};
  if (file_.bytes().size() < sizeof(header) ||
      std::memcmp(file_.bytes().data(), kMagic.data(), kMagic.size()) != 0) {
    fail("expected a map file of semslam, found something else");
  }
  std::memcpy(&header, file_.bytes().data(), sizeof(header));
  if (header.version != kVersion) {
    fail("expected version " + std::to_string(kVersion) + " of the map format, found " +
         std::to_string(header.version));
  }
  content_ = file_.bytes().subspan(sizeof(header));
  if (content_.size() != header.content_size) {
    fail("expected " + std::to_string(header.content_size) + " bytes of content, found " +
         std::to_string(content_.size()));
  }
  if (AddToChecksum(kChecksumStart, content_) != header.checksum) {
    fail("the checksum does not fit the content: the file is damaged");
  }
}

}  // namespace semslam

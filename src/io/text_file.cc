// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_file.h"

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr std::string_view kSeparators = " \t,\r";

[[noreturn]] void FailToRead(const std::filesystem::path& path, int error_number) {
  throw InputError(path.string() +
                   ": cannot read: " + std::generic_category().message(error_number));
}

// Closes the descriptor on every way out.
class ReadDescriptor {
 public:
  explicit ReadDescriptor(const std::filesystem::path& path)
      : value_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ReadDescriptor(const ReadDescriptor&) = delete;
  ReadDescriptor& operator=(const ReadDescriptor&) = delete;
  ~ReadDescriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int value() const { return value_; }

 private:
  int value_;
};

}  // namespace

std::string ReadWholeFile(const std::filesystem::path& path) {
  const ReadDescriptor descriptor(path);
  if (descriptor.value() < 0) FailToRead(path, errno);
  struct stat information {};
  if (::fstat(descriptor.value(), &information) != 0) FailToRead(path, errno);
  std::string content;
  content.reserve(static_cast<std::size_t>(information.st_size));
  std::array<char, 1 << 16> buffer;
  while (true) {
    const ssize_t count = ::read(descriptor.value(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) FailToRead(path, errno);
    if (count == 0) return content;
    content.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::vector<std::string> SplitFields(std::string_view line) {
  std::vector<std::string> fields;
  std::size_t first = line.find_first_not_of(kSeparators);
  while (first != std::string_view::npos) {
    const std::size_t last = std::min(line.find_first_of(kSeparators, first), line.size());
    fields.emplace_back(line.substr(first, last - first));
    first = line.find_first_not_of(kSeparators, last);
  }
  return fields;
}

std::string Quoted(std::string_view text) {
  constexpr std::size_t kMaxLength = 60;
  std::string result = "\"";
  for (const char c : text.substr(0, kMaxLength)) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    result += control ? '?' : c;
  }
  return result + (text.size() > kMaxLength ? "...\"" : "\"");
}

TextFile::TextFile(std::filesystem::path path) : path_(std::move(path)) {
  const std::string content = ReadWholeFile(path_);
  std::string_view rest = content;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    std::vector<std::string> fields = SplitFields(line);
    if (fields.empty() || fields.front().starts_with('#')) continue;
    lines_.push_back({number, std::move(fields)});
  }
}

void TextFile::Fail(const Line& line, const std::string& message) const {
  throw InputError(path_.string() + ":" + std::to_string(line.number) + ": " + message);
}

}  // namespace semslam

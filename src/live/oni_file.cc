// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/oni_file.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>
#include <system_error>

#include <unistd.h>

#include "semslam/base/error.h"

namespace semslam {
namespace {

// After a header the file is a list of records. Numbers are little endian, as on every machine that
// this is built for.
constexpr std::streamoff kHeaderBytes = 24;
struct RecordHeader {
  std::uint32_t magic = 0;
  std::uint32_t type = 0;
  std::uint32_t stream = 0;
  std::uint32_t num_header_bytes = 0;  // With what the type adds to these.
  std::uint32_t num_data_bytes = 0;
  std::array<std::uint32_t, 2> position_of_old_record{};
};
constexpr std::uint32_t kMagic = 0x0052494e;
constexpr std::uint32_t kStreamRecord = 13;
constexpr std::uint32_t kImageRecord = 10;

// The end of the header of a stream's record, as it is until the recording is ended.
struct StreamLength {
  std::int32_t num_images = -1;
  std::array<std::uint32_t, 2> first_time{};
  std::array<std::int32_t, 2> last_time{-1, -1};
  std::array<std::uint32_t, 2> position_of_index{};
};
static_assert(sizeof(RecordHeader) == 28 && sizeof(StreamLength) == 28);

// Returns whether there was one. All streams' records come before the first image.
bool MarkUnended(std::fstream& file) {
  bool has_streams = false;
  std::streamoff position = kHeaderBytes;
  RecordHeader record;
  const auto read_record = [&] {
    file.seekg(position);
    file.read(reinterpret_cast<char*>(&record), sizeof(record));
    return file.good() && record.magic == kMagic && record.type != kImageRecord &&
           record.num_header_bytes >= sizeof(record);
  };
  while (read_record()) {
    const std::streamoff next = position + record.num_header_bytes + record.num_data_bytes;
    if (record.type == kStreamRecord &&
        record.num_header_bytes >= sizeof(record) + sizeof(StreamLength)) {
      const StreamLength unended;
      file.seekp(position + record.num_header_bytes - std::streamoff{sizeof(unended)});
      file.write(reinterpret_cast<const char*>(&unended), sizeof(unended));
      has_streams = true;
    }
    position = next;
  }
  file.clear();
  return has_streams;
}

std::filesystem::path MakeTemporaryFile() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  constexpr std::string_view kExtension = ".oni";
  std::string path = (folder / "semslam_XXXXXX").string() + std::string(kExtension);
  const int file = error ? -1 : ::mkstemps(path.data(), static_cast<int>(kExtension.size()));
  if (file < 0) throw InputError(path + ": no temporary file can be made there");
  ::close(file);
  return path;
}

}  // namespace

UnendedCopy::UnendedCopy(const std::filesystem::path& recording) : path_(MakeTemporaryFile()) {
  std::error_code error;
  std::filesystem::copy_file(recording, path_, std::filesystem::copy_options::overwrite_existing,
                             error);
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  const bool is_copied = !error && file.good();
  const bool is_marked = is_copied && MarkUnended(file) && file.flush().good();
  if (is_marked) return;
  std::filesystem::remove(path_, error);
  throw InputError(recording.string() + ": the recording is damaged, or was cut short" +
                   (is_copied ? ": nothing of its streams is left"
                              : ", and the copy of it that could be read has no place in " +
                                    path_.parent_path().string()));
}

UnendedCopy::~UnendedCopy() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

bool IsOniFile(const std::string& device) {
  std::error_code error;
  return std::filesystem::path(device).extension() == ".oni" ||
         std::filesystem::is_regular_file(device, error);
}

void CheckOniFile(const std::filesystem::path& path) {
  constexpr std::string_view kStart = "NI10";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(path.string() + ": expected a recording of OpenNI2, found " +
                     (std::filesystem::exists(path, error) ? "no file" : "nothing"));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be read");
  std::array<char, kStart.size()> start{};
  file.read(start.data(), start.size());
  if (std::string_view(start.data(), static_cast<std::size_t>(file.gcount())) != kStart) {
    throw InputError(path.string() + ": expected a recording of OpenNI2, which begins with NI10, " +
                     (file.gcount() == 0 ? "found an empty file" : "found something else"));
  }
}

std::filesystem::path RecordingPart(const std::filesystem::path& path, int part) {
  if (part == 1) return path;
  std::filesystem::path name = path.stem();
  name += "_" + std::to_string(part);
  name += path.extension();
  return path.parent_path() / name;
}

}  // namespace semslam

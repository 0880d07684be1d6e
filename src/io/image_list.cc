// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_list.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>

#include "semslam/base/error.h"

#include "io/text_file.h"

namespace semslam {
namespace {

struct TimedFile {
  TimeNs time = 0;
  std::filesystem::path path;
};

TimedFile ParseTimedFile(const TextFile& file,
                         const TextFile::Line& line,
                         std::size_t first_field,
                         const std::filesystem::path& sequence) {
  const std::string& time_text = line.fields[first_field];
  const std::optional<TimeNs> time = ParseTime(time_text);
  if (!time) file.Fail(line, "expected a time in seconds, found " + Quoted(time_text));
  const std::filesystem::path path = sequence / line.fields[first_field + 1];
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    file.Fail(line, "names the image " + path.string() + ", which is not there");
  }
  return {*time, path};
}

void CheckIncreasing(const TextFile& file, const TextFile::Line& line, TimeNs before, TimeNs now) {
  if (now > before) return;
  file.Fail(line, "expected a time after that of the line before, " + FormatTime(before) +
                      ", found " + FormatTime(now));
}

std::vector<TimedFile> ReadImageList(const std::filesystem::path& sequence, const char* name) {
  const TextFile file(sequence / name);
  std::vector<TimedFile> images;
  for (const TextFile::Line& line : file.lines()) {
    if (line.fields.size() != 2) {
      file.Fail(line,
                "expected `time file`, found " + std::to_string(line.fields.size()) + " fields");
    }
    TimedFile image = ParseTimedFile(file, line, 0, sequence);
    if (!images.empty()) CheckIncreasing(file, line, images.back().time, image.time);
    images.push_back(std::move(image));
  }
  if (images.empty()) throw InputError(file.path().string() + ": expected images, found none");
  return images;
}

// Indices into two lists that are sorted by time, and how far apart the two are.
struct Candidate {
  TimeNs difference = 0;
  std::size_t color = 0;
  std::size_t depth = 0;
};

std::vector<Candidate> FindCandidates(const std::vector<TimedFile>& colors,
                                      const std::vector<TimedFile>& depths,
                                      TimeNs max_difference) {
  std::vector<Candidate> candidates;
  std::size_t first = 0;
  for (std::size_t color = 0; color < colors.size(); ++color) {
    const TimeNs time = colors[color].time;
    while (first < depths.size() && depths[first].time < time - max_difference) ++first;
    for (std::size_t depth = first; depth < depths.size(); ++depth) {
      if (depths[depth].time > time + max_difference) break;
      candidates.push_back({std::abs(depths[depth].time - time), color, depth});
    }
  }
  return candidates;
}

}  // namespace

std::vector<TumDataset::Entry> ReadAssociations(const std::filesystem::path& sequence,
                                                const std::filesystem::path& associations) {
  const TextFile file(associations);
  std::vector<TumDataset::Entry> entries;
  for (const TextFile::Line& line : file.lines()) {
    if (line.fields.size() != 4) {
      file.Fail(line, "expected `time color_file time depth_file`, found " +
                          std::to_string(line.fields.size()) + " fields");
    }
    TimedFile color = ParseTimedFile(file, line, 0, sequence);
    TimedFile depth = ParseTimedFile(file, line, 2, sequence);
    if (!entries.empty()) CheckIncreasing(file, line, entries.back().color_time, color.time);
    entries.push_back({color.time, std::move(color.path), depth.time, std::move(depth.path)});
  }
  if (entries.empty()) throw InputError(file.path().string() + ": expected images, found none");
  return entries;
}

std::vector<TumDataset::Entry> AssociateByTime(const std::filesystem::path& sequence,
                                               TimeNs max_time_difference) {
  const std::vector<TimedFile> colors = ReadImageList(sequence, "rgb.txt");
  const std::vector<TimedFile> depths = ReadImageList(sequence, "depth.txt");
  std::vector<Candidate> candidates = FindCandidates(colors, depths, max_time_difference);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.difference, a.color, a.depth) < std::tie(b.difference, b.color, b.depth);
  });

  std::vector<bool> color_used(colors.size());
  std::vector<bool> depth_used(depths.size());
  std::vector<TumDataset::Entry> entries;
  for (const Candidate& pair : candidates) {
    if (color_used[pair.color] || depth_used[pair.depth]) continue;
    color_used[pair.color] = depth_used[pair.depth] = true;
    const TimedFile& color = colors[pair.color];
    const TimedFile& depth = depths[pair.depth];
    entries.push_back({color.time, color.path, depth.time, depth.path});
  }
  std::sort(entries.begin(), entries.end(),
            [](const TumDataset::Entry& a, const TumDataset::Entry& b) {
              return a.color_time < b.color_time;
            });
  if (entries.empty()) {
    throw InputError(sequence.string() + ": no image of rgb.txt (" + std::to_string(colors.size()) +
                     ") is within " + FormatTime(max_time_difference, 3) +
                     " s of one of depth.txt (" + std::to_string(depths.size()) + ")");
  }
  return entries;
}

}  // namespace semslam

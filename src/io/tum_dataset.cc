// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/tum_dataset.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <system_error>

#include "semslam/base/error.h"

#include "io/image_list.h"
#include "io/png_reader.h"
#include "io/text_file.h"

namespace semslam {
namespace {

std::string Describe(const PngHeader& header) {
  std::string text = std::to_string(header.width) + "x" + std::to_string(header.height) + ", " +
                     std::to_string(header.bit_depth) + "-bit, " +
                     std::to_string(header.num_channels) +
                     (header.num_channels == 1 ? " channel" : " channels");
  return header.has_palette ? text + " (palette)" : text;
}

// Decodes a PNG file that must be complete, of the expected size and accepted by `is_expected`.
template <typename Predicate>
cv::Mat ReadPng(const std::filesystem::path& path,
                const TumDataset::Options& options,
                const std::string& expected,
                PngPixels pixels,
                Predicate is_expected) {
  const std::string bytes = ReadWholeFile(path);
  PngReader reader(path.string(), bytes);
  const PngHeader& header = reader.header();
  if (header.width != options.width || header.height != options.height || !is_expected(header)) {
    throw InputError(path.string() + ": expected " + std::to_string(options.width) + "x" +
                     std::to_string(options.height) + ", " + expected + ", found " +
                     Describe(header));
  }
  return reader.Decode(pixels);
}

cv::Mat ReadColor(const std::filesystem::path& path, const TumDataset::Options& options) {
  const auto is_expected = [](const PngHeader& header) { return header.bit_depth <= 8; };
  return ReadPng(path, options, "8-bit, colour or grey", PngPixels::kBgr8, is_expected);
}

cv::Mat ReadDepth(const std::filesystem::path& path, const TumDataset::Options& options) {
  const auto is_expected = [](const PngHeader& header) {
    return header.bit_depth == 16 && header.num_channels == 1;
  };
  const cv::Mat raw =
      ReadPng(path, options, "16-bit, 1 channel", PngPixels::kAsStored, is_expected);
  return DepthToMetres(raw, options.depth_factor);
}

std::vector<TumDataset::Entry> ReadEntries(const std::filesystem::path& sequence,
                                           const std::filesystem::path& associations,
                                           TimeNs max_time_difference) {
  std::error_code error;
  if (!std::filesystem::is_directory(sequence, error)) {
    throw InputError(sequence.string() + ": expected the folder of a sequence, found " +
                     (std::filesystem::exists(sequence, error) ? "a file" : "nothing"));
  }
  if (associations.empty() || associations == "-") {
    return AssociateByTime(sequence, max_time_difference);
  }
  return ReadAssociations(sequence, associations);
}

}  // namespace

void TumDataset::Options::Validate() const {
  if (width <= 0 || height <= 0) throw std::invalid_argument("image size must be positive");
  if (!(depth_factor > 0) || !std::isfinite(depth_factor)) {
    throw std::invalid_argument("depth_factor must be positive");
  }
  if (max_time_difference < 0) throw std::invalid_argument("max_time_difference must be >= 0");
}

TumDataset::TumDataset(const std::filesystem::path& sequence,
                       const std::filesystem::path& associations,
                       const Options& options)
    : options_(options) {
  options_.Validate();
  entries_ = ReadEntries(sequence, associations, options_.max_time_difference);
}

std::optional<RgbdImage> TumDataset::Next() {
  if (next_ == entries_.size()) return std::nullopt;
  return Read(entries_[next_++]);
}

RgbdImage TumDataset::Read(const Entry& entry) const {
  RgbdImage frame;
  frame.time = entry.color_time;
  frame.color = ReadColor(entry.color_path, options_);
  frame.depth = ReadDepth(entry.depth_path, options_);
  return frame;
}

}  // namespace semslam

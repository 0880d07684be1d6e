// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "semslam/base/time.h"
#include "semslam/camera/frame_source.h"
#include "semslam/camera/rgbd_image.h"

namespace semslam {

// A recorded sequence in the format of the TUM RGB-D benchmark: a folder with 8-bit colour (or
// grey) images and 16-bit depth images, and a text file that says which belong together. For one
// thread.
class TumDataset : public FrameSource {
 public:
  struct Options {
    int width = 640;                          // Pixels; every image must have this size.
    int height = 480;                         // Pixels.
    double depth_factor = 5000.0;             // Value of a depth pixel at 1 m.
    TimeNs max_time_difference = 20'000'000;  // Of a colour and a depth image; without
                                              // associations file.
    void Validate() const;                    // Throws std::invalid_argument.
  };

  struct Entry {
    TimeNs color_time = 0;
    std::filesystem::path color_path;
    TimeNs depth_time = 0;
    std::filesystem::path depth_path;
  };

  // `associations`: a file with lines `t_color color_file t_depth depth_file`, file names relative
  // to the sequence's folder. Empty or "-": rgb.txt and depth.txt of the folder (lines `t file`)
  // are paired by nearest time, best pairs first, each image once.
  // Reads and checks all of the text files, and that every image is there, before the first frame:
  // throws InputError that names file and line.
  TumDataset(const std::filesystem::path& sequence,
             const std::filesystem::path& associations,
             const Options& options);

  // Throws InputError, and goes on with the next frame in the next call, if an image is truncated,
  // damaged, of another size or of another type.
  std::optional<RgbdImage> Next() override;
  // The frame of an entry; throws as Next does.
  RgbdImage Read(const Entry& entry) const;
  std::optional<std::size_t> NumFrames() const override { return entries_.size(); }

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Options options_;
  std::vector<Entry> entries_;
  std::size_t next_ = 0;
};

}  // namespace semslam

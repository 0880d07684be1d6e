// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "semslam/io/object_views.h"
#include "semslam/io/report.h"

namespace semslam {

// A keyframe as the strip shows it.
struct StripPicture {
  std::size_t keyframe = 0;  // Place in ReportData::keyframes.
  std::string jpeg;
};

// Small pictures of at most max_pictures keyframes, spread evenly. Those that cannot be decoded are
// left out.
std::vector<StripPicture> MakeStrip(const std::vector<ReportKeyframe>& keyframes,
                                    std::size_t max_pictures);

// For each object of the map the keyframe in which it was detected best, or if in none, that in
// whose picture it lies whole and largest. Nothing if no keyframe looked at it.
std::vector<std::optional<ObjectView>> FindObjectViews(const ReportData& data);

// Each object cut out of its best view, as JPEG; empty where there is none.
std::vector<std::string> MakeObjectPictures(const ReportData& data,
                                            const std::vector<std::optional<ObjectView>>& views);

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "semslam/io/report.h"

#include "io/report/pictures.h"
#include "io/report/scene_json.h"

namespace semslam {

// The parts of the page, as HTML. All texts are escaped.
std::string HighlightTiles(const ReportData& data);
std::string NoteList(const std::vector<std::string>& notes);
std::string FactTable(const std::vector<ReportFact>& facts);

// One row an object, the largest confidence first; at most max_rows. Pictures as JPEG.
std::string ObjectTable(const LabelledMapView& map,
                        const std::vector<std::string>& pictures,
                        std::size_t max_rows);

std::string KeyframeStrip(const ReportData& data, const std::vector<StripPicture>& pictures);

// From above, along each axis over time, and the error over time if the truth is known.
std::string TrajectoryPlots(const ReportData& data, const LevelFrame& level);
std::string SpeedPlots(const ReportSpeed& speed);

// The file, or as much of it as max_bytes allow.
std::string SettingsText(const std::string& text, std::size_t max_bytes);

}  // namespace semslam

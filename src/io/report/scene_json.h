// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "semslam/io/level_frame.h"
#include "semslam/io/report.h"

#include "io/report/map_points.h"
#include "io/report/pictures.h"

namespace semslam {

// What view.js needs besides the points, as JSON that may stand in a script element.
std::string SceneJson(const ReportData& data,
                      const LevelFrame& level,
                      const PackedPoints& points,
                      const std::vector<std::optional<ObjectView>>& object_views);

// "#rrggbb"
std::string HexColor(Rgb color);

// Where a trajectory was interrupted: the time between two poses is much longer than usual.
bool IsGap(TimeNs before, TimeNs after);

}  // namespace semslam

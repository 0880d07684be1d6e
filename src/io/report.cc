// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/report.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>

#include "semslam/base/check.h"
#include "semslam/io/atomic_file.h"

#include "io/report/html.h"
#include "io/report/map_points.h"
#include "io/report/page_files.h"
#include "io/report/pictures.h"
#include "io/report/scene_json.h"
#include "io/report/sections.h"

namespace semslam {
namespace {

std::string_view FindPageFile(std::string_view name) {
  const auto files = PageFiles();
  const auto file = std::find_if(files.begin(), files.end(),
                                 [&](const EmbeddedText& f) { return f.name == name; });
  SEMSLAM_CHECK(file != files.end()) << name;
  return file->text;
}

std::string MapNote(const LabelledMapView& map, const PackedPoints& points) {
  const std::size_t num_points = map.cloud.positions.size();
  std::string note = GroupDigits(points.num_points) + " points";
  if (points.num_points < num_points) note += " of " + GroupDigits(num_points);
  return note;
}

// Everything but the points.
using Values = std::map<std::string, std::string, std::less<>>;
Values PageValues(const ReportData& data, const ReportOptions& options, const LevelFrame& level) {
  Values values;
  values["style"] = FindPageFile("style.css");
  for (const char* name : {"camera.js", "renderer.js", "page.js"})
    values["script"] += FindPageFile(name);
  values["title"] = EscapeHtml(data.title);
  values["program"] = EscapeHtml(data.program);
  values["highlights"] = HighlightTiles(data);
  values["notes"] = NoteList(data.notes);
  values["facts"] = FactTable(data.facts);
  values["accuracy"] = data.accuracy ? FactTable(data.accuracy->facts) : "";
  values["strip"] = KeyframeStrip(data, MakeStrip(data.keyframes, options.max_keyframes));
  values["trajectory"] = TrajectoryPlots(data, level);
  values["speed_facts"] = FactTable(data.speed.facts);
  values["speed"] = SpeedPlots(data.speed);
  values["options"] = FactTable(data.options);
  values["settings"] = SettingsText(data.settings_text, options.max_settings);
  return values;
}

// How many points leave the file as small as it has to be.
std::size_t AffordablePoints(const Values& values, const ReportOptions& options) {
  std::size_t num_bytes = 0;
  for (const auto& [name, value] : values) num_bytes += value.size();
  constexpr std::size_t kMargin = 4096;
  num_bytes += FindPageFile("page.html").size() + kMargin;
  const std::size_t left = options.max_bytes > num_bytes ? options.max_bytes - num_bytes : 0;
  return std::min(options.max_points, left / 4 * 3 / PackedPoints::kBytesPerPoint);
}

}  // namespace

void ReportOptions::Validate() const {
  if (max_bytes < 200'000) throw std::invalid_argument("a report needs 200 kB at least");
}

void WriteReport(const std::filesystem::path& path,
                 const ReportData& data,
                 const ReportOptions& options) {
  options.Validate();
  const LevelFrame level = FindLevelFrame(data.map);
  Values values = PageValues(data, options, level);
  const auto views = FindObjectViews(data);
  values["objects"] = ObjectTable(data.map, MakeObjectPictures(data, views), options.max_objects);
  values["scene"] = SceneJson(data, level, {}, views);  // Its length.
  const PackedPoints points = PackPoints(data.map, AffordablePoints(values, options));
  values["scene"] = SceneJson(data, level, points, views);
  values["map_note"] = MapNote(data.map, points);
  values["points"] = Base64(points.bytes);
  WriteFileAtomically(path, FillTemplate(FindPageFile("page.html"), values));
}

}  // namespace semslam

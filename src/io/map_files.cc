// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/map_files.h"

#include <cstdint>
#include <map>

#include "semslam/io/map_picture.h"

namespace semslam {
namespace {

Rgb MutedGrey(Rgb c) {
  const float luminance = 0.299F * c.r + 0.587F * c.g + 0.114F * c.b;
  const auto grey = static_cast<std::uint8_t>(50.0F + 0.45F * luminance);
  return {grey, grey, grey};
}

}  // namespace

std::vector<Rgb> SemanticColors(const LabelledMapView& map) {
  std::map<std::uint32_t, Rgb> color_of_label;
  for (const ClassRecord& entry : map.classes) color_of_label[entry.label] = entry.color;
  color_of_label.erase(0);
  constexpr Rgb kNoPhoto{200, 200, 200};
  std::vector<Rgb> colors;
  colors.reserve(map.cloud.positions.size());
  for (std::size_t i = 0; i < map.cloud.positions.size(); ++i) {
    const std::uint32_t label = map.cloud.labels.empty() ? 0 : map.cloud.labels[i];
    const auto entry = color_of_label.find(label);
    colors.push_back(entry != color_of_label.end()
                         ? entry->second
                         : MutedGrey(map.cloud.colors.empty() ? kNoPhoto : map.cloud.colors[i]));
  }
  return colors;
}

void WriteMapFiles(const std::filesystem::path& folder, const LabelledMapView& map) {
  const CloudView& cloud = map.cloud;
  WritePcd(folder / "global_color.pcd", {.positions = cloud.positions, .colors = cloud.colors});
  WritePcd(
      folder / "segmentation.pcd",
      {.positions = cloud.positions,
       .labels = map.segments_by_geometry.empty() ? cloud.segments : map.segments_by_geometry});

  const std::vector<Rgb> semantic_colors = SemanticColors(map);
  WritePcd(folder / "semantic_map.pcd",
           {.positions = cloud.positions, .colors = semantic_colors, .labels = cloud.labels});
  CloudView semantic_cloud = cloud;
  semantic_cloud.colors = semantic_colors;
  WritePly(folder / "semantic_map.ply", semantic_cloud);
  WriteObjects(folder / "objects.json", map.classes, map.objects);
  WriteMapPictures(folder, map);
}

}  // namespace semslam

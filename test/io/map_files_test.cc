// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/map_files.h"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include "support/files.h"

namespace semslam {
namespace {

using testing::ReadAll;
using testing::TemporaryFolder;

// Three points: a cup, nothing, and a class that the table does not know.
struct SmallMap {
  std::vector<Eigen::Vector3f> positions = {{0, 0, 1}, {0.1F, 0, 1}, {0, 0.1F, 1}};
  std::vector<Rgb> colors = {{10, 20, 30}, {100, 100, 100}, {200, 0, 0}};
  std::vector<std::uint32_t> segments = {4, 5, 0};
  std::vector<std::uint32_t> labels = {7, 0, 9};

  LabelledMapView View() const {
    LabelledMapView view;
    view.cloud = {.positions = positions, .colors = colors, .labels = labels, .segments = segments};
    view.classes = {{7, "cup", {1, 2, 3}}};
    return view;
  }
};

template <typename Point>
pcl::PointCloud<Point> Load(const std::filesystem::path& path) {
  pcl::PointCloud<Point> cloud;
  EXPECT_EQ(pcl::io::loadPCDFile(path.string(), cloud), 0) << path;
  return cloud;
}

TEST(MapFiles, AreAllThereAndNothingElse) {
  const TemporaryFolder folder;
  WriteMapFiles(folder.path(), SmallMap().View());
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names, (std::set<std::string>{"global_color.pcd", "objects.json", "segmentation.pcd",
                                          "semantic_map.pcd", "semantic_map.ply",
                                          "semantic_map_top.png", "semantic_map_view.png"}));
}

TEST(MapFiles, HoldColourSegmentAndClassOfEveryPoint) {
  const TemporaryFolder folder;
  const SmallMap map;
  WriteMapFiles(folder.path(), map.View());
  const auto colors = Load<pcl::PointXYZRGBA>(folder.path() / "global_color.pcd");
  const auto segments = Load<pcl::PointXYZL>(folder.path() / "segmentation.pcd");
  const auto classes = Load<pcl::PointXYZRGBL>(folder.path() / "semantic_map.pcd");
  ASSERT_EQ(colors.size(), 3u);
  ASSERT_EQ(segments.size(), 3u);
  ASSERT_EQ(classes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((Rgb{colors[i].r, colors[i].g, colors[i].b}), map.colors[i]);
    EXPECT_EQ(segments[i].label, map.segments[i]);
    EXPECT_EQ(classes[i].label, map.labels[i]);
  }
  EXPECT_EQ((Rgb{classes[0].r, classes[0].g, classes[0].b}), (Rgb{1, 2, 3}));
}

TEST(MapFiles, AreTheSameBytesEveryTime) {
  const TemporaryFolder a;
  const TemporaryFolder b;
  WriteMapFiles(a.path(), SmallMap().View());
  WriteMapFiles(b.path(), SmallMap().View());
  for (const auto& entry : std::filesystem::directory_iterator(a.path())) {
    EXPECT_EQ(ReadAll(entry.path()), ReadAll(b.path() / entry.path().filename()));
  }
}

TEST(MapFiles, CanBeWrittenOfAnEmptyMap) {
  const TemporaryFolder folder;
  WriteMapFiles(folder.path(), {});
  EXPECT_EQ(folder.NumFiles(), 7u);
  EXPECT_TRUE(ReadPcd(folder.path() / "semantic_map.pcd").positions.empty());
}

TEST(SemanticColors, AreGreyWithoutAKnownClass) {
  const std::vector<Rgb> colors = SemanticColors(SmallMap().View());
  EXPECT_EQ(colors[0], (Rgb{1, 2, 3}));
  for (const std::size_t i : {1, 2}) {
    EXPECT_EQ(colors[i].r, colors[i].g);
    EXPECT_EQ(colors[i].g, colors[i].b);
  }
}

}  // namespace
}  // namespace semslam

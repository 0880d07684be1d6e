// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/report.h"

#include <cmath>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "semslam/base/stopwatch.h"

#include "support/files.h"
#include "support/sanitized.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;
using ::testing::Not;
using testing::TemporaryFolder;

// A level square of points 1 cm apart, 1 m in front of the first camera.
struct Floor {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Rgb> colors;
  std::vector<std::uint32_t> segments;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> objects;

  explicit Floor(int size) {
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        positions.emplace_back(0.01F * static_cast<float>(i), 0.5F,
                               1.0F + 0.01F * static_cast<float>(j));
        normals.push_back(-Eigen::Vector3f::UnitY());
        colors.push_back({static_cast<std::uint8_t>(i), 100, 50});
        segments.push_back(7);
        labels.push_back(3);
        objects.push_back(1);
      }
    }
  }
};

std::string JpegOf(int width, int height) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", cv::Mat(height, width, CV_8UC3, cv::Scalar(40, 90, 160)), bytes);
  return {bytes.begin(), bytes.end()};
}

// A run with all there can be.
ReportData FullReport(Floor&&) = delete;  // The report looks at the floor's points.
ReportData FullReport(const Floor& floor) {
  ReportData data;
  data.title = "desk";
  data.program = "rgbd_tum 1.0";
  data.highlights = {{"frames tracked", "2 / 2"}};
  data.facts = {{"frames lost", "0"}};
  data.options = {{"sequence", "clips/desk"}};
  data.settings_text = "%YAML:1.0\nCamera.fx: 500\n";
  data.speed.tracking_milliseconds = {10, 20, 15};
  data.speed.queues = {{1, 0, 0, 2, 1}, {2, 1, 0, 3, 1}};
  data.camera = {.width = 640, .height = 480, .fx = 500, .fy = 500, .cx = 320, .cy = 240};
  ReportAccuracy accuracy;
  for (int i = 0; i < 20; ++i) {
    Rigid3 pose;
    pose.translation = {0.1 * i, 0, 0.05 * i};
    data.trajectory.push_back({i * kNsPerSecond / 10, pose});
    accuracy.poses.push_back({i * kNsPerSecond / 10, pose.translation, 0.001 * i});
  }
  data.accuracy = accuracy;
  data.keyframes.push_back({0, {}, JpegOf(640, 480), {{2, 0.9F, {220, 330, 420, 405}, {}}}});
  data.map.cloud = {.positions = floor.positions,
                    .colors = floor.colors,
                    .normals = floor.normals,
                    .labels = floor.labels,
                    .segments = floor.segments,
                    .objects = floor.objects};
  data.map.classes = {{3, "keyboard", {1, 2, 3}}};
  ObjectRecord object;
  object.id = 1;
  object.label = 3;
  object.confidence = 0.75;
  object.box.T_world_box.translation = {0, 0.3, 1.2};
  object.box.half_size = {0.2, 0.05, 0.1};
  data.map.objects = {object};
  return data;
}

std::string Write(const ReportData& data, const ReportOptions& options = {}) {
  const TemporaryFolder folder;
  WriteReport(folder.path() / "report.html", data, options);
  return testing::ReadAll(folder.path() / "report.html");
}

// Between the start of the element with that id and its end.
std::string ElementText(const std::string& page, const std::string& id) {
  const std::size_t begin = page.find(">", page.find("id=\"" + id + "\"")) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

nlohmann::json SceneOf(const std::string& page) {
  return nlohmann::json::parse(ElementText(page, "scene"));
}

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

// The first tag that does not fit the one before, or nothing. Styles and scripts are skipped.
std::string MisplacedTag(std::string page) {
  const auto remove = [&](const std::string& begin, const std::string& end) {
    for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;)
      page.erase(at, page.find(end, at) + end.size() - at);
  };
  remove("<!DOCTYPE", ">");
  remove("<!--", "-->");
  remove("<style", "</style>");
  remove("<script", "</script>");
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-zA-Z0-9]+)((?:\\s+[a-zA-Z:-]+=\"[^\"<]*\")*)\\s*(/?)>|<");
  for (std::sregex_iterator match(page.begin(), page.end(), tag), end; match != end; ++match) {
    const std::string name = (*match)[2];
    if (name.empty()) return page.substr(static_cast<std::size_t>(match->position()), 60);
    if ((*match)[1].length() == 0) {
      if ((*match)[4].length() == 0) open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return match->str();
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

TEST(ReportTest, EveryTagIsClosedAndEveryAttributeQuoted) {
  const Floor floor(20);
  EXPECT_EQ(MisplacedTag(Write(FullReport(floor))), "");
}

TEST(ReportTest, AnEmptyRunGivesAPageThatSaysSo) {
  const std::string page = Write({});
  EXPECT_EQ(MisplacedTag(page), "");
  EXPECT_THAT(page, HasSubstr("No object was found"));
  EXPECT_THAT(page, HasSubstr("There are no pictures of keyframes"));
  EXPECT_EQ(SceneOf(page).at("points"), 0);
}

TEST(ReportTest, TextsCannotBecomeMarkup) {
  const std::string evil = "</script><img src=x onerror=\"alert('1')\">&\x01\xFF{{points}}";
  const Floor floor(5);
  ReportData data = FullReport(floor);
  data.title = data.program = data.settings_text = evil;
  data.highlights = data.facts = data.options = data.speed.facts = {{evil, evil}};
  data.speed.highlight = ReportFact{evil, evil};
  data.notes = {evil};
  data.accuracy->facts = {{evil, evil}};
  data.map.classes[0].name = evil;
  const std::string page = Write(data);
  EXPECT_EQ(MisplacedTag(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, Not(HasSubstr("\x01")));
  EXPECT_THAT(page, Not(HasSubstr("\xFF")));
  EXPECT_THAT(SceneOf(page).at("classes").at(0).at("name").get<std::string>(),
              HasSubstr("</script><img src=x onerror=\"alert('1')\">"));
}

TEST(ReportTest, NothingIsLoadedFromAnywhere) {
  const Floor floor(20);
  const std::string page = Write(FullReport(floor));
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!data:|#)")));
  EXPECT_THAT(page, Not(HasSubstr("http:")));
  EXPECT_THAT(page, Not(HasSubstr("https:")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
}

TEST(ReportTest, TheSameDataGiveTheSameBytes) {
  const Floor floor(50);
  const ReportOptions thinned{.max_points = 500};
  EXPECT_EQ(Write(FullReport(floor), thinned), Write(FullReport(floor), thinned));
}

TEST(ReportTest, ALargeMapIsThinnedToTheLimit) {
  const Floor floor(100);
  const std::string page = Write(FullReport(floor), {.max_points = 1000});
  const int num_points = SceneOf(page).at("points");
  EXPECT_LE(num_points, 1000);
  EXPECT_GE(num_points, 400);
  EXPECT_EQ(ElementText(page, "points").size(), (16 * num_points + 2) / 3 * 4);
}

TEST(ReportTest, TheFileStaysBelowItsLimit) {
  const Floor floor(150);
  const std::string page = Write(FullReport(floor), {.max_bytes = 250'000});
  EXPECT_LE(page.size(), 250'000U);
  EXPECT_GT(SceneOf(page).at("points"), 1000);
}

TEST(ReportTest, AMillionPointsAreThinnedAndFitTheFileSoon) {
  const Floor floor(1000);
  const ReportData report = FullReport(floor);
  const Stopwatch stopwatch;
  const std::string page = Write(report);
  if (!testing::kSanitized) {
    EXPECT_LT(stopwatch.Seconds(), 3);
  }
  EXPECT_LT(page.size(), 15'000'000U);
  EXPECT_LE(SceneOf(page).at("points"), 300'000);
  EXPECT_GT(SceneOf(page).at("points"), 150'000);
}

TEST(ReportTest, PointsWithoutAPlaceAreLeftOut) {
  Floor floor(10);
  floor.positions[3].x() = std::numeric_limits<float>::quiet_NaN();
  floor.positions[5].z() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(SceneOf(Write(FullReport(floor))).at("points"), 98);
}

TEST(ReportTest, PointsThatAreAllInOnePlaceAreThinnedToo) {
  Floor floor(40);
  for (Eigen::Vector3f& p : floor.positions) p = {1, 2, 3};
  EXPECT_LE(SceneOf(Write(FullReport(floor), {.max_points = 100})).at("points"), 100);
}

TEST(ReportTest, UpIsTheNormalOfTheFloor) {
  const Floor floor(20);
  const auto up = SceneOf(Write(FullReport(floor))).at("up");
  EXPECT_NEAR(up.at(1), -1.0, 1e-3);
}

TEST(ReportTest, ObjectsAndKeyframesHavePictures) {
  const Floor floor(20);
  const std::string page = Write(FullReport(floor));
  EXPECT_EQ(CountOf(page, "src=\"data:image/jpeg;base64,"), 2);
  EXPECT_THAT(page, HasSubstr("keyboard 0.90"));
  EXPECT_THAT(page, HasSubstr("75 %"));
  EXPECT_TRUE(SceneOf(page).at("objects").at(0).contains("eye"));
}

TEST(ReportTest, DamagedPicturesAreLeftOut) {
  const Floor floor(20);
  ReportData data = FullReport(floor);
  data.keyframes[0].jpeg = "no picture";
  const std::string page = Write(data);
  EXPECT_EQ(MisplacedTag(page), "");
  EXPECT_EQ(CountOf(page, "data:image/jpeg"), 0);
}

TEST(ReportTest, OfManyObjectsTheSurestAreShown) {
  const Floor floor(5);
  ReportData data = FullReport(floor);
  data.map.objects.resize(30, data.map.objects[0]);
  data.map.objects[20].confidence = 0.99;
  const std::string page = Write(data, {.max_objects = 10});
  EXPECT_EQ(CountOf(page, "data-object="), 10 + CountOf(Write({}), "data-object="));
  EXPECT_LT(page.find("99 %"), page.find("75 %"));
  EXPECT_THAT(page, HasSubstr("20 more are in objects.json"));
}

TEST(ReportTest, OfManyKeyframesSomeAreShown) {
  const Floor floor(5);
  ReportData data = FullReport(floor);
  data.keyframes.resize(50, data.keyframes[0]);
  const std::string page = Write(data, {.max_keyframes = 8});
  EXPECT_EQ(CountOf(page, "class=\"keyframe\""), 8);
  EXPECT_THAT(page, HasSubstr("8 of 50 keyframes"));
}

TEST(ReportTest, WithoutTruthThereIsNoErrorPlot) {
  const Floor floor(5);
  ReportData data = FullReport(floor);
  EXPECT_THAT(Write(data), HasSubstr("Distance from the truth"));
  data.accuracy.reset();
  EXPECT_THAT(Write(data), Not(HasSubstr("Distance from the truth")));
}

TEST(ReportTest, AnErrorNamesTheFile) {
  EXPECT_THAT(InputErrorOf([] { WriteReport("/nowhere/report.html", {}); }),
              HasSubstr("/nowhere/report.html"));
}

}  // namespace
}  // namespace semslam

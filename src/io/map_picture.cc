// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/map_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"
#include "semslam/io/level_frame.h"
#include "semslam/io/png_writer.h"
#include "semslam/io/segment_color.h"

#include "io/cloud_columns.h"
#include "io/point_renderer.h"

namespace semslam {
namespace {

const cv::Vec3b kBackground(44, 38, 34);  // BGR, like all of cv.
const cv::Scalar kTextColor(225, 222, 218);
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kTitleHeight = 36;
constexpr int kLegendRowHeight = 26;
constexpr int kGap = 8;

float Luminance(Rgb c) { return 0.299F * c.r + 0.587F * c.g + 0.114F * c.b; }

cv::Vec3b ToBgr(Rgb c, float factor = 1.0F) {
  const auto scale = [&](std::uint8_t value) {
    return cv::saturate_cast<unsigned char>(static_cast<float>(value) * factor);
  };
  return {scale(c.b), scale(c.g), scale(c.r)};
}

cv::Scalar ToScalar(Rgb c) { return {double(c.b), double(c.g), double(c.r)}; }

// What the three panels share: the view of the cloud and how light falls on its points.
class Scene {
 public:
  Scene(const LabelledMapView& map, MapPictureView view, const MapPictureOptions& options)
      : map_(map), supersampling_(options.supersampling), semantic_colors_(SemanticColors(map)) {
    for (const ClassRecord& entry : map.classes) classes_[entry.label] = &entry;
    const std::span<const Eigen::Vector3f> positions = map.cloud.positions;
    const bool has_points = std::any_of(positions.begin(), positions.end(),
                                        [](const auto& p) { return p.allFinite(); });
    if (!has_points) return;
    camera_ = MakeCamera(view, options);
    image_ = RenderPoints(positions, *camera_, map.point_size);
  }

  bool is_empty() const { return !camera_; }

  // A panel in which each point has the colour that the function gives for its index.
  template <typename ColorOfPoint>
  cv::Mat Paint(const MapPictureOptions& options, ColorOfPoint color_of_point) const {
    cv::Mat panel(options.panel_height, options.panel_width, CV_8UC3, kBackground);
    if (is_empty()) return panel;
    cv::Mat large(image_.points.size(), CV_8UC3, kBackground);
    for (int y = 0; y < large.rows; ++y) {
      for (int x = 0; x < large.cols; ++x) {
        const std::int32_t point = image_.points.at<std::int32_t>(y, x);
        if (point == PointImage::kNone) continue;
        const auto [color, light] = color_of_point(static_cast<std::size_t>(point));
        large.at<cv::Vec3b>(y, x) = ToBgr(color, light * image_.lighting.at<float>(y, x));
      }
    }
    cv::resize(large, panel, panel.size(), 0, 0, cv::INTER_AREA);
    return panel;
  }

  std::pair<Rgb, float> PhotoColor(std::size_t point) const {
    return {map_.cloud.colors.empty() ? Rgb{200, 200, 200} : map_.cloud.colors[point], 1.0F};
  }

  std::pair<Rgb, float> SegmentColorOf(std::size_t point) const {
    const std::uint32_t id = map_.cloud.segments.empty() ? 0 : map_.cloud.segments[point];
    return {SegmentColor(id), Shading(point)};
  }

  // Class colours over the brightness of the photo; grey where there is no class.
  std::pair<Rgb, float> ClassColorOf(std::size_t point) const {
    const std::uint32_t label = map_.cloud.labels.empty() ? 0 : map_.cloud.labels[point];
    const bool has_class = label != 0 && classes_.contains(label);
    const float luminance = Luminance(PhotoColor(point).first);
    return {semantic_colors_[point],
            has_class ? Shading(point) * (0.8F + 0.25F * luminance / 255.0F) : 1.0F};
  }

  // In pixels of a panel; nothing behind the camera.
  std::optional<cv::Point2f> ProjectToPanel(const Eigen::Vector3d& p_world) const {
    if (is_empty()) return std::nullopt;
    const Eigen::Vector3f p_camera = camera_->ToCamera(p_world.cast<float>());
    if (!(p_camera.z() > 0.05F)) return std::nullopt;
    const Eigen::Vector2f pixel = camera_->Project(p_camera) / static_cast<float>(supersampling_);
    if (!(pixel.cwiseAbs().maxCoeff() < 1e5F)) return std::nullopt;
    return cv::Point2f(pixel.x(), pixel.y());
  }

  const ClassRecord* FindClass(std::uint32_t label) const {
    const auto entry = classes_.find(label);
    return entry == classes_.end() ? nullptr : entry->second;
  }

 private:
  ViewCamera MakeCamera(MapPictureView view, const MapPictureOptions& options) const {
    const LevelFrame frame = FindLevelFrame(map_);
    const Eigen::Vector3f up = frame.up.cast<float>();
    const Eigen::Vector3f level = frame.forward.cast<float>();
    const int width = options.panel_width * options.supersampling;
    const int height = options.panel_height * options.supersampling;
    if (view == MapPictureView::kTop) {
      constexpr float kNarrow = 0.2F;  // Almost parallel rays.
      return FitCamera(map_.cloud.positions, -up, level, kNarrow, width, height);
    }
    constexpr float kTilt = 0.6F;  // Downwards, rad.
    constexpr float kFieldOfView = 0.75F;
    const Eigen::Vector3f forward = std::cos(kTilt) * level - std::sin(kTilt) * up;
    return FitCamera(map_.cloud.positions, forward, up, kFieldOfView, width, height);
  }

  // A lamp at the camera: faces seen from the side are darker.
  float Shading(std::size_t point) const {
    if (map_.cloud.normals.empty()) return 1.0F;
    const Eigen::Vector3f to_point = (map_.cloud.positions[point] - camera_->p_world).normalized();
    const float cosine = std::abs(map_.cloud.normals[point].dot(to_point));
    return std::isfinite(cosine) ? 0.6F + 0.4F * std::min(cosine, 1.0F) : 1.0F;
  }

  const LabelledMapView& map_;
  int supersampling_;
  std::vector<Rgb> semantic_colors_;
  std::map<std::uint32_t, const ClassRecord*> classes_;
  std::optional<ViewCamera> camera_;
  PointImage image_;
};

void DrawBox(const Scene& scene, const OrientedBox& box, const cv::Scalar& color, cv::Mat& panel) {
  std::vector<std::optional<cv::Point2f>> corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    corners.push_back(scene.ProjectToPanel(box.T_world_box * signs.cwiseProduct(box.half_size)));
  }
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) {
      const auto& a = corners[static_cast<std::size_t>(i)];
      const auto& b = corners[static_cast<std::size_t>(i | bit)];
      if ((i & bit) == 0 && a && b) cv::line(panel, *a, *b, color, 1, cv::LINE_AA);
    }
  }
}

// Writes the names of the objects, on plates, each as near to its place as the others let it.
class NamePlates {
 public:
  explicit NamePlates(cv::Mat& panel) : panel_(panel) {}

  void Draw(const std::string& text, const cv::Point2f& place, const cv::Scalar& color) {
    constexpr double kScale = 0.45;
    constexpr int kMargin = 4;
    int baseline = 0;
    const cv::Size size = cv::getTextSize(text, kFont, kScale, 1, &baseline);
    cv::Rect plate(static_cast<int>(place.x) - size.width / 2 - kMargin,
                   static_cast<int>(place.y) - size.height / 2 - kMargin, size.width + 2 * kMargin,
                   size.height + baseline + 2 * kMargin - 2);
    plate.x = std::clamp(plate.x, 0, std::max(0, panel_.cols - plate.width));
    plate.y = std::clamp(plate.y, 0, std::max(0, panel_.rows - plate.height));
    plate = Free(plate);
    taken_.push_back(plate);
    cv::rectangle(panel_, plate, cv::Scalar(30, 26, 24), cv::FILLED);
    cv::rectangle(panel_, plate, color, 1, cv::LINE_AA);
    cv::putText(panel_, text, {plate.x + kMargin, plate.y + kMargin + size.height}, kFont, kScale,
                kTextColor, 1, cv::LINE_AA);
  }

 private:
  // The plate itself, or moved up or down until it covers no other.
  cv::Rect Free(const cv::Rect& plate) const {
    const auto is_free = [&](const cv::Rect& r) {
      return r.y >= 0 && r.y + r.height <= panel_.rows &&
             std::none_of(taken_.begin(), taken_.end(),
                          [&](const cv::Rect& other) { return (r & other).area() > 0; });
    };
    for (int shift = 0; shift < panel_.rows; shift += 4) {
      for (const int y : {plate.y + shift, plate.y - shift}) {
        const cv::Rect moved(plate.x, y, plate.width, plate.height);
        if (is_free(moved)) return moved;
      }
    }
    return plate;
  }

  cv::Mat& panel_;
  std::vector<cv::Rect> taken_;
};

void DrawObjects(const LabelledMapView& map, const Scene& scene, cv::Mat& panel) {
  NamePlates plates(panel);
  for (const ObjectRecord& object : map.objects) {
    const ClassRecord* entry = scene.FindClass(object.label);
    if (entry != nullptr) DrawBox(scene, object.box, ToScalar(entry->color), panel);
  }
  for (const ObjectRecord& object : map.objects) {
    const ClassRecord* entry = scene.FindClass(object.label);
    const std::optional<cv::Point2f> place = scene.ProjectToPanel(object.centroid);
    const bool is_inside = place && cv::Rect(0, 0, panel.cols, panel.rows).contains(*place);
    if (entry != nullptr && is_inside) plates.Draw(entry->name, *place, ToScalar(entry->color));
  }
}

cv::Mat WithTitle(const cv::Mat& panel, const std::string& title) {
  cv::Mat result(panel.rows + kTitleHeight, panel.cols, CV_8UC3, kBackground);
  panel.copyTo(result(cv::Rect(0, kTitleHeight, panel.cols, panel.rows)));
  cv::putText(result, title, {10, kTitleHeight - 11}, kFont, 0.65, kTextColor, 1, cv::LINE_AA);
  return result;
}

std::string Count(std::size_t number, const std::string& thing) {
  return std::to_string(number) + ' ' + thing + (number == 1 ? "" : "s");
}

std::size_t NumDistinct(std::span<const std::uint32_t> ids) {
  std::set<std::uint32_t> distinct(ids.begin(), ids.end());
  distinct.erase(0);
  return distinct.size();
}

// Colour and name of each class that the map holds, in as many rows as it takes.
cv::Mat DrawLegend(const LabelledMapView& map, int width) {
  const std::set<std::uint32_t> present(map.cloud.labels.begin(), map.cloud.labels.end());
  std::vector<std::pair<std::string, cv::Scalar>> entries;
  for (const ClassRecord& entry : map.classes) {
    if (entry.label == 0 || !present.contains(entry.label)) continue;
    entries.emplace_back(entry.name, ToScalar(entry.color));
  }
  entries.emplace_back(entries.empty() ? "no class found" : "no class", cv::Scalar(128, 128, 128));

  constexpr double kScale = 0.5;
  constexpr int kSwatch = 14;
  constexpr int kMargin = 10;
  std::vector<cv::Point> places;
  cv::Point place(kMargin, kMargin);
  for (const auto& [name, color] : entries) {
    const int entry_width =
        kSwatch + 8 + cv::getTextSize(name, kFont, kScale, 1, nullptr).width + 24;
    if (place.x + entry_width > width && place.x > kMargin) {
      place = {kMargin, place.y + kLegendRowHeight};
    }
    places.push_back(place);
    place.x += entry_width;
  }
  cv::Mat legend(place.y + kLegendRowHeight, width, CV_8UC3, kBackground);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    cv::rectangle(legend, {places[i], cv::Size(kSwatch, kSwatch)}, entries[i].second, cv::FILLED);
    cv::putText(legend, entries[i].first, {places[i].x + kSwatch + 8, places[i].y + kSwatch - 2},
                kFont, kScale, kTextColor, 1, cv::LINE_AA);
  }
  return legend;
}

}  // namespace

void MapPictureOptions::Validate() const {
  constexpr int kMaxSize = 8192;
  const auto is_valid = [](int value, int max) { return value >= 1 && value <= max; };
  if (!is_valid(panel_width, kMaxSize) || !is_valid(panel_height, kMaxSize) ||
      !is_valid(supersampling, 4)) {
    throw std::invalid_argument("panels must be 1 to 8192 pixels, supersampling 1 to 4");
  }
}

cv::Mat DrawMapPicture(const LabelledMapView& map,
                       MapPictureView view,
                       const MapPictureOptions& options) {
  options.Validate();
  CheckLengths(map.cloud);
  SEMSLAM_CHECK(map.point_size > 0) << "point_size = " << map.point_size;
  const Scene scene(map, view, options);
  const cv::Mat photo =
      scene.Paint(options, [&](std::size_t point) { return scene.PhotoColor(point); });
  const cv::Mat segments =
      scene.Paint(options, [&](std::size_t point) { return scene.SegmentColorOf(point); });
  cv::Mat classes =
      scene.Paint(options, [&](std::size_t point) { return scene.ClassColorOf(point); });
  DrawObjects(map, scene, classes);

  const cv::Mat gap(options.panel_height + kTitleHeight, kGap, CV_8UC3, kBackground);
  cv::Mat panels;
  cv::hconcat(
      std::vector<cv::Mat>{
          WithTitle(photo, "colour: " + Count(map.cloud.positions.size(), "point")), gap,
          WithTitle(segments, "geometry: " + Count(NumDistinct(map.cloud.segments), "segment")),
          gap, WithTitle(classes, "semantics: " + Count(map.objects.size(), "object"))},
      panels);
  cv::Mat picture;
  cv::vconcat(panels, DrawLegend(map, panels.cols), picture);
  return picture;
}

void WriteMapPictures(const std::filesystem::path& folder,
                      const LabelledMapView& map,
                      const MapPictureOptions& options) {
  for (const auto& [name, view] :
       {std::pair("semantic_map_top.png", MapPictureView::kTop),
        std::pair("semantic_map_view.png", MapPictureView::kPerspective)}) {
    WritePng(folder / name, DrawMapPicture(map, view, options), PngContent::kFlat);
  }
}

}  // namespace semslam

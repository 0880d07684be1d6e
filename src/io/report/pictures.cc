// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/report/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "semslam/base/parallel.h"
#include "semslam/io/jpeg.h"

namespace semslam {
namespace {

constexpr int kStripWidth = 320;   // Pixels.
constexpr int kObjectWidth = 192;  // Pixels of a 4:3 picture.
constexpr int kObjectHeight = 144;
constexpr int kQuality = 72;

std::string Shrink(const std::string& jpeg, int width) {
  const cv::Mat image = DecodeJpeg(jpeg);
  if (image.empty()) return "";
  cv::Mat small;
  const int height = std::max(1, cvRound(1.0 * image.rows * width / image.cols));
  cv::resize(image, small, {width, height}, 0, 0, cv::INTER_AREA);
  return EncodeJpeg(small, kQuality);
}

// The rectangle around an object's box in a keyframe's recorded image, not clipped. Nothing if part
// of it is behind the camera.
std::optional<ImageBox> ProjectBox(const ObjectRecord& object,
                                   const Rigid3& T_camera_world,
                                   const PinholeCamera& camera) {
  constexpr double kNearest = 0.1;  // Metres.
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Eigen::Vector3d p_camera =
        T_camera_world * (object.box.T_world_box * signs.cwiseProduct(object.box.half_size));
    if (!(p_camera.z() > kNearest)) return std::nullopt;
    const Eigen::Vector2d pixel = camera.Project(p_camera);
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  const Eigen::Vector4f box = (Eigen::Vector4d() << low, high).finished().cast<float>();
  return ImageBox{box[0], box[1], box[2], box[3]};
}

// Of the smaller box, what lies in the other: often only part of an object is in the map.
double ShareOfSmaller(const ImageBox& a, const ImageBox& b) {
  const double ratio = IntersectionOverUnion(a, b);
  const double common = ratio / (1.0 + ratio) * (a.Area() + b.Area());
  return common / std::max(1e-6F, std::min(a.Area(), b.Area()));
}

struct Candidate {
  double rank = 0;
  ObjectView view;
};

// How well the keyframe shows the object: above 1 if it was detected there.
std::optional<Candidate> Assess(const ObjectRecord& object,
                                const ReportKeyframe& keyframe,
                                std::size_t place,
                                const PinholeCamera& camera) {
  const auto projected = ProjectBox(object, keyframe.T_world_camera.Inverse(), camera);
  if (!projected || !(projected->Area() > 1.0F)) return std::nullopt;
  const ImageBox visible = projected->ClippedTo(camera.width(), camera.height());
  const float share =
      std::max(0.0F, visible.width()) * std::max(0.0F, visible.height()) / projected->Area();
  if (!(share > 0.3F)) return std::nullopt;
  const double size = std::sqrt(visible.Area() / (1.0 * camera.width() * camera.height()));
  Candidate best{share * size, {place, visible}};
  for (const Detection& detection : keyframe.detections) {
    if (static_cast<std::uint32_t>(detection.class_id) + 1 != object.label) continue;
    const double overlap = ShareOfSmaller(detection.box, visible);
    const double rank = 1.0 + overlap * detection.score * (0.3 + size);
    if (overlap > 0.6 && rank > best.rank) best = {rank, {place, detection.box}};
  }
  return best;
}

// The object with some of what is around it.
cv::Rect CropAround(const ImageBox& box, const cv::Size& size) {
  constexpr double kMargin = 1.35;
  constexpr double kAspect = 1.0 * kObjectWidth / kObjectHeight;
  constexpr double kSmallest = 24;  // Pixels.
  const double wanted =
      kMargin * std::max<double>({box.width(), kAspect * box.height(), kSmallest});
  const int width = cvRound(std::min({wanted, 1.0 * size.width, kAspect * size.height}));
  const int height = std::clamp(cvRound(width / kAspect), 1, size.height);
  const double center_x = 0.5 * (box.min_x + box.max_x);
  const double center_y = 0.5 * (box.min_y + box.max_y);
  const int left = std::clamp(cvRound(center_x - 0.5 * width), 0, size.width - width);
  const int top = std::clamp(cvRound(center_y - 0.5 * height), 0, size.height - height);
  return {left, top, width, height};
}

std::string CropObject(const cv::Mat& image, const ImageBox& box) {
  cv::Mat picture;
  const cv::Mat part = image(CropAround(box, image.size()));
  const int interpolation = part.cols > kObjectWidth ? cv::INTER_AREA : cv::INTER_CUBIC;
  cv::resize(part, picture, {kObjectWidth, kObjectHeight}, 0, 0, interpolation);
  return EncodeJpeg(picture, kQuality);
}

}  // namespace

std::vector<StripPicture> MakeStrip(const std::vector<ReportKeyframe>& keyframes,
                                    std::size_t max_pictures) {
  std::vector<StripPicture> strip(std::min(keyframes.size(), max_pictures));
  ParallelFor(strip.size(), 1, 0, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      strip[i].keyframe = i * keyframes.size() / strip.size();
      strip[i].jpeg = Shrink(keyframes[strip[i].keyframe].jpeg, kStripWidth);
    }
  });
  std::erase_if(strip, [](const StripPicture& picture) { return picture.jpeg.empty(); });
  return strip;
}

std::vector<ObjectView> FindObjectViews(const ObjectRecord& object,
                                        const std::vector<ReportKeyframe>& keyframes,
                                        const PinholeCamera& camera,
                                        std::size_t max_views) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    if (keyframes[i].jpeg.empty()) continue;
    if (const auto candidate = Assess(object, keyframes[i], i, camera))
      candidates.push_back(*candidate);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.rank > b.rank; });
  std::vector<ObjectView> views;
  for (const Candidate& candidate : candidates) {
    if (views.size() < max_views) views.push_back(candidate.view);
  }
  return views;
}

std::vector<std::optional<ObjectView>> FindObjectViews(const ReportData& data) {
  if (data.keyframes.empty())
    return std::vector<std::optional<ObjectView>>(data.map.objects.size());
  const PinholeCamera camera(data.camera);
  std::vector<std::optional<ObjectView>> best;
  for (const ObjectRecord& object : data.map.objects) {
    const std::vector<ObjectView> views = FindObjectViews(object, data.keyframes, camera, 1);
    best.push_back(views.empty() ? std::nullopt : std::optional(views.front()));
  }
  return best;
}

std::vector<std::string> MakeObjectPictures(const ReportData& data,
                                            const std::vector<std::optional<ObjectView>>& views) {
  // By keyframe: each is decoded once.
  std::map<std::size_t, std::vector<std::size_t>> objects_of_keyframe;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i]) objects_of_keyframe[views[i]->keyframe].push_back(i);
  }
  const std::vector<std::pair<std::size_t, std::vector<std::size_t>>> groups(
      objects_of_keyframe.begin(), objects_of_keyframe.end());
  std::vector<std::string> pictures(views.size());
  ParallelFor(groups.size(), 1, 0, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      const cv::Mat image = DecodeJpeg(data.keyframes[groups[g].first].jpeg);
      if (image.empty()) continue;
      for (const std::size_t i : groups[g].second) pictures[i] = CropObject(image, views[i]->box);
    }
  });
  return pictures;
}

}  // namespace semslam

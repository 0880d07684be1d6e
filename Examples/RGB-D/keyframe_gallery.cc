// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "keyframe_gallery.h"

#include <utility>

#include "semslam/io/jpeg.h"

namespace {

constexpr std::size_t kMaxPictures = 160;  // About 50 kB each.
constexpr int kQuality = 85;               // Of JPEG.

class WatchedDetector : public semslam::Detector {
 public:
  WatchedDetector(std::unique_ptr<semslam::Detector> detector,
                  std::shared_ptr<KeyframeGallery> gallery)
      : detector_(std::move(detector)), gallery_(std::move(gallery)) {}

  std::vector<semslam::Detection> Detect(const semslam::RgbdImage& image) override {
    std::vector<semslam::Detection> detections = detector_->Detect(image);
    gallery_->AddDetections(image.time, detections);
    return detections;
  }
  const semslam::ClassTable& classes() const override { return detector_->classes(); }

 private:
  std::unique_ptr<semslam::Detector> detector_;
  std::shared_ptr<KeyframeGallery> gallery_;
};

}  // namespace

void KeyframeGallery::Add(const semslam::RgbdImage& keyframe) {
  const bool is_wanted =
      content_.Write([](Content& content) { return content.num_added++ % content.step == 0; });
  if (!is_wanted) return;
  std::string jpeg = semslam::EncodeJpeg(keyframe.color, kQuality);
  content_.Write([&](Content& content) {
    content.jpegs.emplace(keyframe.time, std::move(jpeg));
    if (content.jpegs.size() <= kMaxPictures) return;
    content.step *= 2;
    bool is_odd = true;
    std::erase_if(content.jpegs, [&](const auto&) { return is_odd = !is_odd; });
  });
}

void KeyframeGallery::AddDetections(semslam::TimeNs time,
                                    std::vector<semslam::Detection> detections) {
  for (semslam::Detection& detection : detections) detection.class_scores.clear();
  content_.Write(
      [&](Content& content) { content.detections.insert_or_assign(time, std::move(detections)); });
}

std::map<semslam::TimeNs, KeyframeGallery::Picture> KeyframeGallery::Copy() const {
  return content_.Read([](const Content& content) {
    std::map<semslam::TimeNs, Picture> pictures;
    for (const auto& [time, jpeg] : content.jpegs) {
      const auto found = content.detections.find(time);
      pictures[time] = {jpeg, {}};
      if (found != content.detections.end()) pictures[time].detections = found->second;
    }
    return pictures;
  });
}

std::unique_ptr<semslam::Detector> Watch(std::unique_ptr<semslam::Detector> detector,
                                         std::shared_ptr<KeyframeGallery> gallery) {
  if (detector == nullptr) return nullptr;
  return std::make_unique<WatchedDetector>(std::move(detector), std::move(gallery));
}

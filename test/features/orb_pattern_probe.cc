// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/orb_pattern_probe.h"

#include <array>
#include <cstdint>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"
#include "semslam/base/random.h"

namespace semslam {
namespace {

constexpr int kReach = 15;  // Compared pixels lie within +-15 of the keypoint.
constexpr int kSide = 2 * kReach + 1;
constexpr int kNumPositions = kSide * kSide;
constexpr int kNumBits = 256;

// What was seen around one keypoint: the blurred patch, row by row, and the descriptor.
struct Observation {
  std::array<std::uint8_t, kNumPositions> patch;
  std::array<std::uint8_t, kNumBits / 8> descriptor;
};

std::vector<Observation> Observe() {
  constexpr int kSpacing = 41;
  constexpr int kPerSide = 14;
  cv::Mat image(kSpacing * (kPerSide + 2), kSpacing * (kPerSide + 2), CV_8UC1);
  Random random(1);
  for (std::uint8_t& pixel : cv::Mat_<std::uint8_t>(image)) {
    pixel = static_cast<std::uint8_t>(random.Index(256));
  }
  std::vector<cv::KeyPoint> keypoints;
  for (int i = 0; i < kPerSide * kPerSide; ++i) {
    const int x = kSpacing * (1 + i % kPerSide) + kSpacing / 2;
    const int y = kSpacing * (1 + i / kPerSide) + kSpacing / 2;
    keypoints.emplace_back(static_cast<float>(x), static_cast<float>(y), 31.0F, 0.0F, 1.0F, 0);
  }
  cv::Mat descriptors;
  cv::ORB::create(500, 1.2F, 1)->compute(image, keypoints, descriptors);
  const cv::Mat blurred = BlurAsOrbDoes(image);

  std::vector<Observation> observations(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const cv::Point corner(static_cast<int>(keypoints[i].pt.x) - kReach,
                           static_cast<int>(keypoints[i].pt.y) - kReach);
    for (int p = 0; p < kNumPositions; ++p) {
      observations[i].patch[p] =
          blurred.at<std::uint8_t>(corner.y + p / kSide, corner.x + p % kSide);
    }
    std::copy_n(descriptors.ptr<std::uint8_t>(static_cast<int>(i)), kNumBits / 8,
                observations[i].descriptor.begin());
  }
  return observations;
}

BriefPair RecoverPair(const std::vector<Observation>& observations, int bit) {
  struct Candidate {
    std::uint16_t first, second;
  };
  std::vector<Candidate> candidates;
  candidates.reserve(kNumPositions * kNumPositions);
  for (int first = 0; first < kNumPositions; ++first) {
    for (int second = 0; second < kNumPositions; ++second) {
      candidates.push_back({static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(second)});
    }
  }
  for (const Observation& seen : observations) {
    const bool is_set = (seen.descriptor[bit / 8] >> (bit % 8)) & 1;
    std::erase_if(candidates, [&](const Candidate& c) {
      return (seen.patch[c.first] < seen.patch[c.second]) != is_set;
    });
  }
  SEMSLAM_CHECK(candidates.size() == 1) << "bit " << bit << ": " << candidates.size() << " pairs";
  const auto coordinate = [](int value) { return static_cast<std::int8_t>(value - kReach); };
  const Candidate& c = candidates.front();
  return {coordinate(c.first % kSide), coordinate(c.first / kSide), coordinate(c.second % kSide),
          coordinate(c.second / kSide)};
}

}  // namespace

cv::Mat BlurAsOrbDoes(const cv::Mat& image) {
  constexpr int kBorder = 8;
  cv::Mat padded;
  cv::copyMakeBorder(image, padded, kBorder, kBorder, kBorder, kBorder, cv::BORDER_REFLECT_101);
  const cv::Mat inner = padded(cv::Rect(kBorder, kBorder, image.cols, image.rows));
  cv::Mat blurred;
  cv::GaussianBlur(inner, blurred, cv::Size(7, 7), 2, 2, cv::BORDER_REFLECT_101);
  return blurred;
}

std::vector<BriefPair> RecoverOrbPattern() {
  const std::vector<Observation> observations = Observe();
  std::vector<BriefPair> pairs;
  for (int bit = 0; bit < kNumBits; ++bit) pairs.push_back(RecoverPair(observations, bit));
  return pairs;
}

}  // namespace semslam

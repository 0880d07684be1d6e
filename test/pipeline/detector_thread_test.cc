// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/detector_thread.h"

#include <latch>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semslam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The time of an image is the keyframe's number here.
RgbdImagePtr ImageOf(std::uint32_t keyframe) {
  return std::make_shared<const RgbdImage>(
      RgbdImage{keyframe, cv::Mat(2, 3, CV_8UC3, cv::Scalar(1)), cv::Mat(2, 3, CV_32FC1)});
}

// Waits in the first image until it may go on, and throws at the images it is told to.
class FakeDetector : public Detector {
 public:
  struct Gate {
    std::latch reached{1};
    std::latch open{1};
  };
  FakeDetector(Gate* gate, std::set<TimeNs> failing) : gate_(gate), failing_(std::move(failing)) {}

  std::vector<Detection> Detect(const RgbdImage& image) override {
    EXPECT_TRUE(image.depth.empty()) << "the detector's images have no depth";
    EXPECT_EQ(image.color.cols, 3);
    if (Gate* const gate = std::exchange(gate_, nullptr)) {
      gate->reached.count_down();
      gate->open.wait();
    }
    if (failing_.contains(image.time)) {
      throw std::runtime_error("cannot look at " + std::to_string(image.time));
    }
    Detection detection;
    detection.score = static_cast<float>(image.time);
    return {detection};
  }
  const ClassTable& classes() const override { return classes_; }

 private:
  Gate* gate_;
  std::set<TimeNs> failing_;
  ClassTable classes_;
};

class DetectorThreadTest : public ::testing::Test {
 protected:
  void Start(Threading threading, bool with_gate, std::set<TimeNs> failing = {}) {
    thread_.emplace(threading,
                    std::make_unique<FakeDetector>(with_gate ? &gate_ : nullptr, failing),
                    [this](KeyframeId keyframe, std::vector<Detection> detections) {
                      ASSERT_EQ(detections.size(), 1u);
                      EXPECT_EQ(detections[0].score, static_cast<float>(keyframe.value));
                      looked_at_.Write([&](auto& list) { list.push_back(keyframe.value); });
                    });
  }
  bool Submit(std::uint32_t keyframe) {
    return thread_->Submit(KeyframeId{keyframe}, ImageOf(keyframe));
  }
  std::vector<std::uint32_t> LookedAt() const {
    return looked_at_.Read([](const auto& list) { return list; });
  }

  FakeDetector::Gate gate_;
  Guarded<std::vector<std::uint32_t>> looked_at_;
  std::optional<DetectorThread> thread_;
};

TEST_F(DetectorThreadTest, LooksAtTheNewestFirstAndFinishWorksOffTheRest) {
  Start(Threading::kWorkers, true);
  ASSERT_TRUE(Submit(1));
  gate_.reached.wait();
  for (const std::uint32_t keyframe : {2, 3, 4}) ASSERT_TRUE(Submit(keyframe));
  EXPECT_EQ(thread_->queue_size(), 3u);
  gate_.open.count_down();
  thread_->Finish();
  EXPECT_THAT(LookedAt(), ElementsAre(1, 4, 3, 2));
  EXPECT_EQ(thread_->statistics().num_done, 4u);
  EXPECT_EQ(thread_->statistics().num_submitted, 4u);
  EXPECT_EQ(thread_->statistics().longest_queue, 3u);
  EXPECT_FALSE(Submit(5)) << "it has finished";
}

// Looks at up to three images together, but not at number 5.
class BatchDetector : public FakeDetector {
 public:
  BatchDetector(Gate* gate, Guarded<std::vector<std::size_t>>* sizes)
      : FakeDetector(gate, {5}), sizes_(sizes) {}

  std::vector<std::vector<Detection>> DetectAll(std::span<const RgbdImage> images) override {
    sizes_->Write([&](auto& sizes) { sizes.push_back(images.size()); });
    return FakeDetector::DetectAll(images);
  }
  std::size_t batch_size() const override { return 3; }

 private:
  Guarded<std::vector<std::size_t>>* sizes_;
};

TEST_F(DetectorThreadTest, LooksAtWaitingImagesTogether) {
  Guarded<std::vector<std::size_t>> sizes;
  DetectorThread thread(Threading::kWorkers, std::make_unique<BatchDetector>(&gate_, &sizes),
                        [this](KeyframeId keyframe, const std::vector<Detection>& detections) {
                          EXPECT_EQ(detections.at(0).score, static_cast<float>(keyframe.value));
                          looked_at_.Write([&](auto& list) { list.push_back(keyframe.value); });
                        });
  ASSERT_TRUE(thread.Submit(KeyframeId{1}, ImageOf(1)));
  gate_.reached.wait();
  for (const std::uint32_t k : {2, 3, 4, 5, 6, 7, 8})
    ASSERT_TRUE(thread.Submit(KeyframeId{k}, ImageOf(k)));
  gate_.open.count_down();
  thread.Finish();
  EXPECT_THAT(sizes.Read([](const auto& list) { return list; }), ElementsAre(3, 3));
  EXPECT_THAT(LookedAt(), ElementsAre(1, 8, 7, 6, 4, 3, 2)) << "5 fails, alone";
  EXPECT_EQ(thread.statistics().num_done, 7U);
  EXPECT_EQ(thread.statistics().num_failed, 1U);
}

TEST_F(DetectorThreadTest, CancelDropsWhatIsQueued) {
  Start(Threading::kWorkers, true);
  ASSERT_TRUE(Submit(1));
  gate_.reached.wait();
  for (const std::uint32_t keyframe : {2, 3, 4}) ASSERT_TRUE(Submit(keyframe));
  std::jthread opener([this] {
    while (Submit(9)) std::this_thread::yield();  // Until it is being cancelled.
    gate_.open.count_down();
  });
  thread_->Cancel();
  EXPECT_THAT(LookedAt(), ElementsAre(1));
}

TEST_F(DetectorThreadTest, AFailureIsCountedAndTheRestGoesOn) {
  for (const Threading threading : {Threading::kInline, Threading::kWorkers}) {
    looked_at_.Write([](auto& list) { list.clear(); });
    Start(threading, false, {2, 3});
    for (const std::uint32_t keyframe : {1, 2, 3, 4}) {
      ASSERT_TRUE(Submit(keyframe));
      while (thread_->queue_size() > 0) std::this_thread::yield();  // In this order.
    }
    thread_->Finish();
    EXPECT_THAT(LookedAt(), ElementsAre(1, 4));
    const DetectorThread::Statistics statistics = thread_->statistics();
    EXPECT_EQ(statistics.num_submitted, 4u);
    EXPECT_EQ(statistics.num_done, 2u);
    EXPECT_EQ(statistics.num_failed, 2u);
    EXPECT_EQ(statistics.first_error, "cannot look at 2");
  }
}

TEST_F(DetectorThreadTest, FinishRethrowsWhatTheSinkThrew) {
  DetectorThread thread(Threading::kWorkers,
                        std::make_unique<FakeDetector>(nullptr, std::set<TimeNs>{}),
                        [](KeyframeId, const std::vector<Detection>&) {
                          throw std::runtime_error("the sink is full");
                        });
  ASSERT_TRUE(thread.Submit(KeyframeId{1}, ImageOf(1)));
  EXPECT_THROW(thread.Finish(), std::runtime_error);
}

TEST_F(DetectorThreadTest, EndsInAnyState) {
  for (int i = 0; i < 20; ++i) {
    Start(Threading::kWorkers, false);
    for (int k = 0; k < i % 4; ++k) Submit(static_cast<std::uint32_t>(k));
    if (i % 3 == 0) thread_->Finish();
    if (i % 3 == 1) thread_->Cancel();
    thread_.reset();
  }
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Recordings in OpenNI2's format, made of the virtual camera and played by OpenNI2's own driver.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"
#include "semslam/live/openni2_source.h"

#include "live/camera_pictures.h"
#include "live/oni_file.h"
#include "live/virtual_camera.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using testing::ExpectShown;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using ::testing::IsEmpty;
using testing::Read;
using testing::ShownPicture;
using testing::TemporaryFolder;
using testing::VirtualCamera;

constexpr std::size_t kNumFrames = 15;  // At most; a busy machine drops some.
constexpr std::size_t kLeastFrames = 5;

class RecordingTest : public ::testing::Test {
 protected:
  // All but one begin with the same recording.
  static void SetUpTestSuite() {
    VirtualCamera camera("");
    const TemporaryFolder folder;
    OpenNi2Source::Options options = camera.Options();
    options.recording = folder.path() / "clip.oni";
    options.duration = FromSeconds(kNumFrames / 30.0);
    {
      OpenNi2Source source(options);
      Read(source);
    }
    recording_ = testing::ReadAll(options.recording);
  }
  static void TearDownTestSuite() { recording_.clear(); }

  const std::string& recording() const { return recording_; }

  OpenNi2Source::Options PlayOptions(VirtualCamera& camera) const {
    OpenNi2Source::Options options = camera.Options();
    options.device = path_.string();
    return options;
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.Write("clip.oni", recording_);

 private:
  static inline std::string recording_;
};

TEST_F(RecordingTest, IsPlayedToTheBitAndToItsEnd) {
  VirtualCamera camera("");
  OpenNi2Source source(PlayOptions(camera));
  const std::vector<RgbdImage> images = Read(source);
  EXPECT_FALSE(source.failure());
  EXPECT_EQ(source.NumFrames(), images.size());
  EXPECT_GE(images.size(), kLeastFrames);
  for (const RgbdImage& image : images) ExpectShown(image, ShownPicture(image));
  EXPECT_THAT(camera.messages(), IsEmpty());
}

TEST_F(RecordingTest, IsPlayedInItsOwnTimeIfAsked) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = PlayOptions(camera);
  options.play_in_real_time = true;
  OpenNi2Source source(options);
  const Stopwatch watch;
  const std::vector<RgbdImage> images = Read(source);
  EXPECT_GE(watch.Seconds(), 0.8 * ToSeconds(images.back().time - images.front().time));
  EXPECT_GE(images.size(), kLeastFrames);
}

TEST_F(RecordingTest, GoesOnInAnotherFileAfterTheCameraWasAway) {
  VirtualCamera camera("unplug 0.3 0.1");
  OpenNi2Source::Options options = camera.Options();
  options.recording = path_;
  options.duration = FromSeconds(1);
  {
    OpenNi2Source source(options);
    Read(source);
  }
  EXPECT_THAT(camera.messages(), ::testing::Contains(HasSubstr("recording goes on in ")));
  options = PlayOptions(camera);
  OpenNi2Source first(options);
  EXPECT_GE(Read(first).size(), 3u);
  options.device = (folder_.path() / "clip_2.oni").string();
  OpenNi2Source second(options);
  EXPECT_GE(Read(second).size(), 3u);
}

void ExpectPlayedAsFarAsItGoes(VirtualCamera& camera, const OpenNi2Source::Options& options) {
  OpenNi2Source source(options);
  const std::vector<RgbdImage> images = Read(source);
  EXPECT_GE(images.size(), kLeastFrames);
  for (const RgbdImage& image : images) ExpectShown(image, ShownPicture(image));
  EXPECT_THAT(source.failure().value_or(""),
              HasSubstr("was cut short: after " + std::to_string(images.size()) + " frames"));
  EXPECT_THAT(camera.messages(), ElementsAre(HasSubstr("cut short, or never ended")));
}

TEST_F(RecordingTest, IsPlayedAsFarAsItGoesIfItWasCutShort) {
  VirtualCamera camera("");
  // OpenNI2 fills the second half with zeros.
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 3);
  const TemporaryFolder copies;
  ::setenv("TMPDIR", copies.path().c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
  ExpectPlayedAsFarAsItGoes(camera, PlayOptions(camera));
  ::unsetenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe)
  EXPECT_TRUE(std::filesystem::is_empty(copies.path()));
}

TEST_F(RecordingTest, IsPlayedAsFarAsItGoesIfItNeverEnded) {
  VirtualCamera camera("");
  std::filesystem::resize_file(path_, recording().size() / 3);
  const UnendedCopy unended(path_);
  OpenNi2Source::Options options = camera.Options();
  options.device = unended.path().string();
  ExpectPlayedAsFarAsItGoes(camera, options);
}

// Where the sixth depth image is in the file.
std::size_t PositionOfDepth(const std::string& recording) {
  // Mark of a record, its type: image, and its stream, the first that was recorded.
  const std::string start("NIR\0\x0a\0\0\0\x01\0\0\0", 12);
  std::size_t position = 0;
  for (int i = 0; i < 6; ++i) position = recording.find(start, position + 1);
  EXPECT_NE(position, std::string::npos);
  return position;
}

TEST_F(RecordingTest, LeavesOutDamagedImagesAndSaysHowMany) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "OpenNI2's own thread crashes on such files when everything is slow";
#endif
  VirtualCamera camera("");
  std::string content = recording();
  // More than an image of each kind takes.
  content.replace(PositionOfDepth(content), 100'000, 100'000, '\0');
  folder_.Write("clip.oni", content);
  OpenNi2Source source(PlayOptions(camera));
  const std::vector<RgbdImage> images = Read(source);
  EXPECT_GE(images.size(), kLeastFrames);
  EXPECT_LT(images.size(), source.NumFrames().value());
  EXPECT_FALSE(source.failure());
  EXPECT_THAT(camera.messages(), ElementsAre(HasSubstr("images that could not be read: ")));
}

TEST_F(RecordingTest, LeavesOutAnImageThatIsTooShort) {
  VirtualCamera camera("");
  std::string content = recording();
  content.replace(PositionOfDepth(content) + 1000, 1000, 1000, '\xff');
  folder_.Write("clip.oni", content);
  OpenNi2Source source(PlayOptions(camera));
  EXPECT_EQ(Read(source).size() + 1, source.NumFrames());
  EXPECT_FALSE(source.failure());
  EXPECT_THAT(camera.messages(), ElementsAre(HasSubstr("images that could not be read: 1")));
}

TEST_F(RecordingTest, OfAnotherSizeIsRefused) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = PlayOptions(camera);
  options.width = 640;
  options.height = 480;
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(options); }),
              HasSubstr("images of 640x480 as the settings say, the recording has 160x120"));
}

TEST_F(RecordingTest, IsRefusedIfNothingIsLeftOfIt) {
  VirtualCamera camera("");
  std::filesystem::resize_file(path_, 50);
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(PlayOptions(camera)); }),
              HasSubstr("nothing of its streams is left"));
}

}  // namespace
}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// A driver of OpenNI2 for a camera that is not there: it plays a clip in real time and has the
// faults that a script tells (script.h). Built as a shared library that OpenNI2 finds in a private
// folder of drivers.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>
#include <opencv2/core.hpp>

#include "formats.h"
#include "pictures.h"
#include "script.h"
#include "world.h"

namespace semslam::testing {
namespace {

constexpr double kFieldOfView = 1.0226;  // Radians, horizontally: 570 pixels at 640.

template <typename T>
OniStatus Answer(const T& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  *size = sizeof(T);
  return ONI_STATUS_OK;
}

class Stream : public oni::driver::StreamBase {
 public:
  Stream(const Script& script, OniSensorType sensor, OniVideoMode mode, std::function<void()> start)
      : script_(script), sensor_(sensor), mode_(mode), start_(std::move(start)) {}

  OniSensorType sensor() const { return sensor_; }

  OniStatus start() override {
    is_running_ = true;
    start_();
    return ONI_STATUS_OK;
  }
  void stop() override {
    is_running_ = false;
    // Waits for the frame that may be on its way.
    const std::lock_guard lock(sending_);
  }

  OniBool isPropertySupported(int property) override {
    switch (property) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      case ONI_STREAM_PROPERTY_STRIDE:
      case ONI_STREAM_PROPERTY_CROPPING:
        return TRUE;
      case ONI_STREAM_PROPERTY_MIRRORING:
        return script_.Refuses("mirroring") ? FALSE : TRUE;
      case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
        return sensor_ == ONI_SENSOR_COLOR && !script_.Refuses("exposure") ? TRUE : FALSE;
      default:
        return FALSE;
    }
  }
  OniStatus getProperty(int property, void* data, int* size) override {
    if (isPropertySupported(property) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
    const float aspect =
        static_cast<float>(mode_.resolutionY) / static_cast<float>(mode_.resolutionX);
    switch (property) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return Answer(mode_, data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return Answer(static_cast<float>(kFieldOfView), data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return Answer(2 * std::atan(std::tan(static_cast<float>(kFieldOfView) / 2) * aspect), data,
                      size);
      case ONI_STREAM_PROPERTY_STRIDE:
        return Answer(mode_.resolutionX * BytesPerPixel(mode_.pixelFormat), data, size);
      case ONI_STREAM_PROPERTY_CROPPING:
        return Answer(OniCropping{}, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return Answer(is_mirrored_, data, size);
      case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
        return Answer(is_automatic_, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }
  OniStatus setProperty(int property, const void* data, int size) override {
    if (isPropertySupported(property) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
    if (property == ONI_STREAM_PROPERTY_MIRRORING && script_.Refuses("unmirroring"))
      return ONI_STATUS_ERROR;
    if (property == ONI_STREAM_PROPERTY_VIDEO_MODE && size == sizeof(mode_)) {
      std::memcpy(&mode_, data, sizeof(mode_));
    } else if (property == ONI_STREAM_PROPERTY_MIRRORING && size == sizeof(is_mirrored_)) {
      std::memcpy(&is_mirrored_, data, sizeof(is_mirrored_));
    } else if (size == sizeof(is_automatic_)) {
      std::memcpy(&is_automatic_, data, sizeof(is_automatic_));
    }
    return ONI_STATUS_OK;
  }
  int getRequiredFrameSize() override { return script_.width * script_.height * 3; }

  // What is wrong with an image.
  struct Flaws {
    bool in_half = false;
    bool as_gray = false;
    bool is_shifted = false;
  };

  // Hands out an image, if the stream runs. `time` in microseconds.
  void Send(const cv::Mat& image, int index, std::uint64_t time, const Flaws& flaws) {
    const std::lock_guard lock(sending_);
    if (!is_running_) return;
    OniFrame* const frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    const int divisor = flaws.in_half ? 2 : 1;
    frame->sensorType = sensor_;
    frame->timestamp = time;
    frame->frameIndex = index;
    frame->videoMode = mode_;
    if (flaws.as_gray) frame->videoMode.pixelFormat = ONI_PIXEL_FORMAT_GRAY8;
    frame->videoMode.resolutionX /= divisor;
    frame->videoMode.resolutionY /= divisor;
    frame->width = frame->videoMode.resolutionX;
    frame->height = frame->videoMode.resolutionY;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = 0;
    frame->cropOriginY = 0;
    frame->stride = frame->width * BytesPerPixel(frame->videoMode.pixelFormat);
    frame->dataSize = frame->stride * frame->height;
    const cv::Mat sent = Encode(Seen(image, flaws.is_shifted), frame->videoMode.pixelFormat);
    std::memcpy(frame->data, sent.data, static_cast<std::size_t>(frame->dataSize));
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

 private:
  // The picture as the stream's properties have it.
  cv::Mat Seen(const cv::Mat& picture, bool is_shifted) const {
    const bool is_dark = sensor_ == ONI_SENSOR_COLOR && is_automatic_ == FALSE;
    const bool is_mirrored = is_mirrored_ == TRUE && !script_.Refuses("mirroring");
    if (!is_shifted && !is_dark && !is_mirrored) return picture;
    cv::Mat seen = picture.clone();
    if (is_shifted) {
      const int width = picture.cols - Script::kParallax;
      seen.setTo(0);
      picture.colRange(0, width).copyTo(seen.colRange(Script::kParallax, picture.cols));
    }
    if (is_dark) seen *= 0.25;
    if (is_mirrored) cv::flip(seen.clone(), seen, 1);
    return seen;
  }

  const Script& script_;
  const OniSensorType sensor_;
  OniVideoMode mode_;
  std::function<void()> start_;
  OniBool is_mirrored_ = TRUE;  // As the real cameras start.
  OniBool is_automatic_ = FALSE;
  std::atomic<bool> is_running_ = false;
  std::mutex sending_;
};

class Device : public oni::driver::DeviceBase {
 public:
  Device(const Script& script,
         const Pictures& pictures,
         World& world,
         const std::atomic<bool>& is_synchronized)
      : script_(script), pictures_(pictures), world_(world), is_synchronized_(is_synchronized) {
    const int divisor = script.Refuses("size") ? 2 : 1;
    for (const int more : {1, 2}) AddModes(script.color_formats, more * divisor, color_modes_);
    AddModes(script.depth_formats, divisor, depth_modes_);
    if (!script.Refuses("color"))
      sensors_.push_back(
          {ONI_SENSOR_COLOR, static_cast<int>(color_modes_.size()), color_modes_.data()});
    if (!script.Refuses("depth"))
      sensors_.push_back(
          {ONI_SENSOR_DEPTH, static_cast<int>(depth_modes_.size()), depth_modes_.data()});
  }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* num_sensors) override {
    *sensors = sensors_.data();
    *num_sensors = static_cast<int>(sensors_.size());
    return ONI_STATUS_OK;
  }

  oni::driver::StreamBase* createStream(OniSensorType sensor) override {
    for (const OniSensorInfo& info : sensors_) {
      if (info.sensorType != sensor) continue;
      auto stream = std::make_shared<Stream>(script_, sensor, info.pSupportedVideoModes[0],
                                             [this] { Start(); });
      const std::lock_guard lock(mutex_);
      streams_.push_back(std::move(stream));
      return streams_.back().get();
    }
    return nullptr;
  }
  void destroyStream(oni::driver::StreamBase* stream) override {
    const std::lock_guard lock(mutex_);
    std::erase_if(streams_, [stream](const auto& each) { return each.get() == stream; });
  }

  OniBool isPropertySupported(int property) override {
    return property == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ? TRUE : FALSE;
  }
  OniStatus getProperty(int property, void* data, int* size) override {
    if (isPropertySupported(property) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
    return Answer(registration_, data, size);
  }
  OniStatus setProperty(int property, const void* data, int size) override {
    if (isPropertySupported(property) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
    if (size != sizeof(registration_)) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(&registration_, data, sizeof(registration_));
    return ONI_STATUS_OK;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override {
    return mode == ONI_IMAGE_REGISTRATION_OFF || !script_.Refuses("registration") ? TRUE : FALSE;
  }

 private:
  void AddModes(const std::vector<std::string>& formats,
                int divisor,
                std::vector<OniVideoMode>& modes) const {
    for (const std::string& format : formats) {
      modes.push_back(
          {FormatByName(format), script_.width / divisor, script_.height / divisor, script_.fps});
    }
  }

  void Start() {
    world_.Start();
    const std::lock_guard lock(mutex_);
    if (!player_.joinable()) {
      player_ = std::jthread([this](const std::stop_token& stop) { Play(stop); });
    }
  }

  std::vector<std::shared_ptr<Stream>> Streams() {
    const std::lock_guard lock(mutex_);
    return streams_;
  }

  void Play(const std::stop_token& stop) {
    const double open_time = world_.Now();
    // What is over is missed, but for the first frame of all.
    std::size_t frame = 0;
    while (frame < pictures_.size() && pictures_.Time(frame) + 0.5 / script_.fps < open_time)
      ++frame;
    for (int index = 1; frame < pictures_.size(); ++frame, ++index) {
      const double time = pictures_.Time(frame) + kStartDelay;
      if (!world_.WaitUntil(time, stop)) return;
      if (script_.IsOn("stall", time) || script_.IsOn("unplug", time)) continue;
      const auto stamp = static_cast<std::uint64_t>(std::llround((time - open_time) * 1e6));
      for (const auto& stream : Streams()) {
        const bool is_color = stream->sensor() == ONI_SENSOR_COLOR;
        if (script_.IsOn(is_color ? "no_color" : "no_depth", time)) continue;
        if (is_color) {
          stream->Send(
              pictures_.Color(frame), index, stamp,
              {.in_half = script_.IsOn("format", time), .as_gray = script_.IsOn("gray", time)});
        } else {
          const std::size_t shown =
              is_synchronized_ ? frame : std::min(frame + 1, pictures_.size() - 1);
          const std::uint64_t late = is_synchronized_ ? 0 : Script::kLateDepth;
          stream->Send(pictures_.Depth(shown), index, stamp + late,
                       {.is_shifted = registration_ == ONI_IMAGE_REGISTRATION_OFF});
        }
      }
    }
  }

  // Both streams are started by then.
  static constexpr double kStartDelay = 0.1;  // Seconds.

  const Script& script_;
  const Pictures& pictures_;
  World& world_;
  const std::atomic<bool>& is_synchronized_;
  std::vector<OniVideoMode> color_modes_;
  std::vector<OniVideoMode> depth_modes_;
  std::vector<OniSensorInfo> sensors_;
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
  std::mutex mutex_;  // Guards the streams and the thread.
  std::vector<std::shared_ptr<Stream>> streams_;
  std::jthread player_;  // Last: ends first.
};

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services)
      : DriverBase(services),
        script_(ReadScript(std::getenv("SEMSLAM_TEST_CAMERA")))  // NOLINT(concurrency-mt-unsafe)
  {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    if (script_.is_absent) return ONI_STATUS_OK;
    const OniDeviceInfo info = Info();
    deviceConnected(&info);
    hotplug_ = std::jthread([this](const std::stop_token& stop) { PlugAndUnplug(stop); });
    return ONI_STATUS_OK;
  }
  void shutdown() override { hotplug_ = {}; }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    const std::string known = Info().uri;
    if (uri == nullptr || uri != known || !is_plugged_ || !script_.lock.empty()) {
      getServices().errorLoggerAppend(
          "Could not open \"%s\": %s", uri,
          script_.lock.empty() ? "no such device" : script_.lock.c_str());
      return nullptr;
    }
    if (!pictures_) pictures_.emplace(script_);
    is_synchronized_ = false;
    return new Device(script_, *pictures_, world_, is_synchronized_);
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void* enableFrameSync(oni::driver::StreamBase** /*streams*/, int /*num_streams*/) override {
    if (script_.Refuses("sync")) return nullptr;
    is_synchronized_ = true;
    return this;
  }
  void disableFrameSync(void* /*group*/) override { is_synchronized_ = false; }

 private:
  // A camera gets a new place on the bus whenever it is plugged in.
  OniDeviceInfo Info() const {
    OniDeviceInfo info{};
    std::snprintf(info.uri, sizeof(info.uri), "clip@%d", num_plugged_.load());
    std::snprintf(info.vendor, sizeof(info.vendor), "semslam");
    std::snprintf(info.name, sizeof(info.name), "Virtual camera");
    info.usbVendorId = 0x1d27;
    info.usbProductId = 0x0601;
    return info;
  }

  void PlugAndUnplug(const std::stop_token& stop) {
    for (const Script::Fault& fault : script_.faults) {
      if (fault.kind != "unplug") continue;
      if (!world_.WaitUntil(fault.begin, stop)) return;
      const OniDeviceInfo before = Info();
      is_plugged_ = false;
      ++num_plugged_;
      deviceDisconnected(&before);
      if (!world_.WaitUntil(fault.end, stop)) return;
      is_plugged_ = true;
      const OniDeviceInfo after = Info();
      deviceConnected(&after);
    }
  }

  const Script script_;
  std::optional<Pictures> pictures_;  // Once somebody looks.
  World world_;
  std::atomic<bool> is_synchronized_ = false;  // There is one camera.
  std::atomic<int> num_plugged_ = 1;
  std::atomic<bool> is_plugged_ = true;
  std::jthread hotplug_;  // Last: ends first.
};

}  // namespace
}  // namespace semslam::testing

ONI_EXPORT_DRIVER(semslam::testing::Driver)

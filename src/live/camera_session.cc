// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/camera_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <vector>

#include <OpenNI.h>

#include "semslam/base/error.h"
#include "semslam/base/guarded.h"
#include "semslam/base/pause.h"
#include "semslam/base/stopwatch.h"
#include "semslam/live/device_list.h"

#include "live/arrivals.h"
#include "live/frame_images.h"
#include "live/oni_file.h"
#include "live/openni_context.h"
#include "live/video_modes.h"

namespace semslam {
namespace {

using openni::STATUS_OK;

const char* Name(StreamKind kind) { return kind == StreamKind::kColor ? "colour" : "depth"; }

CameraIdentity ToIdentity(const openni::DeviceInfo& info) {
  return {.uri = info.getUri(),
          .vendor = info.getVendor(),
          .name = info.getName(),
          .usb_vendor = info.getUsbVendorId(),
          .usb_product = info.getUsbProductId()};
}

std::vector<CameraIdentity> CamerasPluggedIn() {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<CameraIdentity> cameras;
  for (int i = 0; i < infos.getSize(); ++i) cameras.push_back(ToIdentity(infos[i]));
  return cameras;
}

std::string ChooseCamera(const std::string& wanted) {
  const std::vector<CameraIdentity> cameras = CamerasPluggedIn();
  if (cameras.empty()) throw InputError(kNoCameraFound);
  if (wanted.empty()) return cameras.front().uri;
  std::string found;
  for (const CameraIdentity& camera : cameras) {
    if (camera.uri == wanted) return wanted;
    found += (found.empty() ? "" : ", ") + camera.uri;
  }
  throw InputError(wanted + ": no such camera; found " + found);
}

class DisconnectListener : public openni::OpenNI::DeviceDisconnectedListener {
 public:
  DisconnectListener() { openni::OpenNI::addDeviceDisconnectedListener(this); }
  ~DisconnectListener() override { openni::OpenNI::removeDeviceDisconnectedListener(this); }

  // Called in a thread of the driver.
  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    const std::string uri = info->getUri();
    gone_.Write([&uri](std::vector<std::string>& gone) { gone.push_back(uri); });
  }
  bool IsGone(const std::string& uri) const {
    return gone_.Read([&uri](const std::vector<std::string>& gone) {
      return std::find(gone.begin(), gone.end(), uri) != gone.end();
    });
  }

 private:
  Guarded<std::vector<std::string>> gone_;
};

}  // namespace

struct CameraSession::Streams {
  CameraRequest request;
  CameraIdentity identity;
  bool is_file = false;
  OpenNiContext context;
  DisconnectListener disconnects;
  openni::Device device;
  Stopwatch since_open;
  openni::VideoStream color;
  openni::VideoStream depth;
  std::array<Arrivals, 2> arrivals;  // After the streams they watch; by kind.
  openni::Recorder recorder;
  // By kind:
  std::array<int, 2> num_frames{};  // Of a recording; kUnknown if it has no end.
  std::array<int, 2> last_index{};  // Of the images that were read.
  std::array<std::optional<openni::PixelFormat>, 2> formats;  // Of the first image.

  static constexpr int kUnknown = -1;  // As OpenNI2 says.

  ~Streams() {
    recorder.destroy();
    for (Arrivals& each : arrivals) each.Detach();
    color.stop();
    depth.stop();
    color.destroy();
    depth.destroy();
    // The file driver's thread, if closed before it runs, is waited for, 3 s, and killed.
    constexpr double kThreadRuns = 0.1;  // Seconds.
    if (is_file && since_open.Seconds() < kThreadRuns) Pause(kThreadRuns - since_open.Seconds());
    device.close();
  }

  openni::VideoStream& Get(StreamKind kind) { return kind == StreamKind::kColor ? color : depth; }
  Arrivals& ArrivalsOf(StreamKind kind) { return arrivals[static_cast<std::size_t>(kind)]; }
  bool IsReadWhenAsked() const { return is_file && !request.play_in_real_time; }
  std::string Label() const { return is_file ? identity.uri : identity.name + " " + identity.uri; }

  void Open(const std::string& wanted);
  void Create(StreamKind kind, const Notice& notice);
  void SetMode(StreamKind kind, const Notice& notice);
  void Configure(const Notice& notice);
  void Register(const Notice& notice);
  void Start();
  void SetPlayback(const Notice& notice);
  bool HasNoEnd() const { return std::count(num_frames.begin(), num_frames.end(), kUnknown) > 0; }
  void CheckMode(StreamKind kind, const openni::VideoFrameRef& frame);
};

void CameraSession::Streams::Open(const std::string& wanted) {
  is_file = IsOniFile(wanted);
  if (is_file) CheckOniFile(wanted);
  const std::string uri = is_file ? wanted : ChooseCamera(wanted);
  if (device.open(uri.c_str()) != STATUS_OK) {
    const std::string reason = OpenNiReason();
    if (!is_file)
      throw InputError(uri + ": cannot be opened: " + reason + "; " + AdviceFor(reason));
    // Gone as soon as it is open: nothing is left behind, whatever happens.
    const UnendedCopy copy(uri);
    if (device.open(copy.path().c_str()) != STATUS_OK) {
      throw InputError(uri + ": cannot be opened: " + OpenNiReason() +
                       "; the recording is damaged, or was cut short");
    }
  }
  since_open.Restart();
  identity = ToIdentity(device.getDeviceInfo());
  if (is_file) identity.uri = wanted;
}

void CameraSession::Streams::Create(StreamKind kind, const Notice& notice) {
  const openni::SensorType sensor =
      kind == StreamKind::kColor ? openni::SENSOR_COLOR : openni::SENSOR_DEPTH;
  if (!device.hasSensor(sensor)) {
    throw InputError(Label() + ": expected colour and depth, found no " + Name(kind) +
                     (is_file ? " in the recording" : " sensor"));
  }
  if (Get(kind).create(device, sensor) != STATUS_OK) {
    throw InputError(Label() + ": the " + Name(kind) +
                     " stream cannot be opened: " + OpenNiReason());
  }
  if (!is_file) SetMode(kind, notice);
}

void CameraSession::Streams::SetMode(StreamKind kind, const Notice& notice) {
  openni::VideoStream& stream = Get(kind);
  const std::vector<OpenNi2Mode> modes = ToModes(stream.getSensorInfo());
  const auto choice = ChooseMode(modes, kind, request.width, request.height, request.fps);
  const std::string size = std::to_string(request.width) + "x" + std::to_string(request.height);
  if (!choice) {
    std::string offered;
    for (const OpenNi2Mode& mode : modes) offered += (offered.empty() ? "" : "; ") + Describe(mode);
    throw InputError(Label() + ": expected " + Name(kind) + " images of " + size +
                     " as the settings say, the camera offers " + offered);
  }
  const OpenNi2Mode& chosen = modes[*choice];
  const bool is_set =
      stream.setVideoMode(
          stream.getSensorInfo().getSupportedVideoModes()[static_cast<int>(*choice)]) == STATUS_OK;
  const OpenNi2Mode set = ToMode(stream.getVideoMode());
  if (!is_set && Describe(set) != Describe(chosen)) {
    throw InputError(Label() + ": it refused " + Name(kind) + " images of " + Describe(chosen) +
                     ": " + OpenNiReason());
  }
  if (set.fps != request.fps) {
    notice(std::string(Name(kind)) + " images come " + std::to_string(set.fps) +
           " times a second, not " + std::to_string(request.fps) + " as the settings say");
  }
}

void CameraSession::Streams::Register(const Notice& notice) {
  constexpr auto kMode = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  const bool is_registered = device.isImageRegistrationModeSupported(kMode) &&
                             device.setImageRegistrationMode(kMode) == STATUS_OK;
  if (is_registered) return;
  if (!request.accept_unregistered) {
    throw InputError(Label() +
                     ": it cannot register depth to colour, so colours and depths would not be "
                     "those of the same point; --unregistered goes on all the same");
  }
  notice("depth is not registered to colour: edges of things will have the wrong colour or depth");
}

// What a camera may refuse and still be of use.
void CameraSession::Streams::Configure(const Notice& notice) {
  for (const StreamKind kind : {StreamKind::kColor, StreamKind::kDepth}) {
    openni::VideoStream& stream = Get(kind);
    if (stream.setMirroringEnabled(false) != STATUS_OK && stream.getMirroringEnabled()) {
      throw InputError(Label() + ": its " + Name(kind) +
                       " images are mirrored, and it refused to change that: expected as seen");
    }
  }
  Register(notice);
  openni::CameraSettings* const settings = color.getCameraSettings();
  const bool is_exposed = settings != nullptr &&
                          settings->setAutoExposureEnabled(request.auto_exposure) == STATUS_OK &&
                          settings->setAutoWhiteBalanceEnabled(request.auto_exposure) == STATUS_OK;
  if (!is_exposed && !request.auto_exposure)
    notice("exposure and white balance stay as the camera has them: it refused to fix them");
  device.setDepthColorSyncEnabled(true);  // What it says of success is not so: times show it.
}

void CameraSession::Streams::SetPlayback(const Notice& notice) {
  openni::PlaybackControl* const playback = device.getPlaybackControl();
  if (playback == nullptr) throw InputError(Label() + ": expected a recording that can be played");
  playback->setRepeatEnabled(false);
  constexpr float kWhenAsked = -1;
  playback->setSpeed(request.play_in_real_time ? 1 : kWhenAsked);
  for (const StreamKind kind : {StreamKind::kColor, StreamKind::kDepth}) {
    const openni::VideoMode mode = Get(kind).getVideoMode();
    if (mode.getResolutionX() != request.width || mode.getResolutionY() != request.height) {
      throw InputError(Label() + ": expected " + Name(kind) + " images of " +
                       std::to_string(request.width) + "x" + std::to_string(request.height) +
                       " as the settings say, the recording has " + Describe(ToMode(mode)));
    }
    const int count = playback->getNumberOfFrames(Get(kind));
    if (count <= 0 && count != kUnknown)
      throw InputError(Label() + ": expected " + Name(kind) +
                       " images in the recording, found none");
    num_frames[static_cast<std::size_t>(kind)] = count;
  }
  if (HasNoEnd()) notice("the recording was cut short, or never ended: what it has is played");
}

void CameraSession::Streams::Start() {
  for (const StreamKind kind : {StreamKind::kDepth, StreamKind::kColor}) {
    ArrivalsOf(kind).Attach(Get(kind));
    if (Get(kind).start() != STATUS_OK) {
      throw InputError(Label() + ": the " + Name(kind) +
                       " stream cannot be started: " + OpenNiReason());
    }
  }
}

CameraSession::CameraSession(const std::string& device,
                             const CameraRequest& request,
                             const Notice& notice)
    : streams_(std::make_unique<Streams>()) {
  const SmallStacks small_stacks;
  streams_->request = request;
  streams_->Open(device);
  streams_->Create(StreamKind::kDepth, notice);
  streams_->Create(StreamKind::kColor, notice);
  if (streams_->is_file) {
    streams_->SetPlayback(notice);
  } else {
    streams_->Configure(notice);
  }
  streams_->Start();
}

CameraSession::~CameraSession() = default;

// Of the size that was asked for, and in the format of the first one.
void CameraSession::Streams::CheckMode(StreamKind kind, const openni::VideoFrameRef& frame) {
  const openni::PixelFormat format = frame.getVideoMode().getPixelFormat();
  std::optional<openni::PixelFormat>& first_format = formats[static_cast<std::size_t>(kind)];
  if (!first_format) first_format = format;
  const bool is_size = frame.getWidth() == request.width && frame.getHeight() == request.height;
  if (is_size && format == *first_format) return;
  openni::VideoMode expected = frame.getVideoMode();
  expected.setResolution(request.width, request.height);
  expected.setPixelFormat(*first_format);
  throw InputError(std::string("expected ") + Name(kind) + " images of " +
                   Describe(ToMode(expected)) + ", found " +
                   Describe(ToMode(frame.getVideoMode())));
}

std::optional<CameraSession::Arrival> CameraSession::Wait(std::chrono::milliseconds timeout) {
  Streams& streams = *streams_;
  if (streams.disconnects.IsGone(streams.identity.uri))
    throw InputError("the camera was unplugged");
  std::array<openni::VideoStream*, 2> both = {&streams.color, &streams.depth};
  int ready = -1;
  const Stopwatch waiting;
  const openni::Status status = openni::OpenNI::waitForAnyStream(
      both.data(), static_cast<int>(both.size()), &ready, static_cast<int>(timeout.count()));
  if (status == openni::STATUS_TIME_OUT) return std::nullopt;
  constexpr double kWaited = 0.001;  // Seconds; then the image came while we waited for it.
  const bool is_live = !streams.IsReadWhenAsked();
  const bool was_there = is_live && waiting.Seconds() < kWaited;
  openni::VideoFrameRef frame;
  if (status != STATUS_OK || ready < 0 ||
      both[static_cast<std::size_t>(ready)]->readFrame(&frame) != STATUS_OK || !frame.isValid())
    throw InputError("no images can be read: " + OpenNiReason());
  Arrival arrival;
  arrival.kind = ready == 0 ? StreamKind::kColor : StreamKind::kDepth;
  streams.CheckMode(arrival.kind, frame);
  if (was_there) arrival.age = streams.ArrivalsOf(arrival.kind).SecondsSinceLast();
  arrival.image.time_us = static_cast<std::int64_t>(frame.getTimestamp());
  try {
    arrival.image.image = arrival.kind == StreamKind::kColor
                              ? ToColor(frame, streams.request.is_rgb)
                              : ToDepth(frame);
  } catch (const InputError&) {
    if (is_live) throw;
    return std::nullopt;  // Of a recording the next one counts it as missing.
  }
  int& last_index = streams.last_index[static_cast<std::size_t>(arrival.kind)];
  const int num_skipped = frame.getFrameIndex() - last_index - 1;
  const bool could_come = is_live ? was_there && last_index > 0 : true;
  if (could_come && num_skipped > 0) arrival.num_missed = static_cast<std::size_t>(num_skipped);
  last_index = frame.getFrameIndex();
  return arrival;
}

void CameraSession::StartRecording(const std::filesystem::path& path) {
  // A recorder that cannot have its file crashes when it ends.
  if (!std::ofstream(path, std::ios::binary))
    throw InputError(path.string() + ": cannot be recorded to: the file cannot be made");
  const SmallStacks small_stacks;
  openni::Recorder& recorder = streams_->recorder;
  const bool is_started =
      recorder.create(path.c_str()) == STATUS_OK && recorder.attach(streams_->depth) == STATUS_OK &&
      recorder.attach(streams_->color) == STATUS_OK && recorder.start() == STATUS_OK;
  if (!is_started) throw InputError(path.string() + ": cannot be recorded to: " + OpenNiReason());
}

const CameraIdentity& CameraSession::identity() const { return streams_->identity; }

bool CameraSession::is_file() const { return streams_->is_file; }

std::optional<std::size_t> CameraSession::NumFrames() const {
  if (!streams_->is_file || streams_->HasNoEnd()) return std::nullopt;
  return static_cast<std::size_t>(
      *std::min_element(streams_->num_frames.begin(), streams_->num_frames.end()));
}

bool CameraSession::is_at_end() const {
  if (!streams_->is_file || streams_->HasNoEnd()) return false;
  for (std::size_t i = 0; i < streams_->num_frames.size(); ++i) {
    if (streams_->last_index[i] < streams_->num_frames[i]) return false;
  }
  return true;
}

std::string CameraSession::description() const {
  return streams_->Label() + ": colour " + Describe(ToMode(streams_->color.getVideoMode())) +
         "; depth " + Describe(ToMode(streams_->depth.getVideoMode()));
}

std::optional<PinholeCamera::Parameters> CameraSession::NominalIntrinsics() const {
  const double horizontal = streams_->color.getHorizontalFieldOfView();
  const double vertical = streams_->color.getVerticalFieldOfView();
  constexpr double kMax = 3;  // Radians.
  if (!(horizontal > 0 && horizontal < kMax && vertical > 0 && vertical < kMax))
    return std::nullopt;
  PinholeCamera::Parameters camera;
  camera.width = streams_->request.width;
  camera.height = streams_->request.height;
  camera.fx = 0.5 * camera.width / std::tan(0.5 * horizontal);
  camera.fy = 0.5 * camera.height / std::tan(0.5 * vertical);
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

std::optional<std::string> FindAgain(const CameraIdentity& camera) {
  std::optional<std::string> elsewhere;
  for (const CameraIdentity& other : CamerasPluggedIn()) {
    if (other.uri == camera.uri) return camera.uri;
    const bool is_same_kind = other.usb_vendor == camera.usb_vendor &&
                              other.usb_product == camera.usb_product && other.name == camera.name;
    if (is_same_kind && !elsewhere) elsewhere = other.uri;
  }
  return elsewhere;
}

}  // namespace semslam

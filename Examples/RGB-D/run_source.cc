// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_source.h"

#include <algorithm>
#include <array>
#include <string>

#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/jpeg.h"
#include "semslam/io/object_views.h"

#include "format_line.h"
#include "map_view.h"
#include "memory_use.h"
#include "result_files.h"
#include "tracking_words.h"

namespace {

// Names of LiveState's steps; those of no interest beside the others are empty.
constexpr std::array<const char*, LiveState::kNumSteps> kStepNames = {
    "features",     "first pose", "local map",   "",           "triangulation", "fusion",
    "local bundle", "",           "loop search", "full bundle"};

// Keeps a result and the view of it.
struct ShownResult {
  explicit ShownResult(std::shared_ptr<const semslam::PointCloudMapping::Result> shown)
      : result(std::move(shown)), view(*result) {}
  std::shared_ptr<const semslam::PointCloudMapping::Result> result;
  MapView view;
};

// Makes `to` of `from` if that is not what it was made of last.
template <typename From, typename To, typename Make>
std::shared_ptr<const To> MakeOnce(
    semslam::Guarded<std::pair<std::shared_ptr<const From>, std::shared_ptr<const To>>>& made,
    const std::shared_ptr<const From>& from,
    Make make) {
  if (from == nullptr) return nullptr;
  return made.Write([&](auto& pair) {
    if (pair.first != from) pair = {from, make(*from)};
    return pair.second;
  });
}

}  // namespace

RunSource::RunSource(const LiveView::Setup& setup)
    : setup_(setup),
      saver_({.queue_capacity = 1, .is_background = true},
             [this](const ResultPtr& result) { WriteSnapshot(result); }) {}

semslam::PinholeCamera::Parameters RunSource::camera() const { return setup_.settings.camera; }

double RunSource::voxel_size() const { return setup_.settings.voxels.voxel_size; }

std::shared_ptr<const semslam::LiveFrame> RunSource::frame() const {
  return MakeOnce(frame_, setup_.state->tracked(), [](const LiveState::Tracked& tracked) {
    auto frame = std::make_shared<semslam::LiveFrame>();
    frame->number = tracked.number;
    frame->image = tracked.image;
    frame->features = tracked.result.frame;
    frame->shows_landmark = tracked.result.shows_landmark;
    frame->state = StateName(tracked.result.state);
    if (tracked.result.state == semslam::TrackingState::kTracking)
      frame->T_world_camera = tracked.result.T_world_camera;
    return frame;
  });
}

std::vector<semslam::LiveCloud> RunSource::clouds() const {
  const auto clouds = setup_.system->clouds();
  std::vector<semslam::KeyframeId> ids;
  for (const auto& cloud : clouds) ids.push_back(cloud->id());
  const auto poses = setup_.system->KeyframePoses(ids);
  std::vector<semslam::LiveCloud> live;
  for (const auto& cloud : clouds) {
    const auto pose = poses.find(cloud->id());
    if (pose != poses.end()) live.push_back({cloud, pose->second});
  }
  return live;
}

semslam::LiveGraph RunSource::graph() const {
  const semslam::System::Graph graph = setup_.system->graph();
  semslam::LiveGraph live;
  for (const auto& node : graph.keyframes) live.keyframes.push_back(node.T_world_camera);
  live.tree = graph.tree;
  live.covisible = graph.covisible;
  live.loops = graph.loops;
  for (const auto& pose : setup_.system->CameraTrajectory())
    live.trajectory.push_back(pose.T_world_camera.translation);
  return live;
}

RunSource::ResultPtr RunSource::newest_result() const {
  const ResultPtr last = final_result_.Read([](const ResultPtr& result) { return result; });
  return last != nullptr ? last : setup_.system->preview();
}

std::shared_ptr<const semslam::LiveMap> RunSource::map() const {
  const ResultPtr result = newest_result();
  return MakeOnce(map_, result, [&result](const Result&) {
    const auto shown = std::make_shared<const ShownResult>(result);
    return std::make_shared<const semslam::LiveMap>(semslam::LiveMap{shown, shown->view.view()});
  });
}

void RunSource::RequestMap() {
  if (!setup_.state->has_ended()) setup_.system->RequestPreview();
}

std::shared_ptr<const semslam::LiveDetections> RunSource::detections() const {
  return MakeOnce(
      detections_, setup_.state->detected(), [this](const LiveState::Detected& detected) {
        auto live = std::make_shared<semslam::LiveDetections>();
        live->color = detected.color;
        for (const semslam::Detection& detection : detected.detections) {
          const auto& classes = setup_.classes;
          if (detection.class_id < 0 || detection.class_id >= static_cast<int>(classes.size()))
            continue;
          live->boxes.push_back({detection.box,
                                 Line("%s %.0f %%", classes.name(detection.class_id).c_str(),
                                      100.0 * static_cast<double>(detection.score)),
                                 classes.color(detection.class_id)});
        }
        return live;
      });
}

std::vector<semslam::LiveSighting> RunSource::Sightings(const semslam::ObjectRecord& object) const {
  constexpr std::size_t kMaxViews = 6;
  constexpr int kMargin = 24;  // Pixels about the object.
  const auto pictures = setup_.gallery->Copy();
  std::vector<semslam::ReportKeyframe> keyframes;
  for (const auto& pose : setup_.system->KeyframeTrajectory()) {
    const auto picture = pictures.find(pose.time);
    if (picture == pictures.end()) continue;
    keyframes.push_back(
        {pose.time, pose.T_world_camera, picture->second.jpeg, picture->second.detections});
  }
  const semslam::PinholeCamera camera(setup_.settings.camera);
  std::vector<semslam::LiveSighting> sightings;
  for (const auto& view : semslam::FindObjectViews(object, keyframes, camera, kMaxViews)) {
    const cv::Mat image = semslam::DecodeJpeg(keyframes[view.keyframe].jpeg);
    const cv::Rect box(cv::Point(static_cast<int>(view.box.min_x) - kMargin,
                                 static_cast<int>(view.box.min_y) - kMargin),
                       cv::Point(static_cast<int>(view.box.max_x) + kMargin,
                                 static_cast<int>(view.box.max_y) + kMargin));
    const cv::Rect visible = box & cv::Rect({}, image.size());
    if (visible.area() == 0) continue;
    sightings.push_back({image(visible).clone(), Line("keyframe %zu", view.keyframe)});
  }
  return sightings;
}

std::vector<semslam::LiveTiming> RunSource::timings() const {
  const LiveState::StepTimes times = setup_.state->step_times();
  std::vector<semslam::LiveTiming> timings;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (*kStepNames[i] != '\0')
      timings.push_back({kStepNames[i], {times[i].begin(), times[i].end()}});
  }
  return timings;
}

semslam::LiveStatus RunSource::status() const {
  const semslam::System::Status system = setup_.system->status();
  const LiveState& state = *setup_.state;
  semslam::LiveStatus status;
  status.facts = {{"keyframes", std::to_string(system.num_keyframes)},
                  {"landmarks", std::to_string(system.num_landmarks)},
                  {"map points", std::to_string(system.num_voxels)},
                  {"loops closed", std::to_string(system.num_loops)}};
  status.queues = {{"local mapping", system.mapping_queue},
                   {"loop closing", system.loop_queue},
                   {"dense map", system.dense_queue},
                   {"detector", system.detector_queue}};
  status.frames_per_second = state.frames_per_second();
  status.memory_megabytes = CurrentMegabytes();
  status.is_paused = state.is_paused();
  status.is_localization_only = state.is_localization_only();
  status.has_ended = state.has_ended();
  status.message = state.message();
  return status;
}

void RunSource::SetPaused(bool paused) { setup_.state->SetPaused(paused); }
void RunSource::Step() { setup_.state->Step(); }
void RunSource::Reset() { setup_.state->RequestReset(); }
void RunSource::SetLocalizationOnly(bool localization_only) {
  setup_.state->RequestLocalizationOnly(localization_only);
}

void RunSource::Save() {
  const ResultPtr result = newest_result();
  if (result == nullptr) return setup_.state->SetMessage("nothing to save yet");
  const bool is_begun = saver_.TrySubmit(result);
  setup_.state->SetMessage(is_begun ? "saving ..." : "still saving");
}

void RunSource::WriteSnapshot(const ResultPtr& result) {
  const std::filesystem::path folder = setup_.output / "snapshot";
  try {
    semslam::CheckOutputFolder(folder);
    const std::string error = WriteResults(folder, *setup_.system, *result);
    setup_.state->SetMessage(error.empty() ? "saved in " + folder.string() : error);
  } catch (const semslam::InputError& error) {
    setup_.state->SetMessage(error.what());
  }
}

void RunSource::ShowResult(ResultPtr result) {
  final_result_.Write([&](ResultPtr& last) { last = std::move(result); });
}

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/rolling_shutter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "semslam/base/check.h"
#include "semslam/optim/readout_fit.h"

namespace semslam {
namespace {

// Of the filter. An error of the map shows in many features and many frames alike, so that a frame
// tells less than its features would if they erred independently; and what it tells is in part what
// the map was made with, hence the drift: later frames know more.
constexpr double kInitialSigma = 0.02;  // Seconds: nothing is known of a camera at first.
constexpr double kDriftSigma = 0.0002;  // Seconds, each frame.
constexpr double kInformationShare = 0.25;
// An estimate is used once it is so many standard deviations from a global shutter, and until it is
// half as many: with a global shutter nothing is corrected. On rendered clips without rolling
// shutter (desk, rooms; 3000 frames) it came to 4 at most, with the Kinect's it passes 10.
constexpr double kSignificance = 5;

// Retract(Rigid3(), velocity * seconds) * p, but for the third power of an angle that is hundredths
// of a radian: a frame has a thousand features.
Eigen::Vector3d Moved(const Eigen::Vector3d& p, const Vector6d& velocity, double seconds) {
  const Eigen::Vector3d turn = seconds * velocity.head<3>();
  const Eigen::Vector3d turned = turn.cross(p);
  return p + turned + 0.5 * turn.cross(turned) + seconds * velocity.tail<3>();
}

// A feature as seen from the middle row's pose.
Keypoint Corrected(const Keypoint& recorded,
                   double typical_depth,
                   const Vector6d& velocity,
                   double readout_seconds,
                   const PinholeCamera& camera,
                   double baseline_times_fx) {
  const double row = static_cast<double>(recorded.raw_pixel.y()) / camera.height() - 0.5;
  const double depth = recorded.has_depth() ? recorded.depth : typical_depth;
  const Eigen::Vector3d p_row = camera.Unproject(recorded.pixel.cast<double>(), depth);
  const Eigen::Vector3d p_middle = Moved(p_row, velocity, row * readout_seconds);
  Keypoint corrected = recorded;
  if (p_middle.z() <= 0.1 * depth) return corrected;  // Nothing moves so fast.
  corrected.pixel = camera.Project(p_middle).cast<float>();
  if (recorded.has_depth()) {
    corrected.depth = static_cast<float>(p_middle.z());
    corrected.right_x =
        corrected.pixel.x() - static_cast<float>(baseline_times_fx / corrected.depth);
  }
  return corrected;
}

double MeanDepth(const Frame& frame) {
  constexpr double kFar = 100;  // Metres: then only turning matters.
  double sum = 0;
  int count = 0;
  for (const Keypoint& keypoint : frame.keypoints) {
    if (!keypoint.has_depth()) continue;
    sum += keypoint.depth;
    ++count;
  }
  return count > 0 ? sum / count : kFar;
}

}  // namespace

void RollingShutter::Options::Validate() const {
  SEMSLAM_CHECK(!readout_seconds || std::abs(*readout_seconds) <= kMaxReadoutSeconds)
      << *readout_seconds;
}

RollingShutter::RollingShutter(const Options& options,
                               const PinholeCamera& camera,
                               double baseline_times_fx)
    : camera_(camera),
      baseline_times_fx_(baseline_times_fx),
      is_estimated_(!options.readout_seconds),
      readout_seconds_(options.readout_seconds.value_or(0)),
      variance_(kInitialSigma * kInitialSigma) {
  options.Validate();
}

std::shared_ptr<const Frame> RollingShutter::Correct(std::shared_ptr<const Frame> recorded,
                                                     const Vector6d& velocity) const {
  if (readout_seconds_ == 0) return recorded;
  auto corrected = std::make_shared<Frame>(*recorded);
  const double typical_depth = MeanDepth(*recorded);
  for (Keypoint& keypoint : corrected->keypoints) {
    keypoint =
        Corrected(keypoint, typical_depth, velocity, readout_seconds_, camera_, baseline_times_fx_);
  }
  corrected->grid = FeatureGrid(corrected->keypoints, camera_.ideal_bounds());
  return corrected;
}

void RollingShutter::Learn(const Frame& recorded,
                           const TrackedFrame& found,
                           const Vector6d& velocity,
                           const ScaleSpace& scale_space) {
  if (!is_estimated_) return;
  constexpr double kStep = 1e-3;  // Seconds, for the derivative.
  const double typical_depth = MeanDepth(recorded);
  std::vector<ReadoutObservation> observations;
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    if (!found.points[i] || !found.points[i]->landmark) continue;
    const Keypoint& now = found.frame->keypoints[i];
    const Keypoint longer = Corrected(recorded.keypoints[i], typical_depth, velocity,
                                      readout_seconds_ + kStep, camera_, baseline_times_fx_);
    ReadoutObservation& observation = observations.emplace_back();
    observation.point = {
        found.points[i]->p_world,
        {now.pixel.cast<double>(), now.right_x, 1.0 / scale_space.PixelVariance(now.octave)}};
    observation.rate << (longer.pixel - now.pixel).cast<double>() / kStep,
        now.has_depth() ? (longer.right_x - now.right_x) / kStep : 0.0;
  }
  const ReadoutFit fit =
      FitReadout(MakeStereoCamera(camera_, baseline_times_fx_), found.T_world_camera, observations);
  Update(readout_seconds_ + fit.correction, kInformationShare * fit.information);
}

// A Kalman filter of one number.
void RollingShutter::Update(double measured, double information) {
  variance_ += kDriftSigma * kDriftSigma;
  variance_ /= 1 + variance_ * information;
  estimate_ += variance_ * information * (measured - estimate_);
  estimate_ = std::clamp(estimate_, -kMaxReadoutSeconds, kMaxReadoutSeconds);
  const double significance = std::abs(estimate_) / std::sqrt(variance_);
  const bool is_used = significance > (readout_seconds_ != 0 ? 0.5 : 1.0) * kSignificance;
  readout_seconds_ = is_used ? estimate_ : 0;
}

}  // namespace semslam

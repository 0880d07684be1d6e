// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// The read-only side of Map.
#include <algorithm>
#include <bit>
#include <map>

#include "semslam/base/check.h"
#include "semslam/map/map.h"

namespace semslam {
namespace {

// The index of the descriptor with the least median distance to all others: robust against single
// bad views.
std::size_t MostTypical(const std::vector<Descriptor>& descriptors) {
  std::size_t best = 0;
  int best_median = kDescriptorBits + 1;
  std::vector<int> distances(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    for (std::size_t j = 0; j < descriptors.size(); ++j) {
      distances[j] = HammingDistance(descriptors[i], descriptors[j]);
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < best_median) {
      best_median = *middle;
      best = i;
    }
  }
  return best;
}

}  // namespace

const Keyframe* Map::FindKeyframe(KeyframeId id) const {
  return id.value < keyframes_.size() ? keyframes_[id.value].keyframe.get() : nullptr;
}

const Landmark* Map::FindLandmark(LandmarkId id) const {
  return id.value < landmarks_.size() ? landmarks_[id.value].landmark.get() : nullptr;
}

const Keyframe& Map::keyframe(KeyframeId id) const {
  const Keyframe* keyframe = FindKeyframe(id);
  SEMSLAM_CHECK(keyframe != nullptr) << "no keyframe " << id.value;
  return *keyframe;
}

const Landmark& Map::landmark(LandmarkId id) const {
  const Landmark* landmark = FindLandmark(id);
  SEMSLAM_CHECK(landmark != nullptr) << "no landmark " << id.value;
  return *landmark;
}

bool Map::Sees(KeyframeId keyframe_id, LandmarkId landmark_id) const {
  const std::vector<Observation>& observations = landmark(landmark_id).observations;
  return std::any_of(observations.begin(), observations.end(),
                     [&](const Observation& o) { return o.keyframe == keyframe_id; });
}

std::optional<LandmarkId> Map::ResolveLandmark(LandmarkId id) const {
  while (id.value < landmarks_.size()) {
    const LandmarkSlot& slot = landmarks_[id.value];
    if (slot.landmark) return id;
    if (!slot.merged_into) break;
    id = *slot.merged_into;
  }
  return std::nullopt;
}

std::optional<Rigid3> Map::ResolvePose(KeyframeId id) const {
  Rigid3 T_ancestor_camera;
  while (true) {
    SEMSLAM_CHECK(id.value < keyframes_.size()) << "no keyframe " << id.value;
    const KeyframeSlot& slot = keyframes_[id.value];
    if (slot.keyframe) return slot.keyframe->T_world_camera * T_ancestor_camera;
    if (!slot.parent) return std::nullopt;
    T_ancestor_camera = slot.T_parent_camera * T_ancestor_camera;
    id = *slot.parent;
  }
}

std::optional<KeyframeId> Map::NearestKeptAncestor(KeyframeId id) const {
  while (true) {
    SEMSLAM_CHECK(id.value < keyframes_.size()) << "no keyframe " << id.value;
    const KeyframeSlot& slot = keyframes_[id.value];
    if (slot.keyframe) return id;
    if (!slot.parent) return std::nullopt;
    id = *slot.parent;
  }
}

std::optional<KeyframeId> Map::PieceOf(KeyframeId id) const {
  const std::optional<KeyframeId> kept = NearestKeptAncestor(id);
  return kept ? std::optional(keyframe(*kept).piece) : std::nullopt;
}

std::optional<KeyframeId> Map::MainPiece() const {
  std::optional<KeyframeId> main;
  for (const auto& [piece, num_keyframes] : pieces_) {
    if (!main || num_keyframes > pieces_.at(*main)) main = piece;
  }
  return main;
}

std::vector<KeyframeId> Map::KeyframeIds() const {
  std::vector<KeyframeId> ids;
  for (const KeyframeSlot& slot : keyframes_) {
    if (slot.keyframe) ids.push_back(slot.keyframe->id);
  }
  return ids;
}

std::vector<LandmarkId> Map::LandmarkIds() const {
  std::vector<LandmarkId> ids;
  ids.reserve(num_landmarks_);
  for (const LandmarkSlot& slot : landmarks_) {
    if (slot.landmark) ids.push_back(slot.landmark->id);
  }
  return ids;
}

std::vector<KeyframeId> Map::CovisibleKeyframes(KeyframeId id,
                                                int min_shared,
                                                std::size_t max_count) const {
  std::vector<CovisibleKeyframe> sorted = keyframe(id).covisible;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const CovisibleKeyframe& a, const CovisibleKeyframe& b) {
                     return a.num_shared > b.num_shared;
                   });
  std::vector<KeyframeId> ids;
  for (const CovisibleKeyframe& covisible : sorted) {
    if (ids.size() >= max_count || (covisible.num_shared < min_shared && !ids.empty())) break;
    ids.push_back(covisible.id);
  }
  return ids;
}

std::vector<LandmarkId> Map::LandmarksSeenBy(std::span<const KeyframeId> keyframes) const {
  // A bit a landmark: several times faster than sorting, and this is asked under the lock.
  constexpr std::size_t kBits = 64;
  std::vector<std::uint64_t> is_seen(landmarks_.size() / kBits + 1, 0);
  for (const KeyframeId id : keyframes) {
    const Keyframe* keyframe = FindKeyframe(id);
    if (keyframe == nullptr) continue;
    for (const std::optional<LandmarkId> seen : keyframe->landmarks) {
      if (seen) is_seen[seen->value / kBits] |= std::uint64_t{1} << (seen->value % kBits);
    }
  }
  std::vector<LandmarkId> ids;
  for (std::size_t i = 0; i < is_seen.size(); ++i) {
    for (std::uint64_t rest = is_seen[i]; rest != 0; rest &= rest - 1) {
      ids.push_back({static_cast<std::uint32_t>(i * kBits + std::countr_zero(rest))});
    }
  }
  return ids;
}

std::vector<LandmarkCopy> Map::CopyLandmarksSeenBy(std::span<const KeyframeId> keyframes) const {
  const std::vector<LandmarkId> ids = LandmarksSeenBy(keyframes);
  std::vector<LandmarkCopy> copies;
  copies.reserve(ids.size());
  for (const LandmarkId id : ids) copies.push_back({id, landmark(id).appearance});
  return copies;
}

int Map::NumTrackedLandmarks(KeyframeId id, int min_measurements) const {
  int count = 0;
  for (const std::optional<LandmarkId> landmark_id : keyframe(id).landmarks) {
    if (landmark_id && landmark(*landmark_id).num_measurements >= min_measurements) ++count;
  }
  return count;
}

LandmarkAppearance Map::ComputeAppearance(LandmarkId id) const {
  const Landmark& mark = landmark(id);
  LandmarkAppearance appearance = mark.appearance;
  if (mark.observations.empty()) return appearance;

  std::vector<Descriptor> descriptors;
  Eigen::Vector3d direction_sum = Eigen::Vector3d::Zero();
  for (const Observation& observation : mark.observations) {
    const Keyframe& observer = keyframe(observation.keyframe);
    descriptors.push_back(observer.frame->descriptors[observation.feature]);
    direction_sum += (appearance.p_world - observer.T_world_camera.translation).normalized();
  }
  appearance.descriptor = descriptors[MostTypical(descriptors)];
  appearance.view_direction = direction_sum.normalized().cast<float>();
  UpdateDistanceRange(mark, &appearance);
  return appearance;
}

void Map::UpdateDistanceRange(const Landmark& mark, LandmarkAppearance* appearance) const {
  const auto reference =
      std::find_if(mark.observations.begin(), mark.observations.end(),
                   [&](const Observation& o) { return o.keyframe == mark.reference_keyframe; });
  SEMSLAM_CHECK(reference != mark.observations.end()) << "landmark " << mark.id.value;
  const Keyframe& observer = keyframe(reference->keyframe);
  const double distance = (appearance->p_world - observer.T_world_camera.translation).norm();
  const int octave = observer.frame->keypoints[reference->feature].octave;
  // Seen at level l from distance d, it is at level 0 from d * s^l, and at the coarsest from d *
  // s^(l - L + 1).
  appearance->max_distance = static_cast<float>(distance) * scale_space_.PixelSize(octave);
  appearance->min_distance =
      appearance->max_distance / scale_space_.PixelSize(scale_space_.num_levels - 1);
}

void Map::CheckTree(const Keyframe& frame) const {
  if (frame.parent) {
    const Keyframe* parent = FindKeyframe(*frame.parent);
    SEMSLAM_CHECK(parent != nullptr && parent->id < frame.id && parent->piece == frame.piece)
        << "parent " << frame.parent->value << " of keyframe " << frame.id.value;
  } else {
    SEMSLAM_CHECK(frame.starts_piece && frame.piece == frame.id) << "keyframe " << frame.id.value;
  }
  for (const KeyframeId id : frame.loop_partners) {
    const std::vector<KeyframeId>& partners = keyframe(id).loop_partners;
    SEMSLAM_CHECK(std::binary_search(partners.begin(), partners.end(), frame.id))
        << "keyframes " << id.value << " and " << frame.id.value;
  }
}

void Map::CheckConsistency() const {
  std::map<std::pair<KeyframeId, KeyframeId>, int> shared;
  std::size_t num_observations = 0;
  for (const LandmarkSlot& slot : landmarks_) {
    if (!slot.landmark) continue;
    const Landmark& mark = *slot.landmark;
    SEMSLAM_CHECK(!mark.observations.empty())
        << "landmark " << mark.id.value << " is seen by nobody";
    bool has_reference = false;
    for (const Observation& a : mark.observations) {
      SEMSLAM_CHECK(keyframe(a.keyframe).landmarks.at(a.feature) == mark.id)
          << "landmark " << mark.id.value << ", keyframe " << a.keyframe.value;
      has_reference |= a.keyframe == mark.reference_keyframe;
      for (const Observation& b : mark.observations) {
        if (a.keyframe != b.keyframe) ++shared[{a.keyframe, b.keyframe}];
      }
    }
    SEMSLAM_CHECK(has_reference) << "landmark " << mark.id.value;
    num_observations += mark.observations.size();
  }
  std::map<KeyframeId, std::size_t> sizes;
  std::size_t num_back_references = 0;
  std::size_t num_with_words = 0;
  for (const KeyframeSlot& slot : keyframes_) {
    if (!slot.keyframe) continue;
    const Keyframe& frame = *slot.keyframe;
    num_with_words += frame.words ? 1 : 0;
    for (const std::optional<LandmarkId> id : frame.landmarks) num_back_references += id ? 1 : 0;
    CheckTree(frame);
    ++sizes[frame.piece];
    for (const CovisibleKeyframe& covisible : frame.covisible) {
      const auto it = shared.find({frame.id, covisible.id});
      SEMSLAM_CHECK(it != shared.end() && it->second == covisible.num_shared)
          << "keyframes " << frame.id.value << " and " << covisible.id.value;
      shared.erase(it);
    }
  }
  SEMSLAM_CHECK(sizes == pieces_) << sizes.size() << " pieces, known are " << pieces_.size();
  SEMSLAM_CHECK(shared.empty()) << shared.size() << " missing covisibility edges";
  SEMSLAM_CHECK(num_with_words == keyframe_index_.num_keyframes())
      << num_with_words << " keyframes with words, " << keyframe_index_.num_keyframes()
      << " in the index";
  SEMSLAM_CHECK(num_back_references == num_observations)
      << num_back_references << " back references, " << num_observations << " observations";
}

}  // namespace semslam

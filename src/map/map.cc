// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/map/map.h"

#include <algorithm>
#include <utility>

#include "semslam/base/check.h"

namespace semslam {
namespace {

auto FindObservation(const std::vector<Observation>& observations, KeyframeId keyframe) {
  const auto it = std::lower_bound(
      observations.begin(), observations.end(), keyframe,
      [](const Observation& observation, KeyframeId id) { return observation.keyframe < id; });
  return it != observations.end() && it->keyframe == keyframe ? it : observations.end();
}

int NumMeasurements(const Keyframe& keyframe, int feature) {
  return keyframe.frame->keypoints[feature].has_depth() ? 2 : 1;
}

}  // namespace

KeyframeId Map::AddKeyframe(std::shared_ptr<const Frame> frame, const Rigid3& T_world_camera) {
  SEMSLAM_CHECK(frame != nullptr);
  const KeyframeId id{static_cast<std::uint32_t>(keyframes_.size())};
  auto keyframe = std::make_unique<Keyframe>();
  keyframe->id = id;
  keyframe->landmarks.resize(frame->keypoints.size());
  keyframe->frame = std::move(frame);
  keyframe->T_world_camera = T_world_camera;
  keyframe->piece = id;
  keyframe->starts_piece = true;
  pieces_[id] = 1;
  keyframes_.push_back({std::move(keyframe), {}, {}});
  ++num_keyframes_;
  ++version_;
  return id;
}

LandmarkId Map::AddLandmark(const Eigen::Vector3d& p_world, const Observation& first) {
  const LandmarkId id{static_cast<std::uint32_t>(landmarks_.size())};
  auto landmark = std::make_unique<Landmark>();
  landmark->id = id;
  landmark->appearance.p_world = p_world;
  landmark->reference_keyframe = first.keyframe;
  landmark->first_keyframe = first.keyframe;
  Link(*landmark, first);
  landmarks_.push_back({std::move(landmark), std::nullopt});
  ++num_landmarks_;
  landmarks_.back().landmark->appearance = ComputeAppearance(id);
  ++version_;
  return id;
}

void Map::AddObservation(LandmarkId landmark, const Observation& observation) {
  Link(MutableLandmark(landmark), observation);
  ++version_;
}

void Map::Link(Landmark& landmark, const Observation& observation) {
  Keyframe& keyframe = MutableKeyframe(observation.keyframe);
  std::optional<LandmarkId>& slot = keyframe.landmarks.at(observation.feature);
  SEMSLAM_CHECK(!slot) << "feature " << observation.feature << " of keyframe " << keyframe.id.value
                       << " is taken";
  const auto position = std::lower_bound(
      landmark.observations.begin(), landmark.observations.end(), observation.keyframe,
      [](const Observation& o, KeyframeId id) { return o.keyframe < id; });
  SEMSLAM_CHECK(position == landmark.observations.end() ||
                position->keyframe != observation.keyframe)
      << "keyframe " << keyframe.id.value << " sees landmark " << landmark.id.value << " already";
  for (const Observation& other : landmark.observations) {
    ChangeSharedCount(other.keyframe, observation.keyframe, 1);
  }
  slot = landmark.id;
  landmark.num_measurements += NumMeasurements(keyframe, observation.feature);
  landmark.observations.insert(position, observation);
}

void Map::Unlink(Landmark& landmark, std::size_t index) {
  const Observation removed = landmark.observations[index];
  landmark.observations.erase(landmark.observations.begin() + static_cast<std::ptrdiff_t>(index));
  Keyframe& keyframe = MutableKeyframe(removed.keyframe);
  keyframe.landmarks[removed.feature].reset();
  landmark.num_measurements -= NumMeasurements(keyframe, removed.feature);
  for (const Observation& other : landmark.observations) {
    ChangeSharedCount(other.keyframe, removed.keyframe, -1);
  }
  if (landmark.reference_keyframe == removed.keyframe && !landmark.observations.empty()) {
    landmark.reference_keyframe = landmark.observations.front().keyframe;
  }
}

void Map::ChangeSharedCount(KeyframeId a, KeyframeId b, int change) {
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    std::vector<CovisibleKeyframe>& covisible = MutableKeyframe(from).covisible;
    const auto it =
        std::lower_bound(covisible.begin(), covisible.end(), to,
                         [](const CovisibleKeyframe& c, KeyframeId id) { return c.id < id; });
    if (it == covisible.end() || it->id != to) {
      SEMSLAM_CHECK(change > 0) << "keyframes " << from.value << " and " << to.value;
      covisible.insert(it, {to, change});
    } else if ((it->num_shared += change) == 0) {
      covisible.erase(it);
    }
  }
}

void Map::ChooseParent(KeyframeId id, std::optional<KeyframeId> otherwise) {
  Keyframe& keyframe = MutableKeyframe(id);
  const bool is_new = !keyframe.parent;
  const CovisibleKeyframe* best = nullptr;
  for (const CovisibleKeyframe& candidate : keyframe.covisible) {
    // Only older keyframes, so that the tree can have no cycle; the newest of equals.
    if (candidate.id < id && (best == nullptr || candidate.num_shared >= best->num_shared)) {
      best = &candidate;
    }
  }
  if (best != nullptr) {
    keyframe.parent = best->id;
  } else if (otherwise) {
    SEMSLAM_CHECK(*otherwise < id && FindKeyframe(*otherwise) != nullptr)
        << "keyframe " << otherwise->value << " below keyframe " << id.value;
    keyframe.parent = otherwise;
  } else {
    keyframe.parent.reset();
    for (std::uint32_t i = id.value; i-- > 0 && !keyframe.parent;) {
      if (keyframes_[i].keyframe) keyframe.parent = KeyframeId{i};
    }
  }
  if (keyframe.parent) {
    if (best != nullptr || is_new) keyframe.starts_piece = false;
    MoveToPiece(keyframe, MutableKeyframe(*keyframe.parent).piece);
  }
  ++version_;
}

void Map::MoveToPiece(Keyframe& keyframe, KeyframeId piece) {
  if (keyframe.piece == piece) return;
  if (--pieces_.at(keyframe.piece) == 0) pieces_.erase(keyframe.piece);
  keyframe.piece = piece;
  ++pieces_[piece];
}

void Map::JoinPieces(KeyframeId kept, KeyframeId joined) {
  SEMSLAM_CHECK(kept < joined && pieces_.contains(kept) && pieces_.contains(joined))
      << "pieces " << kept.value << " and " << joined.value;
  for (const KeyframeSlot& slot : keyframes_) {
    if (!slot.keyframe) continue;
    Keyframe& keyframe = *slot.keyframe;
    // The newest before the joined ones becomes the parent of their first.
    if (keyframe.piece == kept && keyframe.id < joined)
      MutableKeyframe(joined).parent = keyframe.id;
    if (keyframe.piece == joined) MoveToPiece(keyframe, kept);
  }
  ++version_;
}

void Map::TieByLoop(KeyframeId a, KeyframeId b) {
  SEMSLAM_CHECK(a != b && keyframe(a).piece == keyframe(b).piece) << a.value << " and " << b.value;
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    std::vector<KeyframeId>& partners = MutableKeyframe(from).loop_partners;
    const auto position = std::lower_bound(partners.begin(), partners.end(), to);
    if (position == partners.end() || *position != to) partners.insert(position, to);
  }
  ++version_;
}

void Map::SetPose(KeyframeId keyframe, const Rigid3& T_world_camera) {
  MutableKeyframe(keyframe).T_world_camera = T_world_camera;
  ++version_;
}

void Map::SetPosition(LandmarkId landmark, const Eigen::Vector3d& p_world) {
  MutableLandmark(landmark).appearance.p_world = p_world;
  ++version_;
}

void Map::SetAppearance(LandmarkId landmark, const LandmarkAppearance& appearance) {
  MutableLandmark(landmark).appearance = appearance;
  ++version_;
}

void Map::SetWords(KeyframeId keyframe, std::shared_ptr<const BagOfWords> words) {
  Keyframe& changed = MutableKeyframe(keyframe);
  if (changed.words) keyframe_index_.Erase(keyframe, changed.words->vector);
  changed.words = std::move(words);
  if (changed.words) keyframe_index_.Add(keyframe, changed.words->vector);
  ++version_;
}

void Map::CountSightings(LandmarkId id, int num_visible, int num_found) {
  Landmark& landmark = MutableLandmark(id);
  landmark.num_visible += num_visible;
  landmark.num_found += num_found;
}

void Map::MergeLandmarks(LandmarkId keep_id, LandmarkId drop_id) {
  if (keep_id == drop_id) return;
  Landmark& keep = MutableLandmark(keep_id);
  Landmark& drop = MutableLandmark(drop_id);
  while (!drop.observations.empty()) {
    const Observation moved = drop.observations.back();
    Unlink(drop, drop.observations.size() - 1);
    if (FindObservation(keep.observations, moved.keyframe) == keep.observations.end()) {
      Link(keep, moved);
    }
  }
  keep.num_visible += drop.num_visible;
  keep.num_found += drop.num_found;
  landmarks_[drop_id.value] = {nullptr, keep_id};
  --num_landmarks_;
  ++version_;
}

void Map::RemoveObservation(LandmarkId id, KeyframeId keyframe) {
  Landmark& landmark = MutableLandmark(id);
  const auto it = FindObservation(landmark.observations, keyframe);
  SEMSLAM_CHECK(it != landmark.observations.end())
      << "keyframe " << keyframe.value << " does not see landmark " << id.value;
  Unlink(landmark, static_cast<std::size_t>(it - landmark.observations.begin()));
  ++version_;
  if (landmark.num_measurements <= 2) EraseLandmark(id);
}

void Map::EraseLandmark(LandmarkId id) {
  Landmark& landmark = MutableLandmark(id);
  while (!landmark.observations.empty()) Unlink(landmark, landmark.observations.size() - 1);
  landmarks_[id.value] = {};
  --num_landmarks_;
  ++version_;
}

void Map::EraseKeyframe(KeyframeId id) {
  Keyframe& keyframe = MutableKeyframe(id);
  SEMSLAM_CHECK(!keyframe.is_anchor()) << "keyframe " << id.value << " cannot be erased";
  for (std::size_t feature = 0; feature < keyframe.landmarks.size(); ++feature) {
    if (const std::optional<LandmarkId> landmark = keyframe.landmarks[feature]) {
      RemoveObservation(*landmark, id);
    }
  }
  if (keyframe.words) keyframe_index_.Erase(id, keyframe.words->vector);
  ReparentChildren(keyframe);
  KeyframeSlot& slot = keyframes_[id.value];
  slot.parent = keyframe.parent;
  slot.T_parent_camera =
      MutableKeyframe(*slot.parent).T_world_camera.Inverse() * keyframe.T_world_camera;
  --pieces_.at(keyframe.piece);  // Not the last: the piece's first is an anchor.
  slot.keyframe.reset();
  --num_keyframes_;
  ++version_;
}

void Map::ReparentChildren(const Keyframe& erased) {
  for (std::uint32_t i = erased.id.value + 1; i < keyframes_.size(); ++i) {
    Keyframe* child = keyframes_[i].keyframe.get();
    if (child == nullptr || child->parent != erased.id) continue;
    ChooseParent(child->id, erased.parent);  // The erased one shares no landmark any more.
  }
}

void Map::ErasePiece(KeyframeId piece) {
  SEMSLAM_CHECK(pieces_.contains(piece)) << "no piece " << piece.value;
  for (LandmarkSlot& slot : landmarks_) {
    if (!slot.landmark || keyframe(slot.landmark->reference_keyframe).piece != piece) continue;
    slot = {};
    --num_landmarks_;
  }
  for (KeyframeSlot& slot : keyframes_) {
    if (!slot.keyframe || slot.keyframe->piece != piece) continue;
    const Keyframe& dropped = *slot.keyframe;
    if (dropped.words) keyframe_index_.Erase(dropped.id, dropped.words->vector);
    slot = {};
    --num_keyframes_;
  }
  pieces_.erase(piece);
  ++version_;
  ++epoch_;
}

void Map::Clear() {
  for (KeyframeSlot& slot : keyframes_) slot = {};
  for (LandmarkSlot& slot : landmarks_) slot = {};
  keyframe_index_ = {};
  pieces_.clear();
  num_keyframes_ = 0;
  num_landmarks_ = 0;
  ++version_;
  ++epoch_;
}

Keyframe& Map::MutableKeyframe(KeyframeId id) {
  return const_cast<Keyframe&>(std::as_const(*this).keyframe(id));
}

Landmark& Map::MutableLandmark(LandmarkId id) {
  return const_cast<Landmark&>(std::as_const(*this).landmark(id));
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/base/id.h"
#include "semslam/features/scale_space.h"
#include "semslam/map/keyframe.h"
#include "semslam/map/landmark.h"
#include "semslam/place/keyframe_index.h"

namespace semslam {

// What a loop closure or a bundle adjustment does to the map.
struct MapCorrection {
  // From the old world to the new one, a keyframe. A keyframe that is not listed, because it came
  // after the correction was begun, moves as its parent does; so does the first as nothing.
  std::map<KeyframeId, Rigid3> T_new_old;
  // Landmarks with a place of their own; all others move with their reference keyframe.
  std::vector<std::pair<LandmarkId, Eigen::Vector3d>> p_world;
};

// The sparse map: owns all keyframes and landmarks. Every edit keeps both directions of an
// observation and the covisibility weights in step. Not synchronised itself: threads share it as
// SharedMap below.
//
// It may be in several pieces, of which nobody knows yet how they lie to each other: whoever was
// lost in a new place begins another one (compare Elvira, Tardos, Montiel, "ORBSLAM-Atlas", 2019).
// Within a piece all poses are in one frame, each piece has its own spanning tree, and a landmark
// is seen from one piece only, until JoinPieces.
//
// Look-ups by an id that was erased give null (Find...) or throw std::logic_error (everything
// else).
class Map {
 public:
  explicit Map(ScaleSpace scale_space = {}) : scale_space_(scale_space) {}

  // --- Growing
  KeyframeId AddKeyframe(std::shared_ptr<const Frame> frame, const Rigid3& T_world_camera);
  // A landmark with its first observation, from which its appearance is taken.
  LandmarkId AddLandmark(const Eigen::Vector3d& p_world, const Observation& first);
  // The feature must be free, and the landmark not seen by the keyframe yet.
  void AddObservation(LandmarkId landmark, const Observation& observation);
  // Hangs the keyframe below the older keyframe that shares most landmarks with it; if none shares
  // any, below `otherwise` (older too), or below the keyframe before it. Until then a new keyframe
  // is a piece of its own.
  void ChooseParent(KeyframeId keyframe, std::optional<KeyframeId> otherwise = std::nullopt);

  // --- Changing
  void SetPose(KeyframeId keyframe, const Rigid3& T_world_camera);
  void SetPosition(LandmarkId landmark, const Eigen::Vector3d& p_world);
  void SetAppearance(LandmarkId landmark, const LandmarkAppearance& appearance);
  // Makes room for the words of a vocabulary, so that the first SetWords takes no longer than
  // others.
  void ReserveWords(std::size_t num_words) { keyframe_index_.ReserveWords(num_words); }
  // From now on the keyframe can be found by its words.
  void SetWords(KeyframeId keyframe, std::shared_ptr<const BagOfWords> words);
  void CountSightings(LandmarkId landmark, int num_visible, int num_found);
  // Moves everything at once and begins a new epoch. What is gone meanwhile is skipped.
  void Correct(const MapCorrection& correction);
  // From now on the poses of both pieces are in one frame: first Correct those of `joined`, the
  // younger one.
  void JoinPieces(KeyframeId kept, KeyframeId joined);
  // The two see one place though the spanning tree does not say so.
  void TieByLoop(KeyframeId a, KeyframeId b);

  // --- Shrinking
  // `drop`'s observations go to `keep` where the keyframe does not see `keep` already; `drop` then
  // forwards to `keep`.
  void MergeLandmarks(LandmarkId keep, LandmarkId drop);
  // Erases the landmark too if no more than two measurements are left: they would not say whether
  // it is real.
  void RemoveObservation(LandmarkId landmark, KeyframeId keyframe);
  void EraseLandmark(LandmarkId landmark);
  // Its pose stays known relative to its parent. Landmarks that only it saw are erased. Not an
  // anchor (Keyframe::is_anchor).
  void EraseKeyframe(KeyframeId keyframe);
  // Drops all keyframes and landmarks of a piece, or everything, and begins a new epoch; ids go on
  // counting.
  void ErasePiece(KeyframeId piece);
  void Clear();

  // --- Looking
  const Keyframe* FindKeyframe(KeyframeId id) const;  // Null if erased or unknown.
  const Landmark* FindLandmark(LandmarkId id) const;
  const Keyframe& keyframe(KeyframeId id) const;
  const Landmark& landmark(LandmarkId id) const;
  bool Sees(KeyframeId keyframe, LandmarkId landmark) const;
  // The landmark that this one has become by merging; nothing if it was erased.
  std::optional<LandmarkId> ResolveLandmark(LandmarkId id) const;
  // Pose of a keyframe, also of an erased one; nothing if the map was cleared since.
  std::optional<Rigid3> ResolvePose(KeyframeId id) const;
  // The keyframe, or the one it hung below when it was erased; nothing if it was dropped.
  std::optional<KeyframeId> NearestKeptAncestor(KeyframeId id) const;
  // The piece of a keyframe, also of an erased one; nothing if it was dropped.
  std::optional<KeyframeId> PieceOf(KeyframeId id) const;
  // The pieces and how many keyframes each has.
  const std::map<KeyframeId, std::size_t>& pieces() const { return pieces_; }
  // The one with most keyframes, the oldest of equals; its frame is the world. Nothing if the map
  // is empty.
  std::optional<KeyframeId> MainPiece() const;
  std::vector<KeyframeId> KeyframeIds() const;  // Ascending.
  std::vector<LandmarkId> LandmarkIds() const;  // Ascending.
  // Those sharing at least `min_shared` landmarks, most first (older first among equals),
  // `max_count` at most. If none shares so many, the best one alone.
  std::vector<KeyframeId> CovisibleKeyframes(KeyframeId id,
                                             int min_shared,
                                             std::size_t max_count) const;
  // All that any of these keyframes sees, ascending, each once. Keyframes that are gone see
  // nothing.
  std::vector<LandmarkId> LandmarksSeenBy(std::span<const KeyframeId> keyframes) const;
  std::vector<LandmarkCopy> CopyLandmarksSeenBy(std::span<const KeyframeId> keyframes) const;
  // Landmarks of the keyframe with at least so many measurements.
  int NumTrackedLandmarks(KeyframeId id, int min_measurements) const;
  // The landmark's appearance from all its present observations.
  LandmarkAppearance ComputeAppearance(LandmarkId id) const;

  std::size_t num_keyframes() const { return num_keyframes_; }
  std::size_t num_landmarks() const { return num_landmarks_; }
  const ScaleSpace& scale_space() const { return scale_space_; }
  // The keyframes whose words are known, by word.
  const KeyframeIndex& keyframe_index() const { return keyframe_index_; }
  // Grows with every edit.
  std::uint64_t version() const { return version_; }
  // Changes when the map was moved or cleared as a whole: what was computed from an older epoch is
  // void.
  std::uint64_t epoch() const { return epoch_; }

  // Throws std::logic_error if any cross-reference or weight is out of step. For tests.
  void CheckConsistency() const;

 private:
  friend class MapArchive;  // Writes and reads it as a file.

  struct KeyframeSlot {
    std::unique_ptr<Keyframe>
        keyframe;  // Null once erased; then the two below hold its place in the tree.
    std::optional<KeyframeId> parent;
    Rigid3 T_parent_camera;
  };
  struct LandmarkSlot {
    std::unique_ptr<Landmark> landmark;
    std::optional<LandmarkId> merged_into;
  };

  Keyframe& MutableKeyframe(KeyframeId id);
  Landmark& MutableLandmark(LandmarkId id);
  void ChangeSharedCount(KeyframeId a, KeyframeId b, int change);
  void Link(Landmark& landmark, const Observation& observation);
  void Unlink(Landmark& landmark, std::size_t index);
  void UpdateDistanceRange(const Landmark& landmark, LandmarkAppearance* appearance) const;
  void ReparentChildren(const Keyframe& erased);
  void MoveToPiece(Keyframe& keyframe, KeyframeId piece);
  void CheckTree(const Keyframe& keyframe) const;
  std::vector<Rigid3> MotionOfKeyframes(const MapCorrection& correction) const;

  ScaleSpace scale_space_;
  std::vector<KeyframeSlot> keyframes_;  // By id.
  std::vector<LandmarkSlot> landmarks_;  // By id.
  KeyframeIndex keyframe_index_;
  std::map<KeyframeId, std::size_t> pieces_;
  std::size_t num_keyframes_ = 0;
  std::size_t num_landmarks_ = 0;
  std::uint64_t version_ = 0;
  std::uint64_t epoch_ = 0;
};

// The map as threads share it.
using SharedMap = Guarded<Map>;

}  // namespace semslam

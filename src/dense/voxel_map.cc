// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/voxel_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/dense/voxel_index.h"

#include "dense/voxel_table.h"

namespace semslam {
namespace {

constexpr double kPositionSteps = 256;  // Within a voxel.
constexpr float kNormalSteps = 127;

// The depth's standard deviation grows with z^2, so its weight falls with z^-4; but the pixels that
// fall into a voxel become fewer with z^-2, so a pixel's own share is z^-2. Slanted views measure
// worse. 64 up to half a metre, 1 at 4 m.
std::uint32_t WeightOf(const KeyframePoint& point) {
  constexpr float kMaxWeight = 64;
  constexpr float kFullWeightDepth = 0.5F;
  const float relative = kFullWeightDepth / point.p_camera.z();
  const float cosine = -point.n_camera.dot(point.p_camera) / point.p_camera.norm();
  const float weight = kMaxWeight * relative * relative * cosine;
  return static_cast<std::uint32_t>(std::clamp(weight + 0.5F, 1.0F, kMaxWeight));
}

struct KeyedSample {
  std::uint64_t key;
  VoxelSample sample;
};

// What a point adds to the map. The same numbers come out whenever it is called with the same
// point and pose: that makes subtracting exact.
class Sampler {
 public:
  Sampler(const Rigid3& T_world_camera, double voxel_size)
      : R_voxel_camera_(T_world_camera.rotation.toRotationMatrix() / voxel_size),
        t_voxel_camera_(T_world_camera.translation / voxel_size),
        R_world_camera_(T_world_camera.rotation.toRotationMatrix().cast<float>()) {}

  // Nothing if the point is out of the key's range.
  std::optional<KeyedSample> operator()(const KeyframePoint& point) const {
    const Eigen::Vector3d p = R_voxel_camera_ * point.p_camera.cast<double>() + t_voxel_camera_;
    const auto voxel = VoxelKey::Coordinates(p, 1.0);
    if (!voxel) return std::nullopt;
    const Eigen::Vector3d offset = (p - voxel->cast<double>()) * kPositionSteps;
    const Eigen::Vector3f normal = R_world_camera_ * point.n_camera * kNormalSteps;
    KeyedSample keyed;
    keyed.key = VoxelKey::Pack(*voxel);
    keyed.sample.weight = WeightOf(point);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      keyed.sample.position[i] = std::min(static_cast<std::int32_t>(offset[axis]), 255);
      keyed.sample.normal[i] = static_cast<std::int32_t>(std::lrint(normal[axis]));
    }
    keyed.sample.color = {point.color.r, point.color.g, point.color.b};
    return keyed;
  }

 private:
  Eigen::Matrix3d R_voxel_camera_;  // Scaled to voxels.
  Eigen::Vector3d t_voxel_camera_;
  Eigen::Matrix3f R_world_camera_;
};

Eigen::Vector3i CoordinatesOf(std::uint64_t key) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  const auto coordinate = [](std::uint64_t bits) {
    return static_cast<int>(static_cast<std::int64_t>(bits & kMask) - VoxelKey::kLimit);
  };
  return {coordinate(key >> 42), coordinate(key >> 21), coordinate(key)};
}

bool IsSeenWell(const Voxel& voxel, const VoxelMap::Options& options) {
  return voxel.num_views >= options.min_views &&
         static_cast<float>(voxel.weight) >= options.min_weight;
}

void Reserve(MapCloud& cloud, std::size_t num_points) {
  cloud.positions.reserve(num_points);
  cloud.normals.reserve(num_points);
  cloud.colors.reserve(num_points);
  cloud.weights.reserve(num_points);
  cloud.num_views.reserve(num_points);
}

void AppendTo(MapCloud& cloud, const Voxel& voxel) {
  const double weight = voxel.weight;
  Eigen::Vector3d offset;
  Eigen::Vector3f normal;
  std::array<std::uint8_t, 3> color{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    offset[axis] = (voxel.position[i] / weight + 0.5) / kPositionSteps;  // Samples were cut, not
                                                                         // rounded.
    normal[axis] = static_cast<float>(static_cast<std::int32_t>(voxel.normal[i]));
    color[i] = static_cast<std::uint8_t>(std::lround(voxel.color[i] / weight));
  }
  const Eigen::Vector3d p_voxel = CoordinatesOf(voxel.key()).cast<double>() + offset;
  cloud.positions.emplace_back((p_voxel * cloud.voxel_size).cast<float>());
  // Views from opposite sides can cancel: then any direction is as good.
  const float length = normal.norm();
  cloud.normals.push_back(length > 0 ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ());
  cloud.colors.push_back({color[0], color[1], color[2]});
  cloud.weights.push_back(static_cast<float>(weight));
  cloud.num_views.push_back(voxel.num_views);
}

}  // namespace

void VoxelMap::Options::Validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(std::string("voxel map: ") + what);
  };
  require(voxel_size >= 0.001 && voxel_size <= 1, "expected 0.001 <= voxel_size <= 1 (metres)");
  require(max_shift >= 0 && max_shift <= 100, "expected 0 <= max_shift <= 100 (voxels)");
  require(min_weight >= 0, "expected min_weight >= 0");
  require(max_voxels >= 1 && max_voxels < 0xffffffffU, "expected 1 <= max_voxels < 2^32 - 1");
}

VoxelMap::VoxelMap(const Options& options)
    : options_(options), table_(std::make_unique<VoxelTable>()) {
  options_.Validate();
}
VoxelMap::~VoxelMap() = default;
VoxelMap::VoxelMap(VoxelMap&&) noexcept = default;
VoxelMap& VoxelMap::operator=(VoxelMap&&) noexcept = default;

void VoxelMap::Integrate(std::shared_ptr<const KeyframeCloud> cloud, const Rigid3& T_world_camera) {
  SEMSLAM_CHECK(cloud != nullptr);
  const KeyframeId id = cloud->id();
  const auto [it, added] = keyframes_.try_emplace(id);
  SEMSLAM_CHECK(added) << "keyframe " << id.value << " is in the map";
  it->second.cloud = std::move(cloud);
  it->second.T_world_camera = T_world_camera;
  Add(it->second);
}

bool VoxelMap::Remove(KeyframeId id) {
  const auto it = keyframes_.find(id);
  if (it == keyframes_.end()) return false;
  Subtract(it->second);
  keyframes_.erase(it);
  CompactIfSparse();
  return true;
}

std::size_t VoxelMap::UpdatePoses(const std::map<KeyframeId, Rigid3>& T_world_camera) {
  return UpdatePoses(T_world_camera, options_.max_shift);
}

std::size_t VoxelMap::UpdatePoses(const std::map<KeyframeId, Rigid3>& T_world_camera,
                                  double max_shift) {
  std::vector<std::pair<Entry*, const Rigid3*>> moved;
  for (const auto& [id, pose] : T_world_camera) {
    const auto it = keyframes_.find(id);
    if (it == keyframes_.end()) continue;
    const bool stays = Shift(it->second, pose) <= max_shift * options_.voxel_size;  // NaN: moves.
    if (!stays) moved.emplace_back(&it->second, &pose);
  }
  // One by one, so that the map never grows by more than one keyframe.
  for (const auto& [entry, pose] : moved) {
    if (records_changes_) RecordMove(*entry, *pose);
    Subtract(*entry);
    entry->T_world_camera = *pose;
    Add(*entry);
  }
  CompactIfSparse();
  return moved.size();
}

MapCloud VoxelMap::Extract() const {
  std::vector<const Voxel*> voxels;
  voxels.reserve(table_->num_voxels());
  table_->ForEach([&](const Voxel& voxel) {
    if (IsSeenWell(voxel, options_)) voxels.push_back(&voxel);
  });
  std::sort(voxels.begin(), voxels.end(),
            [](const Voxel* a, const Voxel* b) { return a->key() < b->key(); });
  MapCloud cloud;
  cloud.voxel_size = options_.voxel_size;
  Reserve(cloud, voxels.size());
  for (const Voxel* voxel : voxels) AppendTo(cloud, *voxel);
  return cloud;
}

MapCloud VoxelMap::Extract(std::span<const std::uint64_t> keys) const {
  MapCloud cloud;
  cloud.voxel_size = options_.voxel_size;
  Reserve(cloud, keys.size());
  const bool may_prefetch = table_->num_voxels() > 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    constexpr std::size_t kAhead = 8;  // The map is far larger than a cache.
    if (may_prefetch && i + 2 * kAhead < keys.size()) {
      table_->PrefetchSlot(keys[i + 2 * kAhead]);
      table_->PrefetchVoxel(keys[i + kAhead]);
    }
    const Voxel* voxel = table_->Find(keys[i]);
    if (voxel != nullptr && voxel->weight != 0) {
      AppendTo(cloud, *voxel);
      if (IsSeenWell(*voxel, options_)) continue;
    } else {
      cloud.positions.emplace_back();
      cloud.normals.push_back(Eigen::Vector3f::UnitZ());
      cloud.colors.emplace_back();
      cloud.weights.push_back(0);
      cloud.num_views.push_back(0);
    }
    cloud.positions.back().setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return cloud;
}

void VoxelMap::RecordChanges() {
  records_changes_ = true;
  table_->ForEach([this](const Voxel& voxel) { Record(voxel.key()); });
}

void VoxelMap::Record(std::uint64_t key) {
  if (records_changes_) changed_.push_back(table_->NumberOf(key));
}

// Of voxels that went and came back nothing is told.
void VoxelMap::FindChanges() {
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    constexpr std::size_t kAhead = 16;  // The map is far larger than a cache.
    if (i + kAhead < changed_.size()) table_->Prefetch(changed_[i + kAhead]);
    Voxel& voxel = table_->At(changed_[i]);
    const bool is_there = voxel.weight != 0;
    if (is_there == voxel.is_told()) continue;
    voxel.ToggleTold();
    (is_there ? changes_.appeared : changes_.vanished).push_back(voxel.key());
  }
  changed_.clear();
}

VoxelMap::Changes VoxelMap::TakeChanges() {
  FindChanges();
  return std::exchange(changes_, {});
}

void VoxelMap::CompactIfSparse() {
  if (!table_->IsSparse()) return;
  FindChanges();
  table_->Compact();
}

std::size_t VoxelMap::num_voxels() const { return table_->num_voxels(); }

std::size_t VoxelMap::num_refused_points() const {
  std::size_t num_refused = 0;
  for (const auto& [id, entry] : keyframes_) num_refused += entry.num_refused;
  return num_refused;
}

std::size_t VoxelMap::memory_bytes() const { return table_->memory_bytes(); }

void VoxelMap::Add(Entry& entry) {
  entry.refused.clear();
  entry.num_refused = 0;
  const Sampler sample_of(entry.T_world_camera, options_.voxel_size);
  const std::uint16_t pass = table_->BeginPass();
  std::size_t index = 0;
  entry.cloud->ForEach([&](const KeyframePoint& point) {
    const std::size_t i = index++;
    const auto keyed = sample_of(point);
    if (!keyed) return;
    Voxel* voxel = table_->FindOrCreate(keyed->key, options_.max_voxels);
    if (voxel == nullptr) {
      entry.refused.resize(entry.cloud->num_points());
      entry.refused[i] = true;
      ++entry.num_refused;
      return;
    }
    if (voxel->weight == 0) {
      table_->CountRefilled();
      Record(keyed->key);
    }
    voxel->Add(keyed->sample);
    if (std::exchange(voxel->last_pass, pass) != pass) ++voxel->num_views;
  });
}

void VoxelMap::Subtract(const Entry& entry) {
  const Sampler sample_of(entry.T_world_camera, options_.voxel_size);
  const std::uint16_t pass = table_->BeginPass();
  std::size_t index = 0;
  entry.cloud->ForEach([&](const KeyframePoint& point) {
    const std::size_t i = index++;
    if (!entry.refused.empty() && entry.refused[i]) return;
    const auto keyed = sample_of(point);
    if (!keyed) return;
    Voxel* voxel = table_->Find(keyed->key);
    SEMSLAM_CHECK(voxel != nullptr) << "a voxel of keyframe " << entry.cloud->id().value;
    voxel->Subtract(keyed->sample);
    if (voxel->weight == 0) {
      table_->CountEmptied();
      Record(keyed->key);
    }
    if (std::exchange(voxel->last_pass, pass) != pass) --voxel->num_views;
  });
}

void VoxelMap::RecordMove(const Entry& entry, const Rigid3& T_world_camera) {
  constexpr std::size_t kStep = 61;  // Points; neighbours go the same way.
  const Sampler before(entry.T_world_camera, options_.voxel_size);
  const Sampler after(T_world_camera, options_.voxel_size);
  std::size_t index = 0;
  entry.cloud->ForEach([&](const KeyframePoint& point) {
    if (index++ % kStep != 0) return;
    const auto from = before(point);
    const auto to = after(point);
    if (from && to && from->key != to->key) changes_.moved.emplace_back(from->key, to->key);
  });
}

double VoxelMap::Shift(const Entry& entry, const Rigid3& T_world_camera) const {
  const double turn = RotationAngle(entry.T_world_camera, T_world_camera);
  const double step = (T_world_camera.translation - entry.T_world_camera.translation).norm();
  return step + turn * static_cast<double>(entry.cloud->max_range());
}

}  // namespace semslam

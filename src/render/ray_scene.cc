// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_scene.h"

#include <algorithm>
#include <array>

#include <embree3/rtcore.h>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

namespace semslam {
namespace {

// Copies the triangles of a part into the Embree scene; its geometry id is the part's index.
void Attach(RTCDevice device, const TriangleMesh& mesh, unsigned id, RTCScene scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.positions.size()));
  for (const Eigen::Vector3f& position : mesh.positions) {
    positions = std::copy_n(position.data(), 3, positions);
  }
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) *indices++ = static_cast<unsigned>(triangle[k]);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

constexpr std::size_t kHalf = 4;
constexpr std::size_t kPacket = 2 * kHalf;  // Rays that are cast together.

// Where the rays of a packet are in their batch: two groups of neighbours.
struct PacketPlace {
  std::size_t first;
  std::size_t second;

  std::size_t IndexOf(std::size_t lane) const {
    return lane < kHalf ? first + lane : second + lane - kHalf;
  }
};

// Calls body(place) for each packet of a batch: eight rays of a row, or four of each of two rows.
template <typename Body>
void ForPackets(const RayBatch& rays, const Body& body) {
  if (rays.row_length > 0) {
    for (std::size_t i = 0; i < rays.row_length; i += kHalf)
      body(PacketPlace{i, rays.row_length + i});
  } else {
    for (std::size_t i = 0; i < rays.size(); i += kPacket) body(PacketPlace{i, i + kHalf});
  }
}

template <typename T>
void Gather(const T* from, const PacketPlace& place, T* packet) {
  std::copy_n(from + place.first, kHalf, packet);
  std::copy_n(from + place.second, kHalf, packet + kHalf);
}

template <typename T>
void Scatter(const T* packet, const PacketPlace& place, T* to) {
  std::copy_n(packet, kHalf, to + place.first);
  std::copy_n(packet + kHalf, kHalf, to + place.second);
}

// All else of a packet stays 0, but for the mask.
void FillPacket(const RayBatch& rays, const PacketPlace& place, RTCRay8* packet) {
  Gather(rays.origin.x.data(), place, packet->org_x);
  Gather(rays.origin.y.data(), place, packet->org_y);
  Gather(rays.origin.z.data(), place, packet->org_z);
  Gather(rays.direction.x.data(), place, packet->dir_x);
  Gather(rays.direction.y.data(), place, packet->dir_y);
  Gather(rays.direction.z.data(), place, packet->dir_z);
  Gather(rays.length.data(), place, packet->tfar);
}

// -1 for each lane that holds a ray to be cast.
void FillValid(const RayBatch& rays, const PacketPlace& place, int* valid) {
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const std::size_t index = place.IndexOf(lane);
    valid[lane] = index < rays.size() && rays.length[index] >= 0 ? -1 : 0;
  }
}

RTCIntersectContext ContextOf(const RayBatch& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = rays.is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                   : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

}  // namespace

class RayScene::Impl {
 public:
  Impl(const Scene& scene, Edges edges) : device_(rtcNewDevice(nullptr)) {
    if (device_ == nullptr) throw InputError("Embree: cannot make a device on this processor");
    scene_ = rtcNewScene(device_);
    if (edges == Edges::kTight) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (std::size_t i = 0; i < scene.parts().size(); ++i) {
      Attach(device_, scene.parts()[i].mesh, static_cast<unsigned>(i), scene_);
    }
    rtcCommitScene(scene_);
    SEMSLAM_CHECK(rtcGetDeviceError(device_) == RTC_ERROR_NONE);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    if (device_ != nullptr) rtcReleaseDevice(device_);
  }

  RTCScene scene() const { return scene_; }

 private:
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

void RayBatch::Resize(std::size_t size) {
  num_rays = size;
  origin.Resize(size);
  direction.Resize(size);
  length.Resize(size);
}

RayScene::RayScene(const Scene& scene, Edges edges)
    : impl_(std::make_unique<const Impl>(scene, edges)) {}
RayScene::~RayScene() = default;

void RayScene::Intersect(const RayBatch& rays, HitBatch* hits) const {
  hits->part.resize(rays.size() + FloatRow::kRoom);
  hits->triangle.resize(rays.size() + FloatRow::kRoom);
  for (FloatRow* row : {&hits->u, &hits->v, &hits->distance}) row->Resize(rays.size());
  RTCIntersectContext context = ContextOf(rays);
  RTCRayHit8 packet = {};
  std::fill_n(packet.ray.mask, kPacket, 0xffffffffU);
  alignas(32) std::array<int, kPacket> valid;
  ForPackets(rays, [&](const PacketPlace& place) {
    FillPacket(rays, place, &packet.ray);
    FillValid(rays, place, valid.data());
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect8(valid.data(), impl_->scene(), &context, &packet);
    static_assert(RTC_INVALID_GEOMETRY_ID == Hit::kNone);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (packet.hit.geomID[lane] == Hit::kNone) packet.ray.tfar[lane] = 0.0F;
    }
    Scatter(packet.hit.geomID, place, hits->part.data());
    Scatter(packet.hit.primID, place, hits->triangle.data());
    Scatter(packet.hit.u, place, hits->u.data());
    Scatter(packet.hit.v, place, hits->v.data());
    Scatter(packet.ray.tfar, place, hits->distance.data());
  });
}

void RayScene::Visibility(const RayBatch& rays, FloatRow* visible) const {
  visible->Resize(rays.size());
  RTCIntersectContext context = ContextOf(rays);
  RTCRay8 packet = {};
  std::fill_n(packet.mask, kPacket, 0xffffffffU);
  alignas(32) std::array<int, kPacket> valid;
  ForPackets(rays, [&](const PacketPlace& place) {
    FillPacket(rays, place, &packet);
    FillValid(rays, place, valid.data());
    rtcOccluded8(valid.data(), impl_->scene(), &context, &packet);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {  // Embree's "occluded" is minus infinity.
      (*visible)[place.IndexOf(lane)] = packet.tfar[lane] < 0 ? 0.0F : 1.0F;
    }
  });
}

}  // namespace semslam

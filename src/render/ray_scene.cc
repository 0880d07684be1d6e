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

constexpr std::size_t kPacket = 8;  // Rays that are cast together.

// Copies rays from index `first` on. All else of a packet stays 0, but for the mask.
void FillPacket(const RayBatch& rays, std::size_t first, RTCRay8* packet) {
  std::copy_n(rays.origin.x.data() + first, kPacket, packet->org_x);
  std::copy_n(rays.origin.y.data() + first, kPacket, packet->org_y);
  std::copy_n(rays.origin.z.data() + first, kPacket, packet->org_z);
  std::copy_n(rays.direction.x.data() + first, kPacket, packet->dir_x);
  std::copy_n(rays.direction.y.data() + first, kPacket, packet->dir_y);
  std::copy_n(rays.direction.z.data() + first, kPacket, packet->dir_z);
  std::copy_n(rays.length.data() + first, kPacket, packet->tfar);
}

// -1 for each lane that holds a ray to be cast.
void FillValid(const RayBatch& rays, std::size_t first, int* valid) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    valid[i] = first + i < rays.size() && rays.length[first + i] >= 0 ? -1 : 0;
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
  size_ = size;
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
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    FillPacket(rays, first, &packet.ray);
    FillValid(rays, first, valid.data());
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect8(valid.data(), impl_->scene(), &context, &packet);
    static_assert(RTC_INVALID_GEOMETRY_ID == Hit::kNone);
    std::copy_n(packet.hit.geomID, kPacket, hits->part.data() + first);
    std::copy_n(packet.hit.primID, kPacket, hits->triangle.data() + first);
    std::copy_n(packet.hit.u, kPacket, hits->u.data() + first);
    std::copy_n(packet.hit.v, kPacket, hits->v.data() + first);
    for (std::size_t i = 0; i < kPacket; ++i) {
      hits->distance[first + i] = packet.hit.geomID[i] == Hit::kNone ? 0.0F : packet.ray.tfar[i];
    }
  }
}

void RayScene::Visibility(const RayBatch& rays, FloatRow* visible) const {
  visible->Resize(rays.size());
  RTCIntersectContext context = ContextOf(rays);
  RTCRay8 packet = {};
  std::fill_n(packet.mask, kPacket, 0xffffffffU);
  alignas(32) std::array<int, kPacket> valid;
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    FillPacket(rays, first, &packet);
    FillValid(rays, first, valid.data());
    rtcOccluded8(valid.data(), impl_->scene(), &context, &packet);
    for (std::size_t i = 0; i < kPacket; ++i) {  // Embree's "occluded" is minus infinity.
      (*visible)[first + i] = packet.tfar[i] < 0 ? 0.0F : 1.0F;
    }
  }
}

}  // namespace semslam

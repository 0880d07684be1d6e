// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_scene.h"

#include <algorithm>
#include <limits>

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

RTCRay ToEmbree(const Ray& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x();
  result.org_y = ray.origin.y();
  result.org_z = ray.origin.z();
  result.dir_x = ray.direction.x();
  result.dir_y = ray.direction.y();
  result.dir_z = ray.direction.z();
  result.tnear = 0.0F;
  result.tfar = ray.length;
  result.mask = 0xffffffffU;
  return result;
}

RTCIntersectContext CoherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

}  // namespace

class RayScene::Impl {
 public:
  explicit Impl(const Scene& scene) : device_(rtcNewDevice(nullptr)) {
    if (device_ == nullptr) throw InputError("Embree: cannot make a device on this processor");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
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

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<const Impl>(scene)) {}
RayScene::~RayScene() = default;

void RayScene::Intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
  SEMSLAM_CHECK(rays.size() == hits.size());
  std::vector<RTCRayHit> stream(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    stream[i].ray = ToEmbree(rays[i]);
    stream[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    stream[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context = CoherentContext();
  rtcIntersect1M(impl_->scene(), &context, stream.data(), static_cast<unsigned>(stream.size()),
                 sizeof(RTCRayHit));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RTCHit& hit = stream[i].hit;
    hits[i] = {};
    if (hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i] = {hit.geomID, hit.primID, hit.u, hit.v, stream[i].ray.tfar};
  }
}

void RayScene::Occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded) const {
  SEMSLAM_CHECK(rays.size() == occluded.size());
  std::vector<RTCRay> stream(rays.size());
  std::transform(rays.begin(), rays.end(), stream.begin(), ToEmbree);
  RTCIntersectContext context = CoherentContext();
  rtcOccluded1M(impl_->scene(), &context, stream.data(), static_cast<unsigned>(stream.size()),
                sizeof(RTCRay));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    occluded[i] = stream[i].tfar < 0 ? 1 : 0;  // Embree's answer is minus infinity.
  }
}

}  // namespace semslam

// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mapping/triangulation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/SVD>

#include "semslam/place/word_matcher.h"

namespace semslam {
namespace {

// One of the two views of a pair.
struct View {
  const KeyframeCopy& keyframe;
  Rigid3 T_camera_world;
};

Eigen::Vector3d Ray(const PinholeCamera& camera, const Keypoint& keypoint) {
  return camera.Unproject(keypoint.pixel.cast<double>(), 1.0);
}

// E with r_first . (E * r_second) = 0 for the rays of one point in two views.
Eigen::Matrix3d EssentialMatrix(const View& first, const View& second) {
  const Rigid3 T_first_second = first.T_camera_world * second.keyframe.T_world_camera;
  return Skew(T_first_second.translation) * T_first_second.rotation.toRotationMatrix();
}

// Squared distance of the second's pixel to the epipolar line, in units of its variance.
class EpipolarCheck {
 public:
  EpipolarCheck(const PinholeCamera& camera,
                const ScaleSpace& scale_space,
                const View& first,
                const View& second)
      : camera_(camera),
        scale_space_(scale_space),
        essential_first_second_(EssentialMatrix(first, second)) {
    const Eigen::Vector3d epipole =
        second.T_camera_world * first.keyframe.T_world_camera.translation;
    if (epipole.z() > 0) epipole_second_ = camera.Project(epipole);
  }

  bool Accepts(const Keypoint& first, const Keypoint& second) const {
    constexpr double kChi2OneDegree = 3.84;
    constexpr double kMinEpipoleDistance2 = 100.0;  // px^2 at the finest level.
    const double variance = scale_space_.PixelVariance(second.octave);
    // Near the epipole every depth fits.
    if (first.depth <= 0 && second.depth <= 0 && epipole_second_ &&
        (second.pixel.cast<double>() - *epipole_second_).squaredNorm() <
            kMinEpipoleDistance2 * variance) {
      return false;
    }
    // The line a x + b y + c = 0 on the second's normalised plane, then in pixels.
    const Eigen::Vector3d line = essential_first_second_.transpose() * Ray(camera_, first);
    const Eigen::Vector2d gradient(line.x() / camera_.fx(), line.y() / camera_.fy());
    if (gradient.squaredNorm() == 0) return false;
    const double residual = line.dot(Ray(camera_, second));
    return residual * residual / gradient.squaredNorm() < kChi2OneDegree * variance;
  }

 private:
  const PinholeCamera& camera_;
  const ScaleSpace& scale_space_;
  Eigen::Matrix3d essential_first_second_;
  std::optional<Eigen::Vector2d> epipole_second_;
};

// The point nearest to two rays in the least-squares sense of the linear equations (Hartley and
// Zisserman, 12.2).
std::optional<Eigen::Vector3d> TriangulateRays(const View& first,
                                               const Eigen::Vector3d& ray_first,
                                               const View& second,
                                               const Eigen::Vector3d& ray_second) {
  Eigen::Matrix4d system;
  int row = 0;
  for (const auto& [view, ray] :
       {std::pair<const View&, const Eigen::Vector3d&>{first, ray_first},
        std::pair<const View&, const Eigen::Vector3d&>{second, ray_second}}) {
    const Eigen::Matrix4d T_camera_world = view.T_camera_world.ToMatrix();
    system.row(row++) = ray.x() * T_camera_world.row(2) - T_camera_world.row(0);
    system.row(row++) = ray.y() * T_camera_world.row(2) - T_camera_world.row(1);
  }
  const Eigen::JacobiSVD<Eigen::Matrix4d> svd(system, Eigen::ComputeFullV);
  const Eigen::Vector4d homogeneous = svd.matrixV().col(3);
  if (std::abs(homogeneous.w()) < 1e-12) return std::nullopt;
  return homogeneous.head<3>() / homogeneous.w();
}

// Cosine of the angle at which the depth camera's virtual stereo pair sees a point at this depth.
double DepthParallaxCosine(double baseline, float depth) {
  return depth > 0 ? std::cos(2.0 * std::atan2(0.5 * baseline, depth)) : 2.0;
}

class PairTriangulator {
 public:
  PairTriangulator(const MappingContext& context,
                   const ScaleSpace& scale_space,
                   const View& first,
                   const View& second)
      : context_(context), scale_space_(scale_space), first_(first), second_(second) {}

  std::optional<Eigen::Vector3d> Triangulate(int feature_first, int feature_second) const {
    const Keypoint& a = first_.keyframe.frame->keypoints[feature_first];
    const Keypoint& b = second_.keyframe.frame->keypoints[feature_second];
    const std::optional<Eigen::Vector3d> p_world = Locate(a, b);
    if (!p_world || !Reprojects(first_, a, *p_world) || !Reprojects(second_, b, *p_world)) {
      return std::nullopt;
    }
    return HasConsistentScale(a, b, *p_world) ? p_world : std::nullopt;
  }

 private:
  std::optional<Eigen::Vector3d> Locate(const Keypoint& a, const Keypoint& b) const {
    constexpr double kMaxCosineWithoutDepth = 0.9998;  // 1.15 degrees.
    const Eigen::Vector3d ray_a = Ray(context_.camera, a);
    const Eigen::Vector3d ray_b = Ray(context_.camera, b);
    const double cosine = (first_.keyframe.T_world_camera.rotation * ray_a)
                              .normalized()
                              .dot((second_.keyframe.T_world_camera.rotation * ray_b).normalized());
    const double baseline = context_.stereo.bf / context_.stereo.fx;
    const double cosine_a = DepthParallaxCosine(baseline, a.depth);
    const double cosine_b = DepthParallaxCosine(baseline, b.depth);
    const bool has_depth = a.depth > 0 || b.depth > 0;
    if (cosine > 0 && cosine < std::min(cosine_a, cosine_b) &&
        (has_depth || cosine < kMaxCosineWithoutDepth)) {
      return TriangulateRays(first_, ray_a, second_, ray_b);
    }
    if (!has_depth) return std::nullopt;
    return cosine_a < cosine_b ? first_.keyframe.T_world_camera * (ray_a * a.depth)
                               : second_.keyframe.T_world_camera * (ray_b * b.depth);
  }

  bool Reprojects(const View& view,
                  const Keypoint& keypoint,
                  const Eigen::Vector3d& p_world) const {
    const Eigen::Vector3d p_camera = view.T_camera_world * p_world;
    if (p_camera.z() <= 0) return false;
    const Eigen::Vector2d pixel = context_.camera.Project(p_camera);
    double error2 = (pixel - keypoint.pixel.cast<double>()).squaredNorm();
    const ImagePoint image{keypoint.pixel.cast<double>(), keypoint.right_x, 1.0};
    if (image.has_right()) {
      const double right_error = pixel.x() - context_.stereo.bf / p_camera.z() - image.right_x;
      error2 += right_error * right_error;
    }
    return error2 <= Chi2Limits().Of(image) * scale_space_.PixelVariance(keypoint.octave);
  }

  // A point twice as far should be seen at half the size.
  bool HasConsistentScale(const Keypoint& a,
                          const Keypoint& b,
                          const Eigen::Vector3d& p_world) const {
    const double distance_a = (p_world - first_.keyframe.T_world_camera.translation).norm();
    const double distance_b = (p_world - second_.keyframe.T_world_camera.translation).norm();
    if (distance_a == 0 || distance_b == 0) return false;
    const double tolerance = 1.5 * scale_space_.scale_factor;
    const double octave_ratio = std::pow(scale_space_.scale_factor, a.octave - b.octave);
    const double ratio = distance_b / distance_a * octave_ratio;
    return ratio < tolerance && ratio > 1.0 / tolerance;
  }

  const MappingContext& context_;
  const ScaleSpace& scale_space_;
  const View& first_;
  const View& second_;
};

std::vector<std::uint8_t> WithoutLandmark(const KeyframeCopy& keyframe) {
  std::vector<std::uint8_t> is_free(keyframe.landmarks.size());
  for (std::size_t i = 0; i < is_free.size(); ++i) is_free[i] = keyframe.landmarks[i] ? 0 : 1;
  return is_free;
}

struct NewLandmark {
  Eigen::Vector3d p_world;
  int feature;            // Of the keyframe.
  int neighbour_feature;  // Of the neighbour.
};

std::vector<NewLandmark> TriangulatePair(const MappingContext& context,
                                         const ScaleSpace& scale_space,
                                         const KeyframeCopy& keyframe,
                                         const KeyframeCopy& neighbour) {
  const View first{keyframe, keyframe.T_world_camera.Inverse()};
  const View second{neighbour, neighbour.T_world_camera.Inverse()};
  const EpipolarCheck check(context.camera, scale_space, first, second);
  const PairTriangulator triangulator(context, scale_space, first, second);
  WordMatchOptions options;
  options.max_ratio = 1.0F;  // The epipolar constraint decides between look-alikes.
  options.accept = [&](int a, int b) {
    return check.Accepts(keyframe.frame->keypoints[a], neighbour.frame->keypoints[b]);
  };
  const std::vector<std::uint8_t> is_free = WithoutLandmark(keyframe);
  const std::vector<std::uint8_t> neighbour_is_free = WithoutLandmark(neighbour);
  std::vector<NewLandmark> result;
  for (const FeatureMatch& match :
       MatchByWords({*keyframe.frame, *keyframe.words, is_free},
                    {*neighbour.frame, *neighbour.words, neighbour_is_free}, options)) {
    if (const auto p_world = triangulator.Triangulate(match.query, match.feature)) {
      result.push_back({*p_world, match.query, match.feature});
    }
  }
  return result;
}

std::vector<LandmarkId> Commit(Map& map,
                               KeyframeId keyframe,
                               KeyframeId neighbour,
                               const std::vector<NewLandmark>& new_landmarks) {
  std::vector<LandmarkId> ids;
  if (map.FindKeyframe(keyframe) == nullptr || map.FindKeyframe(neighbour) == nullptr) return ids;
  for (const NewLandmark& added : new_landmarks) {
    if (map.keyframe(keyframe).landmarks[added.feature]) continue;
    if (map.keyframe(neighbour).landmarks[added.neighbour_feature]) continue;
    const LandmarkId id = map.AddLandmark(added.p_world, {keyframe, added.feature});
    map.AddObservation(id, {neighbour, added.neighbour_feature});
    map.SetAppearance(id, map.ComputeAppearance(id));
    ids.push_back(id);
  }
  return ids;
}

}  // namespace

std::vector<LandmarkId> TriangulateWithNeighbours(const MappingContext& context,
                                                  KeyframeId keyframe_id,
                                                  std::size_t num_neighbours,
                                                  const std::function<bool()>& should_stop) {
  struct Copy {
    ScaleSpace scale_space;
    std::vector<KeyframeId> neighbours;
  };
  const Copy copy = context.map.Read([&](const Map& map) {
    Copy c{map.scale_space(), {}};
    if (map.FindKeyframe(keyframe_id) != nullptr) {
      c.neighbours = map.CovisibleKeyframes(keyframe_id, 1, num_neighbours);
    }
    return c;
  });
  std::vector<LandmarkId> created;
  for (std::size_t i = 0; i < copy.neighbours.size(); ++i) {
    if (i > 0 && should_stop()) break;
    // Copied anew for each: the last neighbour's landmarks occupy features now.
    std::uint64_t epoch = 0;
    const auto pair = context.map.Read([&](const Map& map) {
      epoch = map.epoch();
      std::vector<KeyframeCopy> copies;
      for (const KeyframeId id : {keyframe_id, copy.neighbours[i]}) {
        const Keyframe* keyframe = map.FindKeyframe(id);
        if (keyframe != nullptr && keyframe->words) copies.push_back(CopyKeyframe(*keyframe));
      }
      return copies;
    });
    if (pair.size() < 2) continue;
    const double baseline =
        (pair[0].T_world_camera.translation - pair[1].T_world_camera.translation).norm();
    if (baseline < context.stereo.bf / context.stereo.fx) continue;  // Depth knows better.
    const std::vector<NewLandmark> points =
        TriangulatePair(context, copy.scale_space, pair[0], pair[1]);
    const std::vector<LandmarkId> ids = context.map.Write([&](Map& map) {
      if (map.epoch() != epoch) return std::vector<LandmarkId>();  // Moved as a whole meanwhile.
      return Commit(map, keyframe_id, copy.neighbours[i], points);
    });
    created.insert(created.end(), ids.begin(), ids.end());
  }
  return created;
}

}  // namespace semslam

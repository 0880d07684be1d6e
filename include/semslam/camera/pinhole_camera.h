// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace semslam {

// A pinhole camera with Brown's distortion (k1 k2 p1 p2 k3, OpenCV's order of meaning). Pixel (0,
// 0) is the centre of the top-left pixel. Camera frame: x right, y down, z forward. An immutable
// value; safe to share between threads.
class PinholeCamera {
 public:
  struct Parameters {
    int width = 640;   // Pixels.
    int height = 480;  // Pixels.
    double fx = 0;     // Pixels.
    double fy = 0;
    double cx = 0;
    double cy = 0;
    double k1 = 0;  // Radial distortion.
    double k2 = 0;
    double p1 = 0;  // Tangential distortion.
    double p2 = 0;
    double k3 = 0;
  };

  // Throws std::logic_error unless the size and focal lengths are positive and everything is
  // finite.
  explicit PinholeCamera(const Parameters& parameters);

  const Parameters& parameters() const { return parameters_; }
  int width() const { return parameters_.width; }
  int height() const { return parameters_.height; }
  double fx() const { return parameters_.fx; }
  double fy() const { return parameters_.fy; }
  double cx() const { return parameters_.cx; }
  double cy() const { return parameters_.cy; }
  bool has_distortion() const;

  // Ideal (undistorted) pixel of a point in front of the camera (z > 0), and back.
  Eigen::Vector2d Project(const Eigen::Vector3d& p_camera) const {
    return {fx() * p_camera.x() / p_camera.z() + cx(), fy() * p_camera.y() / p_camera.z() + cy()};
  }
  Eigen::Vector3d Unproject(const Eigen::Vector2d& ideal_pixel, double z) const {
    return {(ideal_pixel.x() - cx()) / fx() * z, (ideal_pixel.y() - cy()) / fy() * z, z};
  }

  // Ideal pixel -> pixel in the image as recorded, and back (by iteration, to 1e-9 px where the
  // model is invertible).
  Eigen::Vector2d Distort(const Eigen::Vector2d& ideal_pixel) const;
  Eigen::Vector2d Undistort(const Eigen::Vector2d& raw_pixel) const;

  // Smallest rectangle of ideal pixels that holds every pixel of the recorded image.
  struct Bounds {
    double min_x, min_y, max_x, max_y;

    bool Contains(const Eigen::Vector2d& pixel) const {
      return pixel.x() >= min_x && pixel.x() <= max_x && pixel.y() >= min_y && pixel.y() <= max_y;
    }
  };
  const Bounds& ideal_bounds() const { return ideal_bounds_; }

 private:
  Bounds ComputeIdealBounds() const;

  Parameters parameters_;
  Bounds ideal_bounds_;
};

// For each pixel of the recorded image, row by row, the direction (x/z, y/z) it looks in:
// back-projection without distortion is then ray * z.
class RayTable {
 public:
  explicit RayTable(const PinholeCamera& camera);

  int width() const { return width_; }
  int height() const { return height_; }
  const Eigen::Vector2f& At(int column, int row) const { return rays_[row * width_ + column]; }
  Eigen::Vector3f Unproject(int column, int row, float z) const {
    const Eigen::Vector2f& ray = At(column, row);
    return {ray.x() * z, ray.y() * z, z};
  }

 private:
  int width_;
  int height_;
  std::vector<Eigen::Vector2f> rays_;
};

}  // namespace semslam

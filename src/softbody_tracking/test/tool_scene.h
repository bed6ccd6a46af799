#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "softbody_tracking/marker_detector.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tool_description.h"

namespace softbody {

/// What a camera adds.
struct ToolSceneNoise {
  double gray_std = 2.0;
  double blur_px = 0.6;
  double depth_std_1_m = 0.005;  ///< times z^2, per pixel
};

constexpr double kPlate = 1.4;  ///< of a marker's side

inline Pinhole toolCamera() { return {640, 480, 615.0, 610.0, 318.0, 243.0}; }

inline ToolMarker toolMarker(int id, double size_m,
                             const Eigen::Isometry3d& T = Eigen::Isometry3d::Identity()) {
  return {id, size_m, T};
}

/// Brightness of a marker's plate at a place in units of its side, 0.5 being its edge.
inline float plateBrightness(const cv::Mat1b& cells, double x, double y) {
  const int column = static_cast<int>(std::floor((x + 0.5) * cells.cols)),
            row = static_cast<int>(std::floor((0.5 - y) * cells.rows));
  const bool inside = column >= 0 && column < cells.cols && row >= 0 && row < cells.rows;
  return inside && cells(row, column) == 0 ? 25.0f : 225.0f;
}

/// Draws one marker with 3 by 3 samples a pixel; exact depth.
inline void drawToolMarker(const std::string& dictionary, const ToolMarker& marker,
                           const Eigen::Isometry3d& T_camera_tool, const Pinhole& camera, cv::Mat1f* gray,
                           cv::Mat1f* depth) {
  const cv::Mat1b cells = markerCells(dictionary, marker.id);
  const Eigen::Isometry3d T = T_camera_tool * marker.T_tool_marker, T_inverse = T.inverse();
  const Eigen::Vector3d normal = T.linear().col(2);
  const double distance = normal.dot(T.translation());
  constexpr int kSamples = 3;
  for (int v = 0; v < gray->rows; ++v) {
    for (int u = 0; u < gray->cols; ++u) {
      float sum = 0.0f;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const double du = (k % kSamples + 0.5) / kSamples - 0.5, dv = (k / kSamples + 0.5) / kSamples - 0.5;
        const Eigen::Vector3d ray = camera.unproject(u + du, v + dv, 1.0);
        const double z = distance / normal.dot(ray);
        const Eigen::Vector3d p = T_inverse * (z * ray) / marker.size_m;
        const bool on_plate =
            normal.dot(ray) < 0.0 && z > 0.0 && p.head<2>().cwiseAbs().maxCoeff() < 0.5 * kPlate;
        sum += on_plate ? plateBrightness(cells, p.x(), p.y()) : (*gray)(v, u);
        if (on_plate && k == kSamples * kSamples / 2) (*depth)(v, u) = static_cast<float>(z);
      }
      (*gray)(v, u) = sum / (kSamples * kSamples);
    }
  }
}

/// A tool before a grey wall 1.5 m away.
inline RgbdFrame renderTool(const ToolDescription& tool, const Eigen::Isometry3d& T_camera_tool,
                            Nanoseconds stamp, unsigned seed, const ToolSceneNoise& noise = {}) {
  RgbdFrame frame;
  frame.stamp = stamp;
  frame.camera = toolCamera();
  cv::Mat1f gray(frame.camera.height, frame.camera.width, 110.0f);
  frame.depth = cv::Mat1f(gray.size(), 1.5f);
  for (const ToolMarker& marker : tool.markers)
    drawToolMarker(tool.dictionary, marker, T_camera_tool, frame.camera, &gray, &frame.depth);
  if (noise.blur_px > 0.0) cv::GaussianBlur(gray, gray, cv::Size(), noise.blur_px);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  for (float& value : gray) value += static_cast<float>(noise.gray_std) * normal(random);
  for (float& z : frame.depth) z += static_cast<float>(noise.depth_std_1_m) * z * z * normal(random);
  cv::Mat1b bytes;
  gray.convertTo(bytes, CV_8U);
  cv::cvtColor(bytes, frame.color, cv::COLOR_GRAY2BGR);
  return frame;
}

/// The marker's frame as a camera sees it from the front: x right, y up, z towards the camera.
inline Eigen::Isometry3d facing(const Eigen::Vector3d& at) {
  return Eigen::Translation3d(at) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
}

/// Turned by an angle about a random axis across the line of sight, then about the marker's normal.
inline Eigen::Isometry3d slanted(double angle_rad, std::mt19937* random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Eigen::Vector3d at(0.08 * any(*random), 0.06 * any(*random), 0.45 + 0.12 * any(*random));
  const double direction = M_PI * any(*random);
  return facing(at) *
         Eigen::AngleAxisd(angle_rad, Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0)) *
         Eigen::AngleAxisd(M_PI * any(*random), Eigen::Vector3d::UnitZ());
}

}  // namespace softbody

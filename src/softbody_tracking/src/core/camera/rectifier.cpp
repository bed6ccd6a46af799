#include "camera/rectifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>

namespace softbody {
namespace {

bool operator==(const Distortion& a, const Distortion& b) {
  return a.K == b.K && a.R == b.R && a.coefficients == b.coefficients && a.fisheye == b.fisheye;
}

cv::Matx33d cameraMatrix(const Pinhole& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

void checkRotation(const cv::Matx33d& R, const cv::Matx33d& K) {
  const double centre[] = {K(0, 2), K(1, 2)};
  const bool finite = std::isfinite(centre[0]) && std::isfinite(centre[1]);
  const double skew = cv::norm(R * R.t() - cv::Matx33d::eye());
  // The comparisons are negated so that NaN is refused too.
  if (!finite || !(skew < 1e-2) || !(cv::determinant(R) > 0.0)) {
    throw std::invalid_argument("camera_info: the centre in K is not finite, or R is not a rotation");
  }
}

/// z of a point in the rectified frame divided by its z in the raw frame, for each rectified pixel.
cv::Mat1f rotatedDepthScale(const cv::Matx33d& R, const Pinhole& camera) {
  cv::Mat1f scale(camera.height, camera.width);
  for (int v = 0; v < scale.rows; ++v) {
    for (int u = 0; u < scale.cols; ++u) {
      const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
      const double raw_z = R(0, 2) * x + R(1, 2) * y + R(2, 2);
      scale(v, u) = raw_z > 0.0 ? static_cast<float>(1.0 / raw_z) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return scale;
}

}  // namespace

bool isAlreadyRectified(const Distortion& distortion, const Pinhole& rectified) {
  const bool undistorted = std::all_of(distortion.coefficients.begin(), distortion.coefficients.end(),
                                       [](double c) { return c == 0.0; });
  if (!undistorted || distortion.fisheye) return false;
  const bool no_calibration = distortion.K(0, 0) == 0.0;
  return no_calibration || (distortion.R == cv::Matx33d::eye() && distortion.K == cameraMatrix(rectified));
}

void checkDistortion(const Distortion& distortion, const Pinhole& rectified) {
  if (isAlreadyRectified(distortion, rectified)) return;
  const std::set<std::size_t> counts =
      distortion.fisheye ? std::set<std::size_t>{4} : std::set<std::size_t>{0, 4, 5, 8, 12, 14};
  if (counts.count(distortion.coefficients.size()) == 0) {
    throw std::invalid_argument(
        fmt::format("camera_info: {} distortion coefficients; expected {}", distortion.coefficients.size(),
                    distortion.fisheye ? "4 (equidistant)" : "4 or 5 (plumb_bob) or 8"));
  }
  const bool finite = std::all_of(distortion.coefficients.begin(), distortion.coefficients.end(),
                                  [](double c) { return std::isfinite(c); });
  if (!finite) throw std::invalid_argument("camera_info: a distortion coefficient is not finite");
  if (!(distortion.K(0, 0) > 0.0 && distortion.K(1, 1) > 0.0)) {
    throw std::invalid_argument(fmt::format("camera_info: the focal lengths {} and {} in K must be above 0",
                                            distortion.K(0, 0), distortion.K(1, 1)));
  }
  checkRotation(distortion.R, distortion.K);
}

void Rectifier::setCamera(const Distortion& distortion, const Pinhole& rectified) {
  if (distortion == distortion_ && rectified == rectified_) return;
  checkDistortion(distortion, rectified);
  distortion_ = distortion;
  rectified_ = rectified;
  identity_ = isAlreadyRectified(distortion, rectified);
  if (!identity_) makeMaps();
}

void Rectifier::makeMaps() {
  const cv::Size size(rectified_.width, rectified_.height);
  const cv::Matx33d P = cameraMatrix(rectified_);
  cv::Mat u, v;
  if (distortion_.fisheye) {
    cv::fisheye::initUndistortRectifyMap(distortion_.K, distortion_.coefficients, distortion_.R, P, size,
                                         CV_32FC1, u, v);
  } else {
    cv::initUndistortRectifyMap(distortion_.K, distortion_.coefficients, distortion_.R, P, size, CV_32FC1, u,
                                v);
  }
  cv::Mat unused;
  cv::convertMaps(u, v, bilinear_, bilinear_fraction_, CV_16SC2, false);
  cv::convertMaps(u, v, nearest_, unused, CV_16SC2, true);
  depth_scale_ =
      distortion_.R == cv::Matx33d::eye() ? cv::Mat1f() : rotatedDepthScale(distortion_.R, rectified_);
}

cv::Mat3b Rectifier::color(const cv::Mat3b& raw) const {
  if (identity_) return raw;
  cv::Mat3b result;
  cv::remap(raw, result, bilinear_, bilinear_fraction_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return result;
}

void Rectifier::depth(const cv::Mat1f& raw, cv::Mat1f* result) const {
  cv::remap(raw, *result, nearest_, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT,
            cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  if (!depth_scale_.empty()) cv::multiply(*result, depth_scale_, *result);
}

}  // namespace softbody

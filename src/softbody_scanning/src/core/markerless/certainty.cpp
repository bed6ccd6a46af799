#include "markerless/certainty.h"

#include <Eigen/Dense>

#include "softbody_common/statistics/median.h"

namespace softbody::scanning {
namespace {

constexpr double kFewestFit = 0.5;  // of the points near a plane, and of the sightings: less is another place
constexpr double kFewestPairs = 0.1;  // of the image's points

}  // namespace

double medianDepth(const cv::Mat1f& depth) {
  std::vector<float> depths;
  for (int v = 0; v < depth.rows; v += 8)
    for (int u = 0; u < depth.cols; u += 8)
      if (depth(v, u) > 0.0f) depths.push_back(depth(v, u));
  return median(&depths);
}

Eigen::Matrix3d covarianceAt(const PoseCovariance& covariance, double depth_m) {
  Eigen::Matrix<double, 3, 6> J;
  J << Eigen::Matrix3d::Identity(), -crossMatrix({0.0, 0.0, depth_m});
  return J * covariance * J.transpose();
}

std::string doubtAbout(const RelativePose& pose, double depth_m, double inverse_depth_std) {
  if (!(depth_m > 0.0)) return "nothing is seen";
  if (pose.pair_share < kFewestPairs) return "the image shows another place than before";
  if (pose.plane_share < kFewestFit) return "depth does not fit the frame before";
  if (pose.sightings < kFewestFit * static_cast<double>(pose.used.size()))
    return "the images do not fit the frame before";
  const double one_pixel = inverse_depth_std * depth_m * depth_m;
  const Eigen::Matrix3d covariance = covarianceAt(pose.covariance, depth_m);
  if (covariance.diagonal().maxCoeff() > one_pixel * one_pixel)
    return "too little texture and shape is seen to tell the motion";
  return {};
}

}  // namespace softbody::scanning

#include "markerless/recognition.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

#include "softbody_common/geometry/rigid_motion.h"

namespace softbody::scanning {
namespace {

constexpr int kFeatures = 800;
constexpr int kFewest = 15;      // with RANSAC on some hundred pairs, chance does not give so many
constexpr float kOff_px = 3.0f;  // of the coarser scales of ORB

cv::Matx33d matrixOf(const Pinhole& c) { return {c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0}; }

Eigen::Isometry3d poseOf(const cv::Vec3d& rotation, const cv::Vec3d& translation) {
  return rigidMotion(Eigen::Vector3d(rotation.val), Eigen::Vector3d(translation.val));
}

}  // namespace

FrameLook lookOf(const Pinhole& camera, const cv::Mat3b& color, const cv::Mat1f& depth) {
  FrameLook look{camera, {}, {}, {}};
  std::vector<cv::KeyPoint> keypoints;
  cv::ORB::create(kFeatures)->detectAndCompute(color, cv::noArray(), keypoints, look.descriptors);
  for (const cv::KeyPoint& keypoint : keypoints) {
    const double z = depth(cvRound(keypoint.pt.y), cvRound(keypoint.pt.x));
    const Eigen::Vector3d p = camera.unproject(keypoint.pt.x, keypoint.pt.y, z);
    look.pixels.push_back(keypoint.pt);
    look.points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(z));
  }
  return look;
}

std::optional<Eigen::Isometry3d> recognise(const FrameLook& a, const FrameLook& b) {
  if (a.descriptors.empty() || b.descriptors.empty()) return std::nullopt;
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_HAMMING, true).match(a.descriptors, b.descriptors, matches);
  std::vector<cv::Point3f> points;
  std::vector<cv::Point2f> pixels;
  for (const cv::DMatch& match : matches) {
    if (!(a.points[match.queryIdx].z > 0.0f)) continue;
    points.push_back(a.points[match.queryIdx]);
    pixels.push_back(b.pixels[match.trainIdx]);
  }
  if (points.size() < kFewest) return std::nullopt;
  cv::Vec3d rotation, translation;
  std::vector<int> fit;
  cv::setRNGSeed(1);  // equal results in each run
  if (!cv::solvePnPRansac(points, pixels, matrixOf(b.camera), cv::noArray(), rotation, translation, false,
                          300, kOff_px, 0.99, fit) ||
      fit.size() < kFewest)
    return std::nullopt;
  return poseOf(rotation, translation);
}

}  // namespace softbody::scanning

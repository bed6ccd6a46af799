#include "paper/frame_features.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "softbody_common/statistics/median.h"

namespace softbody::evaluation {
namespace {

// Corners of an image, of the body and beside it; more than a textured image of 640x480 has.
constexpr int kCorners = 5000;
// Low, because soft bodies have low contrast.
constexpr int kFastThreshold = 10;
// Bits of 256; descriptors of other places differ by about half of them.
constexpr float kLargestDistance = 64.0f;
// Depth noise at 1 m is a third of this [m].
constexpr double kOnBody_m = 0.015;
// A larger difference of depth around a corner is an edge, as a share of depth.
constexpr float kEdge = 0.02f;
// Neighbours that say where a feature must have moved, ...
constexpr std::size_t kBeside = 10;
// ... and how far from there it may be [m].
constexpr double kOutlier_m = 0.006;

/// Depth at a pixel [m]; 0 where it is missing, and at depth edges.
double depthAt(const cv::Mat1f& depth, const cv::Point& pixel) {
  const cv::Rect window(pixel.x - 2, pixel.y - 2, 5, 5);
  if ((window & cv::Rect(cv::Point(), depth.size())) != window) return 0.0;
  double least = 0.0, largest = 0.0;
  const cv::Mat1f around = depth(window);
  cv::minMaxLoc(around, &least, &largest, nullptr, nullptr, around > 0.0f);
  const float middle = depth(pixel);
  return middle > 0.0f && largest - least < kEdge * middle ? middle : 0.0;
}

/// The motion of a feature's neighbours [m]: the median of each coordinate. @param motions of the features
/// that were found.
Eigen::Vector3d motionAround(const Eigen::Vector3d& place, const std::vector<Eigen::Vector3d>& places,
                             const std::vector<Eigen::Vector3d>& motions) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto count = static_cast<std::ptrdiff_t>(std::min(kBeside, order.size()));
  std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](std::size_t a, std::size_t b) {
    return (places[a] - place).squaredNorm() < (places[b] - place).squaredNorm();
  });
  Eigen::Vector3d motion;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> beside;
    for (auto m = order.begin(); m != order.begin() + count; ++m) beside.push_back(motions[*m][axis]);
    motion[axis] = median(&beside);
  }
  return motion;
}

}  // namespace

FrameFeatures::FrameFeatures(int most, const RgbdFrame& first, const cv::Mat1f& body)
    : orb_(cv::ORB::create(kCorners, 1.2f, 4, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31, kFastThreshold)) {
  std::vector<cv::KeyPoint> corners;
  cv::Mat1b gray;
  cv::cvtColor(first.color, gray, cv::COLOR_BGR2GRAY);
  orb_->detect(gray, corners, cv::abs(first.depth - body) < kOnBody_m);
  corners.erase(
      std::remove_if(corners.begin(), corners.end(),
                     [&](const cv::KeyPoint& corner) { return depthAt(first.depth, corner.pt) <= 0.0; }),
      corners.end());
  cv::KeyPointsFilter::retainBest(corners, most);
  corners.resize(std::min(corners.size(), static_cast<std::size_t>(most)));
  orb_->compute(gray, corners, descriptors_);
  for (const cv::KeyPoint& corner : corners) {
    TrackedFeature feature;
    feature.id = static_cast<int>(features_.size());
    feature.pixel = {corner.pt.x, corner.pt.y};
    feature.reference = first.camera.unproject(corner.pt.x, corner.pt.y, depthAt(first.depth, corner.pt));
    feature.position = feature.reference;
    feature.confidence = 1.0;
    features_.push_back(feature);
  }
}

std::vector<TrackedFeature> FrameFeatures::follow(const RgbdFrame& frame) {
  std::vector<cv::KeyPoint> corners;
  cv::Mat1b gray, descriptors;
  cv::cvtColor(frame.color, gray, cv::COLOR_BGR2GRAY);
  orb_->detectAndCompute(gray, cv::noArray(), corners, descriptors);
  std::vector<cv::DMatch> pairs;
  if (!descriptors.empty() && !features_.empty())
    cv::BFMatcher(cv::NORM_HAMMING, true).match(descriptors_, descriptors, pairs);
  std::vector<Eigen::Vector3d> places, motions;
  std::vector<cv::DMatch> measured;
  for (const cv::DMatch& pair : pairs) {
    const cv::Point2f pixel = corners[static_cast<std::size_t>(pair.trainIdx)].pt;
    const double z = depthAt(frame.depth, pixel);
    if (z <= 0.0 || pair.distance > kLargestDistance) continue;
    const Eigen::Vector3d& before = features_[static_cast<std::size_t>(pair.queryIdx)].position;
    places.push_back(before);
    motions.push_back(frame.camera.unproject(pixel.x, pixel.y, z) - before);
    measured.push_back(pair);
  }
  std::vector<TrackedFeature> found;
  for (std::size_t m = 0; m < measured.size(); ++m) {
    if ((motions[m] - motionAround(places[m], places, motions)).norm() > kOutlier_m) continue;
    TrackedFeature& feature = features_[static_cast<std::size_t>(measured[m].queryIdx)];
    const cv::Point2f pixel = corners[static_cast<std::size_t>(measured[m].trainIdx)].pt;
    feature.pixel = {pixel.x, pixel.y};
    feature.position += motions[m];
    descriptors.row(measured[m].trainIdx).copyTo(descriptors_.row(measured[m].queryIdx));
    found.push_back(feature);
  }
  return found;
}

}  // namespace softbody::evaluation

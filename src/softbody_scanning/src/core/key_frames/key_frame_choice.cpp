#include "key_frames/key_frame_choice.h"

#include <opencv2/imgproc.hpp>

namespace softbody::scanning {
namespace {

// A part ends where the camera has turned or moved by this much: neighbours then overlap by far, and a walk
// round an object on two heights has about 150 parts.
constexpr double kTurn_rad = 0.06;
constexpr double kWay_m = 0.03;

bool isFar(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d between = a.inverse() * b;
  return Eigen::AngleAxisd(between.linear()).angle() > kTurn_rad ||
         (a.inverse().translation() - b.inverse().translation()).norm() > kWay_m;
}

}  // namespace

double sharpnessOf(const cv::Mat3b& bgr) {
  cv::Mat gray, laplacian, mean, deviation;
  cv::cvtColor(bgr, gray, cv::COLOR_BGR2GRAY);
  cv::Laplacian(gray, laplacian, CV_32F);
  cv::meanStdDev(laplacian, mean, deviation);
  return deviation.at<double>(0) * deviation.at<double>(0);
}

void KeyFrameChoice::add(KeyFrame frame) {
  if (chosen_.empty() || isFar(start_, frame.T_camera_model)) {
    start_ = frame.T_camera_model;
    chosen_.push_back(std::move(frame));
  } else if (frame.sharpness > chosen_.back().sharpness) {
    chosen_.back() = std::move(frame);
  }
}

std::vector<KeyFrame> KeyFrameChoice::take() { return std::move(chosen_); }

}  // namespace softbody::scanning

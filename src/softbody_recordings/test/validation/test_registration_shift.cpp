#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "softbody_recordings/validation/registration_shift.h"

namespace softbody::validation {
namespace {

/// A body with texture before a wall with texture; its depth lies shifted.
void addScene(std::mt19937* random, const cv::Point& shift, RegistrationShiftEstimator* estimator) {
  std::uniform_int_distribution<int> place(0, 60), grey(0, 40);
  cv::Mat3b color(480, 640);
  color.forEach([](cv::Vec3b& pixel, const int*) { pixel = cv::Vec3b(90, 100, 110); });
  cv::Mat3b noise(480, 640);
  cv::theRNG().state = (*random)();
  cv::randu(noise, cv::Scalar::all(0), cv::Scalar::all(40));
  const cv::Point centre(260 + place(*random), 200 + place(*random));
  const cv::Size axes(120, 70);
  cv::ellipse(color, centre, axes, 20.0, 0.0, 360.0, cv::Scalar(30, 160, 200), cv::FILLED);
  cv::circle(color, centre + cv::Point(30, 10), 20, cv::Scalar(200, 40, 40), cv::FILLED);
  color += noise;
  cv::Mat1f depth(480, 640, 1.2f);
  cv::ellipse(depth, centre + shift, axes, 20.0, 0.0, 360.0, cv::Scalar(0.6), cv::FILLED);
  depth.colRange(0, 20) = 0.0f;
  estimator->add(color, depth);
}

TEST(RegistrationShift, IsFoundInAnyDirection) {
  std::mt19937 random(11);
  for (const cv::Point& shift :
       {cv::Point(30, 0), cv::Point(-30, 0), cv::Point(0, 30), cv::Point(22, -21), cv::Point(0, 0)}) {
    RegistrationShiftEstimator estimator;
    for (int k = 0; k < 5; ++k) addScene(&random, shift, &estimator);
    const auto found = estimator.shift();
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->pixels.x, -shift.x, 6.0);
    EXPECT_NEAR(found->pixels.y, -shift.y, 6.0);
    EXPECT_GE(found->similarity, found->unshifted);
  }
}

TEST(RegistrationShift, WithoutEdgesNothingIsSaid) {
  RegistrationShiftEstimator estimator;
  EXPECT_FALSE(estimator.shift());
  estimator.add(cv::Mat3b(480, 640, cv::Vec3b(1, 2, 3)), cv::Mat1f(480, 640, 1.0f));
  estimator.add(cv::Mat3b(8, 8, cv::Vec3b(1, 2, 3)), cv::Mat1f(8, 8, 1.0f));
  estimator.add(cv::Mat3b(480, 640, cv::Vec3b(1, 2, 3)), cv::Mat1f(8, 8, 1.0f));
  EXPECT_FALSE(estimator.shift());
}

}  // namespace
}  // namespace softbody::validation

#include "report/cut_pictures.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "softbody_virtual_camera/camera/camera_setup.h"

namespace softbody::evaluation {
namespace {

/// The virtual sponge before, in and after its cut, with its truth for a result.
class CutPictures : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    virtual_camera::CameraSetup setup;
    setup.scene = "cut";
    setup.config_folder = CONFIG_DIR;
    setup.width = 320;
    setup.height = 240;
    setup.noise = virtual_camera::noNoise();
    virtual_camera::VirtualCamera camera = virtual_camera::makeCamera(setup);
    recorded_ = {};
    for (const std::uint32_t revision : {0u, 1u}) recorded_.topologies[revision] = camera.topology(revision);
    for (const double t : {0.0, 1.0, 3.0, 8.0}) {
      const virtual_camera::Capture capture = camera.capture(0, t);
      RecordedFrame frame;
      frame.stamp = static_cast<Nanoseconds>(1e9 * (1.0 + t));
      frame.camera = camera.pinhole();
      cv::cvtColor(capture.color, frame.color, cv::COLOR_RGB2BGR);
      recorded_.states[frame.stamp] = capture.truth;
      frames_.push_back(frame);
    }
  }

  /// Share of pixels much redder than green and blue.
  static double redShare(const cv::Mat3b& picture) {
    int count = 0;
    for (const cv::Vec3b& pixel : picture)
      count += pixel[2] > 1.4 * pixel[1] && pixel[2] > 1.4 * pixel[0] ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(picture.total());
  }

  static SurfaceRecord recorded_;
  static std::vector<RecordedFrame> frames_;
  SurfaceRecord record_ = recorded_;
};

SurfaceRecord CutPictures::recorded_;
std::vector<RecordedFrame> CutPictures::frames_;

TEST_F(CutPictures, ModelsShowTheLinesOfTheCutAndItsFacesWhereTheyAreFilled) {
  const cv::Mat3b picture = drawCutModels(record_);
  const int height = picture.rows / 4;
  double red[4];
  for (int k = 0; k < 4; ++k) red[k] = redShare(picture.rowRange(k * height, (k + 1) * height));
  EXPECT_EQ(red[0], 0.0) << "an uncut body";
  EXPECT_GT(red[1], 0.003) << "lines";
  EXPECT_EQ(red[2], 0.0) << "not filled";
  EXPECT_GT(red[3], 0.01) << "filled faces of pieces that lie apart";
}

TEST_F(CutPictures, TheStripShowsTheFramesAboveTheirMeshes) {
  CutStrip strip(record_, {});
  EXPECT_THROW(strip.picture(), std::invalid_argument) << "no frame has come";
  for (const RecordedFrame& frame : frames_) strip.add(frame);
  const cv::Mat3b picture = strip.picture();
  const int width = picture.cols / 3;  // before the cut, right after it and at the end
  const cv::Mat3b meshes = picture.rowRange(picture.rows / 2, picture.rows);
  EXPECT_EQ(redShare(meshes.colRange(0, width)), 0.0);
  EXPECT_GT(redShare(meshes.colRange(2 * width, 3 * width)), 0.005);
}

TEST_F(CutPictures, ABodyThatWasNotCutIsRefused) {
  record_.states.erase(std::next(record_.states.begin(), 2), record_.states.end());
  EXPECT_THROW(drawCutModels(record_), std::invalid_argument);
  EXPECT_THROW(CutStrip(record_, {}), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::evaluation

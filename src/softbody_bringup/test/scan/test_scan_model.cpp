#include <test_support/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "softbody_evaluation/models/model_distance.h"
#include "softbody_evaluation/models/model_fit.h"
#include "softbody_scanning/output/scanned_model.h"
#include "softbody_scanning/ros/recording_reader.h"
#include "softbody_scanning/tools/scan_model.h"
#include "softbody_virtual_camera/camera/camera_setup.h"
#include "softbody_virtual_camera/ros/bag_writer.h"

namespace softbody::scanning {
namespace {

namespace fs = std::filesystem;

/// A folder for bags and models, removed at the end.
class ScanModel : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  /// A recording of the virtual camera. @param rate_hz so that 20 s have few frames.
  std::string record(const virtual_camera::CameraSetup& setup, double rate_hz, double duration_s) const {
    const std::string path = (folder_ / (setup.scene + setup.sheet + ".bag")).string();
    virtual_camera::VirtualCamera camera = virtual_camera::makeCamera(setup);
    writeBag(&camera, {path, static_cast<int>(duration_s * rate_hz), rate_hz}, [](int) {});
    return path;
  }

  static virtual_camera::CameraSetup walk() {
    virtual_camera::CameraSetup setup;
    setup.scene = "walk";
    setup.config_folder = CONFIG_DIR;
    return setup;
  }

  static RecordingOptions optionsOf(const std::string& bag) {
    RecordingOptions options;
    options.bag = bag;
    options.sheet = loadToolDescription(CONFIG_DIR "/sheet.yaml");
    return options;
  }

  /// Why a recording is refused; empty: it is not.
  static std::string refusal(const RecordingOptions& options) {
    RecordingReport report;
    return complaint([&] {
      scanAndCheck({readRecording(
                       options, [](double) {}, &report)},
                   {});
    });
  }

  const fs::path folder_ = fs::temp_directory_path() / ("test_scan_" + std::to_string(getpid()));
};

TEST_F(ScanModel, theModelOfAWalkHasTheBodysSurface) {
  RecordingReport report;
  PosedRecording recording = readRecording(
      optionsOf(record(walk(), 3.0, 20.0)), [](double) {}, &report);
  EXPECT_EQ(report.motion, MotionSource::kSheet);
  EXPECT_EQ(report.posed, report.frames);
  EXPECT_NEAR(report.depth_scale, 1.0, 0.01);
  CheckedScan scan = scanAndCheck({std::move(recording)}, {});
  EXPECT_EQ(scan.left_out, 0);
  const std::string model = (folder_ / "model").string();
  std::ostringstream text;
  writeModel(
      std::move(scan), "report", model, [](double) {}, text);
  EXPECT_TRUE(fs::exists(folder_ / "model/visual.png"));
  EXPECT_TRUE(says(text.str(), "Verdict: good"));

  std::vector<std::string> warnings;
  const evaluation::Model scanned = evaluation::readModel(model, &warnings);
  const evaluation::Model truth = evaluation::readModel(CONFIG_DIR "/sponge.obj", &warnings);
  const evaluation::ModelReport found =
      evaluation::compareModels(scanned, truth, evaluation::fitModel(scanned, truth), 1);
  ASSERT_TRUE(found.seen);
  EXPECT_LT(found.seen->to_truth.mean, 0.5e-3);
  EXPECT_LT(found.seen->to_truth.p99, 2e-3);
  EXPECT_GT(found.whole.within_2mm, 0.99);
  ASSERT_TRUE(found.scanned_m3 && found.true_m3);
  EXPECT_NEAR(*found.scanned_m3 / *found.true_m3, 1.0, 0.05);
}

TEST_F(ScanModel, poorRecordingsAreRefusedWithWhatToDo) {
  const std::string half = record(walk(), 4.0, 2.0);
  EXPECT_TRUE(says(refusal(optionsOf(half)), "walk once round"));
  RecordingOptions wrong_unit = optionsOf(half);
  wrong_unit.camera.depth_scale = 0.0005;
  EXPECT_TRUE(says(refusal(wrong_unit), "--depth-scale"));
  wrong_unit.camera.depth_scale = 1.0;  // all of it is farther than any camera measures
  EXPECT_TRUE(says(refusal(wrong_unit), "--depth-scale"));
  RecordingOptions no_depth = optionsOf(half);
  no_depth.camera.depth = "/none";
  EXPECT_TRUE(says(refusal(no_depth), half));
  EXPECT_EQ(refusal(no_depth).find(half), refusal(no_depth).rfind(half)) << refusal(no_depth);
}

/// What scan_model says when it refuses its arguments or recordings.
std::string refusalOf(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "scan_model");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStderr();
  EXPECT_NE(runScanModel(static_cast<int>(argv.size()), argv.data()), 0);
  return testing::internal::GetCapturedStderr();
}

TEST_F(ScanModel, aChoiceThatCannotBeMeantIsRefused) {
  const std::string bag = record(walk(), 4.0, 2.0), model = (folder_ / "model").string();
  const auto refuses = [&](std::vector<std::string> options, const std::string& words) {
    options.insert(options.begin(), {bag, "--output", model});
    const std::string refusal = refusalOf(options);
    EXPECT_TRUE(says(refusal, words));
    EXPECT_FALSE(fs::exists(model));
  };
  refuses({"--at", "nan", "0", "0"}, "--at");
  refuses({"--at", "0", "0", "0", "--at", "0", "0", "0"}, "2 times for 1 recordings");
  refuses({"--box", "0.1", "0", "0", "0.1"}, "is empty");
  refuses({"--box", "100", "80", "200", "180"}, "give metres");
  refuses({"--box", "0.08", "0.08", "0.09", "0.09"}, "--box larger");
}

TEST_F(ScanModel, aCameraOnAnArmNeedsNoSheet) {
  virtual_camera::CameraSetup setup = walk();
  setup.sheet = "none";
  setup.camera_tf = true;
  RecordingReport report;
  PosedRecording recording = readRecording(
      optionsOf(record(setup, 2.0, 20.0)), [](double) {}, &report);
  EXPECT_EQ(report.motion, MotionSource::kTransforms);
  const ScannedBody body = scanBody({std::move(recording)}, {});
  const Eigen::RowVector3d size =
      body.mesh.vertices.colwise().maxCoeff() - body.mesh.vertices.colwise().minCoeff();
  EXPECT_NEAR(size.z(), 0.04, 2e-3);  // the sponge's thickness
}

}  // namespace
}  // namespace softbody::scanning

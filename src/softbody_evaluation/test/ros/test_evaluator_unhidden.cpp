#include <gtest/gtest.h>

#include <utility>

#include "fixtures/evaluator_bags.h"
#include "report/report_text.h"

namespace softbody::evaluation {
namespace {

/// A hand hides the body for 2 s.
std::string occludedRecording() {
  virtual_camera::CameraSetup setup = smallSetup();
  setup.scene = "occlude";
  virtual_camera::VirtualCamera camera = makeCamera(setup);
  const std::string file = testing::TempDir() + "evaluator_occluded.bag";
  writeBag(&camera, {file, 5 * kFrames, 20.0}, [](int) {});
  return file;
}

TEST(Evaluator, BackToNormalIsJudgedByTheUnhiddenResult) {
  EvaluatorOptions options;
  options.truth = occludedRecording();
  const auto off = [](float later_m) {
    return [=](softbody_msgs::MeshState* s, int frame) { return shift(s, frame < 30 ? 0.001f : later_m); };
  };
  options.result = resultFromTruth("hidden.bag", off(0.003f), options.truth);
  ASSERT_EQ(evaluate(options).absences.size(), 1u);
  EXPECT_FALSE(evaluate(options).absences[0].recovery_s);
  options.unhidden = resultFromTruth("unhidden.bag", off(0.0026f), options.truth);
  EXPECT_EQ(evaluate(options).absences[0].recovery_s, 0.0);
  EXPECT_NEAR(evaluate(options).absences[0].normal, 0.0026, 1e-6);
  const std::string words = toText(evaluate(options));
  EXPECT_NE(words.find("back to normal (2.600 mm) after 0.00 s; not back to the error before"),
            std::string::npos)
      << words;
  EXPECT_TRUE(evaluate(options).notes.empty());
  options.unhidden = resultFromTruth("unhidden.bag", off(0.0024f), options.truth);
  EXPECT_FALSE(evaluate(options).absences[0].recovery_s);
  options.unhidden = resultFromTruth(
      "gaps.bag", [](softbody_msgs::MeshState*, int frame) { return frame % 10 != 0; }, options.truth);
  const Report with_gaps = evaluate(options);
  ASSERT_EQ(with_gaps.notes.size(), 1u);
  EXPECT_NE(with_gaps.notes[0].find("gaps.bag has no state for 10 of 100 frames"), std::string::npos);
}

TEST(Evaluator, OtherFramesOfAnUnhiddenResultAndOtherBodiesAreRefused) {
  EvaluatorOptions options;
  options.truth = recording();
  options.result = resultFromTruth("seen.bag", asItIs);
  options.unhidden = resultFromTruth("other_frames.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.stamp += ros::Duration(0.001);
    return true;
  });
  EXPECT_NE(failure(options).find("other_frames.bag: the unhidden body has no state with the stamp"),
            std::string::npos);
  virtual_camera::CameraSetup setup;
  setup.scene = "doll_still";
  setup.config_folder = CONFIG_DIR;
  setup.width = 160;
  setup.height = 120;
  virtual_camera::VirtualCamera camera = makeCamera(setup);
  const std::string doll = testing::TempDir() + "evaluator_doll.bag";
  writeBag(&camera, {doll, 2, 4.0}, [](int) {});
  options.unhidden = resultFromTruth("other_mesh.bag", asItIs, doll);
  EXPECT_NE(failure(options).find("other_mesh.bag: its mesh is not of the body of the truth"),
            std::string::npos);
  options.result = std::exchange(options.unhidden, "");
  EXPECT_NE(failure(options).find("other_mesh.bag: its mesh is not of the body of the truth"),
            std::string::npos);
}

}  // namespace
}  // namespace softbody::evaluation

#include <test_support/gtest.h>

#include <utility>

#include "fixtures/evaluator_bags.h"

namespace softbody::evaluation {
namespace {

/// A hand hides the body for 2 s.
std::string occludedRecording() {
  virtual_camera::CameraSetup setup = smallSetup();
  setup.scene = "occlude";
  return recordingOf(setup, "evaluator_occluded.bag", 5 * kFrames, 20.0);
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
  EXPECT_FALSE(evaluate(options).absences[0].recovery_to_before_s);
  EXPECT_TRUE(evaluate(options).notes.empty());
  options.unhidden = resultFromTruth("unhidden.bag", off(0.0024f), options.truth);
  EXPECT_FALSE(evaluate(options).absences[0].recovery_s);
  options.unhidden = resultFromTruth(
      "gaps.bag", [](softbody_msgs::MeshState*, int frame) { return frame % 10 != 0; }, options.truth);
  const Report with_gaps = evaluate(options);
  ASSERT_EQ(with_gaps.notes.size(), 1u);
  EXPECT_TRUE(says(with_gaps.notes[0], "gaps.bag has no state for 10 of 100 frames"));
}

TEST(Evaluator, OtherFramesOfAnUnhiddenResultAndOtherBodiesAreRefused) {
  EvaluatorOptions options = optionsOf(resultFromTruth("seen.bag", asItIs));
  options.unhidden = resultFromTruth("other_frames.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.stamp += ros::Duration(0.001);
    return true;
  });
  EXPECT_TRUE(says(failure(options), "other_frames.bag: the unhidden body has no state with the stamp"));
  virtual_camera::CameraSetup setup;
  setup.scene = "doll_still";
  setup.config_folder = CONFIG_DIR;
  setup.width = 160;
  setup.height = 120;
  const std::string doll = recordingOf(setup, "evaluator_doll.bag", 2);
  options.unhidden = resultFromTruth("other_mesh.bag", asItIs, doll);
  EXPECT_TRUE(says(failure(options), "other_mesh.bag: its mesh is not of the body of the truth"));
  options.result = std::exchange(options.unhidden, "");
  EXPECT_TRUE(says(failure(options), "other_mesh.bag: its mesh is not of the body of the truth"));
}

}  // namespace
}  // namespace softbody::evaluation

#include "softbody_bringup/evaluation/evaluator.h"

#include <fmt/format.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/TrackingStatus.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "softbody_bringup/virtual_camera/bag_writer.h"
#include "softbody_bringup/virtual_camera/camera_setup.h"

namespace softbody::evaluation {
namespace {

constexpr int kFrames = 20;

/// A clean recording with its truth, made once.
const std::string& recording() {
  static const std::string path = [] {
    virtual_camera::CameraSetup setup;
    setup.body = std::string(CONFIG_DIR) + "/sponge.obj";
    setup.width = 160;
    setup.height = 120;
    setup.noise = virtual_camera::noNoise();
    virtual_camera::VirtualCamera camera = makeCamera(setup);
    const std::string file = testing::TempDir() + "evaluator_recording.bag";
    writeBag(&camera, {file, kFrames, 4.0}, [](int) {});
    return file;
  }();
  return path;
}

/// The truth as if it were a result, after a change. A state whose change returns false is left out.
std::string resultFromTruth(const std::string& name,
                            const std::function<bool(softbody_msgs::MeshState*, int)>& change,
                            const std::string& truth = recording()) {
  const std::string path = testing::TempDir() + name;
  rosbag::Bag in(truth), out(path, rosbag::bagmode::Write);
  rosbag::View view(in, rosbag::TopicQuery(std::vector<std::string>{"/ground_truth/surface/topology",
                                                                    "/ground_truth/surface/state"}));
  int frame = 0;
  for (const rosbag::MessageInstance& m : view) {
    if (const auto topology = m.instantiate<softbody_msgs::MeshTopology>()) {
      out.write("/softbody/surface/topology", m.getTime(), topology);
    } else if (const auto state = m.instantiate<softbody_msgs::MeshState>()) {
      softbody_msgs::MeshState changed = *state;
      if (change(&changed, frame++)) out.write("/softbody/surface/state", m.getTime(), changed);
    }
  }
  out.close();
  return path;
}

bool shift(softbody_msgs::MeshState* state, float dz) {
  for (geometry_msgs::Point32& p : state->vertices) p.z += dz;
  return true;
}

/// A hand hides the body for 2 s.
std::string occludedRecording() {
  virtual_camera::CameraSetup setup;
  setup.scene = "occlude";
  setup.body = std::string(CONFIG_DIR) + "/sponge.obj";
  setup.width = 160;
  setup.height = 120;
  setup.noise = virtual_camera::noNoise();
  virtual_camera::VirtualCamera camera = makeCamera(setup);
  const std::string file = testing::TempDir() + "evaluator_occluded.bag";
  writeBag(&camera, {file, 5 * kFrames, 20.0}, [](int) {});
  return file;
}

std::string failure(const EvaluatorOptions& options) {
  try {
    evaluate(options);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(Evaluator, ThePerfectResultHasNoErrorButTheMillimetreGrid) {
  EvaluatorOptions options;
  options.result = resultFromTruth("perfect.bag", [](softbody_msgs::MeshState*, int) { return true; });
  options.truth = recording();
  const Report report = evaluate(options);
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames));
  EXPECT_EQ(report.vertex_error->all.max, 0.0);
  EXPECT_EQ(report.vertex_error->all.count, static_cast<std::size_t>(522 * kFrames));
  EXPECT_LT(report.residual->residual.max, 0.51e-3);
  EXPECT_EQ(report.residual->occluded_share, 0.0);
  EXPECT_TRUE(report.volume.closed);
  EXPECT_LT(std::abs(report.volume.change.largest), 0.002);
  EXPECT_EQ(report.volume.error->largest, 0.0);
  EXPECT_EQ(report.frames.recorded, static_cast<std::size_t>(kFrames));
}

TEST(Evaluator, AKnownDisplacementIsTheErrorAndTheFolderHoldsTheReport) {
  EvaluatorOptions options;
  options.result =
      resultFromTruth("shifted.bag", [](softbody_msgs::MeshState* s, int) { return shift(s, 0.002f); });
  options.truth = recording();
  options.report_folder = testing::TempDir() + "evaluator_report";
  const Report report = evaluate(options);
  EXPECT_NEAR(report.vertex_error->all.mean, 0.002, 1e-7);
  EXPECT_NEAR(report.vertex_error->visible.p95, 0.002, 1e-7);
  EXPECT_NEAR(report.vertex_error->hidden.max, 0.002, 1e-7);
  EXPECT_NEAR(toJson(report)["vertex_error"]["all"]["mean_mm"].get<double>(), 2.0, 1e-4);
  for (const char* file :
       {"report.json", "vertex_error.png", "depth_residual_histogram.png", "overlay.png"}) {
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(options.report_folder) / file)) << file;
  }
}

TEST(Evaluator, MissingFramesAreCountedNotSkipped) {
  EvaluatorOptions options;
  options.result =
      resultFromTruth("gaps.bag", [](softbody_msgs::MeshState*, int frame) { return frame % 4 != 0; });
  options.truth = recording();
  const Report report = evaluate(options);
  EXPECT_EQ(report.frames.expected, static_cast<std::size_t>(kFrames));
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames - kFrames / 4));
  options.truth.clear();
  options.recording = recording();
  EXPECT_EQ(evaluate(options).frames.answered, static_cast<std::size_t>(kFrames - kFrames / 4));
}

TEST(Evaluator, StatesThatAreNoAnswersAreCountedAndSaid) {
  EvaluatorOptions options;
  options.truth = recording();
  options.result = resultFromTruth("broken.bag", [](softbody_msgs::MeshState* s, int frame) {
    if (frame == 3) s->vertices.at(7).y = std::numeric_limits<float>::quiet_NaN();
    if (frame == 5) s->revision = 9;
    if (frame == 6) s->vertices.pop_back();
    if (frame == 7) s->confidence.clear();
    return true;
  });
  const Report report = evaluate(options);
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames - 4));
  EXPECT_EQ(report.vertex_error->all.max, 0.0);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("4 of 20 states"), std::string::npos) << report.notes[0];
  EXPECT_NE(report.notes[0].find("vertices[7] is not finite"), std::string::npos) << report.notes[0];

  options.result = resultFromTruth("mixed.bag", [](softbody_msgs::MeshState* s, int frame) {
    if (frame > 10) s->header.frame_id = "world";
    return true;
  });
  EXPECT_NE(failure(options).find("'camera_color_optical_frame' and in 'world'"), std::string::npos);
}

TEST(Evaluator, SilhouettesStageTimesAndThePageAreThere) {
  EvaluatorOptions options;
  options.result =
      resultFromTruth("timed.bag", [](softbody_msgs::MeshState* s, int) { return shift(s, 0.001f); });
  {
    rosbag::Bag bag(options.result, rosbag::bagmode::Append);
    softbody_msgs::StageTiming timing;
    timing.node = "replay";
    timing.stages.resize(1);
    timing.stages[0].stage = "registration";
    for (int k = 1; k <= 20; ++k) {
      timing.stages[0].milliseconds = static_cast<float>(k);
      bag.write("/softbody/timing", ros::Time(1.6e9 + k), timing);
    }
    softbody_msgs::TrackingStatus status;
    for (int k = 0; k < 4; ++k) {
      status.state = k < 3 ? softbody_msgs::TrackingStatus::TRACKING : softbody_msgs::TrackingStatus::LOST;
      bag.write("/softbody/status", ros::Time(1.6e9 + k), status);
    }
  }
  options.truth = recording();
  options.report_folder = testing::TempDir() + "evaluator_page";
  const Report report = evaluate(options);
  EXPECT_TRUE(report.silhouette->against_truth);
  EXPECT_GT(report.silhouette->worst, 0.9);
  EXPECT_EQ(report.stages.size(), 1u);
  EXPECT_EQ(report.states.at("tracking"), 3u);
  EXPECT_EQ(report.states.at("lost"), 1u);
  EXPECT_EQ(report.stages.begin()->second.mean, 10.5);
  EXPECT_EQ(report.stages.begin()->second.p95, 19.0);
  EXPECT_TRUE(std::filesystem::exists(options.report_folder + "/report.html"));

  options.truth.clear();
  options.recording = recording();
  EXPECT_FALSE(evaluate(options).silhouette->against_truth);
}

TEST(Evaluator, AResultInAnotherFrameIsBroughtBackByTf) {
  EvaluatorOptions options;
  const Eigen::Vector3d offset(0.5, -0.25, 2.0);
  // world = camera turned by a quarter about z, then moved.
  options.result = resultFromTruth("in_world.bag", [&](softbody_msgs::MeshState* s, int) {
    for (geometry_msgs::Point32& p : s->vertices) {
      const geometry_msgs::Point32 camera = p;
      p.x = static_cast<float>(offset.x() - camera.y);
      p.y = static_cast<float>(offset.y() + camera.x);
      p.z = static_cast<float>(offset.z() + camera.z);
    }
    s->header.frame_id = "world";
    return true;
  });
  options.truth = recording();
  const std::string way = "static_transform_publisher 0 0 0 0 0 0 world camera_color_optical_frame";
  EXPECT_NE(failure(options).find(way), std::string::npos) << failure(options);
  EXPECT_EQ(failure(options).find(".."), std::string::npos) << failure(options);
  {
    rosbag::Bag bag(options.result, rosbag::bagmode::Append);
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    geometry_msgs::TransformStamped& t = message.transforms[0];
    t.header.frame_id = "world";
    t.header.stamp = ros::Time(1.0);
    t.child_frame_id = "camera_color_optical_frame";
    t.transform.translation.x = offset.x();
    t.transform.translation.y = offset.y();
    t.transform.translation.z = offset.z();
    t.transform.rotation.z = t.transform.rotation.w = std::sqrt(0.5);
    bag.write("/tf_static", ros::Time(1.6e9), message);
  }
  const Report report = evaluate(options);
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames));
  EXPECT_LT(report.vertex_error->all.max, 1e-6);
  EXPECT_TRUE(report.notes.empty());
}

TEST(Evaluator, TwoResultsSideBySide) {
  EvaluatorOptions options;
  options.result =
      resultFromTruth("first_of_two.bag", [](softbody_msgs::MeshState* s, int) { return shift(s, 0.001f); });
  const std::string other =
      resultFromTruth("second_of_two.bag", [](softbody_msgs::MeshState* s, int) { return shift(s, 0.004f); });
  options.truth = recording();
  options.report_folder = testing::TempDir() + "evaluator_two";
  const Comparison comparison = evaluateBoth(options, other);
  EXPECT_NEAR(comparison.first.vertex_error->all.mean, 0.001, 1e-7);
  EXPECT_NEAR(comparison.second.vertex_error->all.mean, 0.004, 1e-7);
  EXPECT_EQ(toJson(comparison)["other"]["frames"]["answered"], kFrames);
  for (const char* file : {"report.json", "report.html", "overlay.png", "other_overlay.png"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(options.report_folder) / file)) << file;
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

TEST(Evaluator, OtherFramesOfAnUnhiddenResultAndOtherMeshesAreRefused) {
  EvaluatorOptions options;
  options.truth = recording();
  options.result = resultFromTruth("seen.bag", [](softbody_msgs::MeshState*, int) { return true; });
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
  const auto as_it_is = [](softbody_msgs::MeshState*, int) { return true; };
  options.unhidden = resultFromTruth("other_mesh.bag", as_it_is, doll);
  EXPECT_NE(failure(options).find("other_mesh.bag: the unhidden body is another mesh"), std::string::npos);
  options.result = std::exchange(options.unhidden, "");
  EXPECT_NE(failure(options).find("other_mesh.bag: the body is another mesh"), std::string::npos);
}

TEST(Evaluator, ThePoseOfTheToolIsComparedWhereTheTruthHasOne) {
  EvaluatorOptions options;
  options.result = resultFromTruth("tool.bag", [](softbody_msgs::MeshState*, int) { return true; });
  options.truth = testing::TempDir() + "tool_truth.bag";
  std::filesystem::copy_file(recording(), options.truth, std::filesystem::copy_options::overwrite_existing);
  rosbag::Bag result(options.result, rosbag::bagmode::Append), truth(options.truth, rosbag::bagmode::Append);
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.pose.pose.orientation.w = 1.0;
  for (int k = 0; k < 5; ++k) {
    pose.header.stamp = ros::Time(1.6e9 + k);
    pose.pose.pose.position.x = 0.0;
    truth.write("/ground_truth/tool/pose", pose.header.stamp, pose);
    pose.pose.pose.position.x = 0.002;
    if (k > 0) result.write("/softbody/tool/pose", pose.header.stamp, pose);
  }
  result.close();
  truth.close();
  const Report report = evaluate(options);
  EXPECT_EQ(report.tool->expected, 5u);
  EXPECT_EQ(report.tool->answered, 4u);
  EXPECT_NEAR(report.tool->position.mean, 0.002, 1e-8);
  EXPECT_TRUE(report.notes.empty());
}

TEST(Evaluator, PosesOfTheToolThatTfDoesNotPlaceAreSaid) {
  EvaluatorOptions options;
  options.result = resultFromTruth("lost_tool.bag", [](softbody_msgs::MeshState*, int) { return true; });
  options.truth = testing::TempDir() + "lost_tool_truth.bag";
  std::filesystem::copy_file(recording(), options.truth, std::filesystem::copy_options::overwrite_existing);
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.stamp = ros::Time(1.6e9);
  pose.pose.pose.orientation.w = 1.0;
  for (const std::string& path : {options.truth, options.result}) {
    pose.header.frame_id = path == options.truth ? "camera_color_optical_frame" : "nowhere";
    rosbag::Bag(path, rosbag::bagmode::Append)
        .write(path == options.truth ? "/ground_truth/tool/pose" : "/softbody/tool/pose", pose.header.stamp,
               pose);
  }
  const Report report = evaluate(options);
  EXPECT_EQ(report.tool->answered, 0u);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("1 of 1 poses of the tool"), std::string::npos) << report.notes[0];
}

TEST(DrawCut, AResultInAnotherFrameThanTheImagesIsRefused) {
  const std::string result = resultFromTruth("drawn.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.frame_id = "world";
    return true;
  });
  const std::string picture = testing::TempDir() + "refused.png", words = testing::TempDir() + "refused.txt";
  const int status = std::system(fmt::format("'{}' '{}' --recording '{}' --output '{}' 2> '{}'", DRAW_CUT,
                                             result, recording(), picture, words)
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  std::stringstream said;
  said << std::ifstream(words).rdbuf();
  EXPECT_NE(said.str().find("the surface is in frame 'world'"), std::string::npos) << said.str();
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(Evaluator, WhatDoesNotFitIsSaidInASentence) {
  EvaluatorOptions options;
  options.result = recording();
  EXPECT_NE(failure(options).find("there is nothing on /softbody/surface/topology"), std::string::npos);

  options.result = resultFromTruth("late.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.stamp += ros::Duration(0.001);
    return true;
  });
  options.truth = recording();
  EXPECT_NE(failure(options).find("no surface has the stamp"), std::string::npos);

  options.result = resultFromTruth("world.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.frame_id = "world";
    return true;
  });
  EXPECT_NE(failure(options).find("'world'"), std::string::npos);

  options.result = resultFromTruth("revision.bag", [](softbody_msgs::MeshState* s, int) {
    s->revision = 3;
    return true;
  });
  EXPECT_NE(failure(options).find("revision 3"), std::string::npos);
}

}  // namespace
}  // namespace softbody::evaluation

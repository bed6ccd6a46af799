#include "softbody_evaluation/ros/evaluator.h"

#include <fmt/format.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/TrackingStatus.h>
#include <test_support/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "fixtures/evaluator_bags.h"
#include "report/report_json.h"
#include "softbody_common/files/input_file.h"

namespace softbody::evaluation {
namespace {

TEST(Evaluator, ThePerfectResultHasNoErrorButTheMillimetreGrid) {
  EvaluatorOptions options = optionsOf(resultFromTruth("perfect.bag", asItIs));
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
  EvaluatorOptions options = optionsOf(shifted("shifted.bag", 0.002f));
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

std::string pageOf(const EvaluatorOptions& options) {
  return readFile(options.report_folder + "/report.html");
}

TEST(Evaluator, TheVerdictOfAResultBesideTheBodyIsWrongWithAndWithoutTruth) {
  for (const bool with_truth : {true, false}) {
    EvaluatorOptions options;
    (with_truth ? options.truth : options.recording) = recording();
    options.report_folder = testing::TempDir() + "evaluator_verdict";
    options.result = resultFromTruth("right.bag", asItIs);
    EXPECT_EQ(toJson(evaluate(options))["verdict"]["level"], "good") << with_truth;
    EXPECT_TRUE(says(pageOf(options), "<section class=good>")) << with_truth;
    options.result = shifted("beside.bag", 0.15f);
    EXPECT_EQ(toJson(evaluate(options))["verdict"]["level"], "wrong") << with_truth;
    const std::string page = pageOf(options);
    EXPECT_TRUE(says(page, "<section class=wrong>")) << with_truth;
    EXPECT_TRUE(says(page, "alt=\"error from four sides\" src=\"data:image/jpeg"));
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

TEST(Evaluator, StatesWithAnOddStampAreLeftOutAlsoIfItRepeats) {
  for (const int states : {1, 2}) {
    EvaluatorOptions options;
    options.truth = recording();
    options.result = resultFromTruth("odd_stamp.bag", [states](softbody_msgs::MeshState* s, int frame) {
      if (frame >= 7 && frame < 7 + states) s->header.stamp = ros::Time(4294967295, 0);
      return true;
    });
    const Report report = evaluate(options);
    EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames - states));
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_TRUE(says(report.notes[0], "alone there"));
    EXPECT_TRUE(says(report.notes[0], fmt::format("{} of {} states", states, kFrames)));
  }
}

TEST(Evaluator, StatesThatAreNoAnswersAreCountedAndSaid) {
  EvaluatorOptions options =
      optionsOf(resultFromTruth("broken.bag", [](softbody_msgs::MeshState* s, int frame) {
        if (frame == 3) s->vertices.at(7).y = std::numeric_limits<float>::quiet_NaN();
        if (frame == 5) s->revision = 9;
        if (frame == 6) s->vertices.pop_back();
        if (frame == 7) s->confidence.clear();
        return true;
      }));
  const Report report = evaluate(options);
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames - 4));
  EXPECT_EQ(report.vertex_error->all.max, 0.0);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_TRUE(says(report.notes[0], "4 of 20 states"));
  EXPECT_TRUE(says(report.notes[0], "vertices[7]"));

  options.result = resultFromTruth("mixed.bag", [](softbody_msgs::MeshState* s, int frame) {
    if (frame > 10) s->header.frame_id = "world";
    return true;
  });
  EXPECT_TRUE(says(failure(options), "'camera_color_optical_frame' and 'world'"));
}

TEST(Evaluator, SilhouettesStageTimesAndThePageAreThere) {
  EvaluatorOptions options;
  options.result = shifted("timed.bag", 0.001f);
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
      status.header.stamp = ros::Time(1.6e9 + k);
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

TEST(Evaluator, AStatusWithoutANewImageIsNoFrame) {
  EvaluatorOptions options = optionsOf(resultFromTruth("live.bag", asItIs));
  {
    rosbag::Bag bag(options.result, rosbag::bagmode::Append);
    softbody_msgs::TrackingStatus status;  // before the first image: without a stamp
    for (int k = 0; k < 3; ++k) bag.write("/softbody/status", ros::Time(1.6e9 + k), status);
    status.header.stamp = ros::Time(1.6e9 + 3);
    status.state = softbody_msgs::TrackingStatus::TRACKING;
    bag.write("/softbody/status", status.header.stamp, status);
    status.state = softbody_msgs::TrackingStatus::LOST;  // once a second while no image comes
    for (int k = 4; k < 7; ++k) bag.write("/softbody/status", ros::Time(1.6e9 + k), status);
  }
  const std::map<std::string, std::size_t> one_frame{{"tracking", 1}};
  EXPECT_EQ(evaluate(options).states, one_frame);
}

TEST(Evaluator, TwoResultsSideBySide) {
  EvaluatorOptions options;
  options.result = shifted("first_of_two.bag", 0.001f);
  const std::string other = shifted("second_of_two.bag", 0.004f);
  options.truth = recording();
  options.report_folder = testing::TempDir() + "evaluator_two";
  const Comparison comparison = evaluateBoth(options, other);
  EXPECT_NEAR(comparison.first.vertex_error->all.mean, 0.001, 1e-7);
  EXPECT_NEAR(comparison.second.vertex_error->all.mean, 0.004, 1e-7);
  EXPECT_EQ(toJson(comparison)["other"]["frames"]["answered"], kFrames);
  for (const char* file : {"report.json", "report.html", "overlay.png", "other_overlay.png"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(options.report_folder) / file)) << file;
}

// Registered depth lies on the grid of the colour image, so the colour's CameraInfo is enough, as it is for
// the graph.
TEST(Evaluator, ARecordingNeedsNoCameraInfoOfDepth) {
  const std::string path = testing::TempDir() + "without_depth_info.bag";
  {
    rosbag::Bag in(recording()), out(path, rosbag::bagmode::Write);
    for (const rosbag::MessageInstance& m : rosbag::View(in)) {
      if (m.getTopic() != "/camera/aligned_depth_to_color/camera_info")
        out.write(m.getTopic(), m.getTime(), m);
    }
  }
  EvaluatorOptions options;
  options.result = resultFromTruth("of_documented_topics.bag", asItIs);
  options.recording = path;
  EXPECT_LT(evaluate(options).residual->residual.max, 0.51e-3);
}

TEST(Evaluator, WhatDoesNotFitIsSaidInASentence) {
  EvaluatorOptions options;
  options.result = recording();
  EXPECT_TRUE(says(failure(options), "there is no message on /softbody/surface/topology"));

  options.result = resultFromTruth("late.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.stamp += ros::Duration(0.001);
    return true;
  });
  options.truth = recording();
  EXPECT_TRUE(says(failure(options), "no surface has the stamp"));

  options.result = resultFromTruth("world.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.frame_id = "world";
    return true;
  });
  EXPECT_TRUE(says(failure(options), "'world'"));

  options.result = resultFromTruth("revision.bag", [](softbody_msgs::MeshState* s, int) {
    s->revision = 3;
    return true;
  });
  EXPECT_TRUE(says(failure(options), "revision 3"));
}

}  // namespace
}  // namespace softbody::evaluation

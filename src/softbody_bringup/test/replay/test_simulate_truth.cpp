#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <softbody_msgs/MeshTopology.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "softbody_evaluation/ros/evaluator.h"
#include "softbody_evaluation/ros/simulate_truth.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

class SimulateTruthTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("softbody_simulate_truth_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    options_ = {ROSBAGS_DIR "/bend_small.bag", CONFIG_DIR "/sponge.yaml", folder_ / "result.bag"};
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string failure() const {
    try {
      evaluation::simulateTruth(options_, [](double) {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
  evaluation::TruthSimulationOptions options_;
};

TEST_F(SimulateTruthTest, PutsTheVisibleVerticesWhereTheyTrulyAre) {
  evaluation::simulateTruth(options_, [](double) {});
  evaluation::EvaluatorOptions evaluation;
  evaluation.result = options_.output;
  evaluation.truth = options_.truth;
  const evaluation::Report report = evaluation::evaluate(evaluation);
  EXPECT_EQ(report.frames.answered, report.frames.expected);
  ASSERT_TRUE(report.vertex_error.has_value());
  EXPECT_LT(report.vertex_error->visible.mean, 2e-4);
  EXPECT_GT(report.vertex_error->hidden.mean, report.vertex_error->visible.mean)
      << "nothing is told of the hidden ones";
}

TEST_F(SimulateTruthTest, SendsTheTopologyAgainAsTheSurfaceDoes) {
  evaluation::simulateTruth(options_, [](double) {});
  const rosbag::Bag bag(options_.output);
  ros::Time first, last, state;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    if (const auto topology = instance.instantiate<softbody_msgs::MeshTopology>()) {
      EXPECT_EQ(topology->header.frame_id, "softbody") << "that of vertices at rest";
      EXPECT_EQ((*instance.getConnectionHeader())["latching"], "1");
      if (first.isZero()) first = topology->header.stamp;
      EXPECT_EQ(topology->header.stamp, first);
      last = instance.getTime();
    } else {
      state = instance.getTime();
    }
    if (!last.isZero()) {
      EXPECT_LE(state - last, ros::Duration(1.0));
    }
  }
  EXPECT_EQ(first, rosbag::View(bag).getBeginTime());
  EXPECT_GT(last, first);
}

/// More vertices than the truth names, at other places.
TEST_F(SimulateTruthTest, ALargerMeshThatIsNotTheTruthsIsNamedToo) {
  options_.object = CONFIG_DIR "/doll.yaml";
  EXPECT_NE(failure().find("doll.yaml is not the mesh of the truth"), std::string::npos);
  EXPECT_FALSE(fs::exists(options_.output));
}

TEST_F(SimulateTruthTest, NamesAnObjectThatIsNotTheTruths) {
  const fs::path object = folder_ / "tetrahedron.yaml";
  std::ofstream(folder_ / "tetrahedron.obj")
      << "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  std::ofstream(object) << "object: {visual_mesh: tetrahedron.obj}\n";
  options_.object = object;
  EXPECT_NE(failure().find("tetrahedron.yaml is not the mesh of the truth"), std::string::npos);
  EXPECT_FALSE(fs::exists(options_.output));
}

}  // namespace
}  // namespace softbody

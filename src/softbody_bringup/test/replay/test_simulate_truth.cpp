#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <softbody_msgs/MeshTopology.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <filesystem>
#include <fstream>

#include "softbody_evaluation/ros/evaluator.h"
#include "softbody_evaluation/ros/simulate_truth.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

class SimulateTruthTest : public ::testing::Test {
 protected:
  std::string failure() const {
    return complaint([&] { evaluation::simulateTruth(options_, [](double) {}); });
  }

  const test::ScratchFolder folder_;
  evaluation::TruthSimulationOptions options_{ROSBAGS_DIR "/bend_small.bag", CONFIG_DIR "/sponge.yaml",
                                              folder_ / "result.bag"};
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
  EXPECT_TRUE(says(failure(), "doll.yaml is not the mesh of the truth"));
  EXPECT_FALSE(fs::exists(options_.output));
}

TEST_F(SimulateTruthTest, NamesAnObjectThatIsNotTheTruths) {
  folder_.write("tetrahedron.obj",
                "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  options_.object = folder_.write("tetrahedron.yaml", "object: {visual_mesh: tetrahedron.obj}\n");
  EXPECT_TRUE(says(failure(), "tetrahedron.yaml is not the mesh of the truth"));
  EXPECT_FALSE(fs::exists(options_.output));
}

}  // namespace
}  // namespace softbody

#include <rosbag/view.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <std_msgs/String.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "replay/recordings.h"
#include "softbody_recordings/ros/replay.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

/// A recording with the true surface of one half of the body as a surface that somebody else tracked.
class KnownSurfaces : public testing::Test {
 protected:
  using States = std::vector<softbody_msgs::MeshState>;

  std::string recording(const std::string& name, bool with_bad_messages) const {
    const rosbag::Bag in(ROSBAGS_DIR "/bend_small.bag");
    rosbag::Bag out(folder_ / name, rosbag::bagmode::Write);
    for (const rosbag::MessageInstance& m : rosbag::View(in)) {
      out.write(m.getTopic(), m.getTime(), m);
      if (const auto topology = m.instantiate<softbody_msgs::MeshTopology>())
        out.write("/half/surface/topology", m.getTime(), half(*topology));
      const auto state = m.instantiate<softbody_msgs::MeshState>();
      if (!state) continue;
      if (with_bad_messages) addBad(*state, m.getTime(), &out);
      out.write("/half/surface/state", m.getTime(), *state);
    }
    return folder_ / name;
  }

  static softbody_msgs::MeshTopology half(softbody_msgs::MeshTopology topology) {
    std::vector<shape_msgs::MeshTriangle> kept;
    for (const shape_msgs::MeshTriangle& triangle : topology.triangles)
      if (topology.rest_vertices[triangle.vertex_indices[0]].x > 0.0f) kept.push_back(triangle);
    topology.triangles = kept;
    topology.triangle_bodies.assign(kept.size(), 0);
    topology.cut_triangles.assign(kept.size(), 0);
    topology.texture_coordinates.clear();
    return topology;
  }

  static void addBad(softbody_msgs::MeshState state, const ros::Time& time, rosbag::Bag* bag) {
    const softbody_msgs::MeshState good = state;
    state.header.stamp += ros::Duration(1e8);
    state.observed = state.header.stamp;
    bag->write("/half/surface/state", time, state);
    state = good;
    state.vertices.front().x = std::numeric_limits<float>::quiet_NaN();
    bag->write("/half/surface/state", time, state);
    state = good;
    state.vertices.pop_back();
    state.confidence.pop_back();
    if (!state.standard_deviation.empty()) state.standard_deviation.pop_back();
    bag->write("/half/surface/state", time - ros::Duration(1e-3), state);
    bag->write("/half/surface/state", time, std_msgs::String());
  }

  States run(const std::string& bag, const std::vector<std::string>& known) {
    ReplayOptions options;
    options.input = bag;
    options.objects = {CONFIG_DIR "/sponge.yaml"};
    options.output = folder_ / "result.bag";
    options.known_surfaces = known;
    options.placed = true;
    warnings_.clear();
    replay(
        options, [this](const std::string& warning) { warnings_.push_back(warning); }, [](double) {});
    return test::messagesOf<softbody_msgs::MeshState>(options.output, "/softbody/surface/state");
  }

  const test::ScratchFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(KnownSurfaces, BadMessagesCostNoFrame) {
  const std::string clean = recording("clean.bag", false), bad = recording("bad.bag", true);
  const States known = run(clean, {"/half/surface"});
  EXPECT_EQ(known.size(), 45U);
  EXPECT_TRUE(warnings_.empty());
  EXPECT_FALSE(known == run(clean, {})) << "the known half is not measured";
  EXPECT_TRUE(known == run(bad, {"/half/surface"}));
  ASSERT_FALSE(warnings_.empty());
  EXPECT_TRUE(says(warnings_.front(), "/half/surface/state"));
}

TEST_F(KnownSurfaces, AMissingTopicIsNamed) {
  EXPECT_TRUE(says(complaint([&] { run(ROSBAGS_DIR "/bend_small.bag", {"/other/surface"}); }),
                   "/other/surface/topology"));
}

}  // namespace
}  // namespace softbody

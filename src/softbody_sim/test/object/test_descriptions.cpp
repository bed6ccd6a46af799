#include <test_support/gtest.h>
#include <yaml-cpp/yaml.h>

#include "fixtures/test_meshes.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/vertex_region.h"

namespace softbody {
namespace {

TEST(VertexRegion, TakesTheVerticesThatMeetAllConditions) {
  const Points vertices = testing::boxTopology({2, 2, 2}, {2.0, 2.0, 2.0}).rest_vertices;
  EXPECT_EQ(verticesWhere("all", vertices).size(), 27u);
  EXPECT_EQ(verticesWhere("x<0.5", vertices).size(), 9u);
  EXPECT_EQ(verticesWhere("x<=1 & y > 1.5", vertices).size(), 6u);
  EXPECT_EQ(verticesWhere(" z>=1e0&z<=1&x<1 ", vertices).size(), 3u);
  for (const char* bad : {"", "w<1", "x=1", "x<1 y<1", "x<one", "x>5"})
    EXPECT_THROW(verticesWhere(bad, vertices), std::invalid_argument) << bad;
}

std::vector<ObstacleDescription> obstaclesOf(const char* yaml, std::vector<std::string>* unknown) {
  Parameters parameters(YAML::Load(yaml), "/simulator/");
  return readObstacles(parameters, unknown);
}

TEST(ObstacleDescription, ReadsEveryShape) {
  std::vector<std::string> unknown;
  const auto obstacles = obstaclesOf(
      "obstacles: [{name: ground, shape: plane, pose: [0, 0, -1, 0, 0, 0, 1]}, "
      "{name: finger, frame: tool, shape: capsule, radius_m: 0.01, length_m: 0.06}, "
      "{name: block, shape: box, size_m: [0.1, 0.2, 0.3], rounding_m: 0.02, color: red}]",
      &unknown);
  ASSERT_EQ(obstacles.size(), 3u);
  EXPECT_TRUE(obstacles[0].shape.half_space);
  EXPECT_EQ(obstacles[0].shape.pose.translation().z(), -1.0);
  EXPECT_EQ(obstacles[1].frame, "tool");
  EXPECT_EQ(obstacles[1].shape.half_extents, Eigen::Vector3d(0.0, 0.0, 0.03));
  EXPECT_NEAR((obstacles[2].shape.half_extents - Eigen::Vector3d(0.03, 0.08, 0.13)).norm(), 0.0, 1e-15);
  EXPECT_EQ(unknown, std::vector<std::string>{"/simulator/obstacles/2/color"});
}

TEST(ObstacleDescription, NamesWhatIsWrong) {
  const auto names = [](const char* yaml, const char* what) {
    std::vector<std::string> unknown;
    EXPECT_TRUE(says(complaint([&] { obstaclesOf(yaml, &unknown); }), what)) << yaml;
  };
  names("obstacles: 3", "/simulator/obstacles");
  names("obstacles: [{shape: sphere}]", "/simulator/obstacles/0/name is missing");
  names("obstacles: [{name: a b}]", "'a b'");
  names("obstacles: [{name: a, shape: cone}]", "/simulator/obstacles/0/shape is 'cone'");
  names("obstacles: [{name: a, radius_m: -1}]", "/simulator/obstacles/0/radius_m is -1");
  names("obstacles: [{name: a, shape: box, size_m: [1, 1, 1], rounding_m: 0.6}]", "rounding_m is 0.6");
  names("obstacles: [{name: a, shape: box, size_m: [1, -1, 1]}]", "size_m is [1, -1, 1]");
  names("obstacles: [{name: a}, {name: a}]", "two obstacles are named 'a'");
  names("obstacles: [{name: a, pose: [0, 0, 0, 0, 0, 0, 0]}]", "quaternion");
}

}  // namespace
}  // namespace softbody

#include <test_support/gtest.h>

#include <stdexcept>

#include "robot/link_shapes.h"
#include "softbody_tracking/robot/robot_description.h"

namespace softbody {
namespace {

TriangleMesh noMesh(const std::string& name) { throw std::invalid_argument(name + ": no such file"); }

/// A tetrahedron with a volume of 1/6.
TriangleMesh corner(const std::string& /*name*/) {
  TriangleMesh mesh{Points(4, 3), Triangles(4, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  return mesh;
}

TriangleMesh only(const std::string& urdf, const RobotMeshReader& read = noMesh) {
  const RobotDescription robot = readRobotDescription(urdf, read);
  EXPECT_EQ(robot.links.size(), 1U);
  EXPECT_TRUE(robot.warnings.empty());
  return robot.links.front().surface;
}

std::string refusal(const std::string& urdf) {
  return complaint([&] { readRobotDescription(urdf, noMesh); });
}

Eigen::RowVector3d extent(const TriangleMesh& mesh) {
  return mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
}

TEST(RobotDescription, ABoxHasItsSizeAndVolume) {
  for (int seed = 0; seed < 20; ++seed) {
    const Eigen::RowVector3d size(drawn(seed, 0, 0.01, 2), drawn(seed, 1, 0.01, 2), drawn(seed, 2, 0.01, 2));
    const TriangleMesh box =
        only(oneLink(visual(fmt::format("<box size=\"{} {} {}\"/>", size.x(), size.y(), size.z()))));
    EXPECT_TRUE(extent(box).isApprox(size, 1e-9));
    EXPECT_NEAR(signedVolume(box), size.prod(), 1e-9);
  }
}

TEST(RobotDescription, RoundLinksStayWithinHalfAMillimetreOrOnePercent) {
  for (int seed = 0; seed < 20; ++seed) {
    const double radius = drawn(seed, 0, 0.002, 1.0), length = drawn(seed, 1, 0.01, 2.0);
    const double share = std::max(0.0005 / radius, 0.01);
    const TriangleMesh cylinder =
        only(oneLink(visual(fmt::format("<cylinder radius=\"{}\" length=\"{}\"/>", radius, length))));
    EXPECT_NEAR(extent(cylinder).z(), length, 1e-9);
    const double volume = M_PI * radius * radius * length;
    EXPECT_LT(signedVolume(cylinder), volume);
    EXPECT_GT(signedVolume(cylinder), volume * (1.0 - 2.5 * share));
    const TriangleMesh sphere = only(oneLink(visual(fmt::format("<sphere radius=\"{}\"/>", radius))));
    EXPECT_LT((sphere.vertices.rowwise().norm().array() - radius).abs().maxCoeff(), 1e-9);
    const double ball = 4.0 / 3.0 * M_PI * std::pow(radius, 3);
    EXPECT_LT(signedVolume(sphere), ball);
    EXPECT_GT(signedVolume(sphere), ball * (1.0 - 4.0 * share));
  }
}

TEST(RobotDescription, AnOriginMovesAShapeAsUrdfSays) {
  for (int seed = 0; seed < 20; ++seed) {
    const Eigen::Vector3d place(drawn(seed, 0, -1, 1), drawn(seed, 1, -1, 1), drawn(seed, 2, -1, 1));
    const Eigen::Vector3d rpy(drawn(seed, 3, -3, 3), drawn(seed, 4, -1.5, 1.5), drawn(seed, 5, -3, 3));
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
    const std::string origin = fmt::format("<origin xyz=\"{} {} {}\" rpy=\"{} {} {}\"/>", place.x(),
                                           place.y(), place.z(), rpy.x(), rpy.y(), rpy.z());
    const TriangleMesh mesh = only(oneLink(visual("<mesh filename=\"any.stl\"/>", origin)), corner);
    const Points expected = (corner("").vertices * turn.transpose()).rowwise() + place.transpose();
    EXPECT_TRUE(mesh.vertices.isApprox(expected, 1e-6));
    EXPECT_NEAR(signedVolume(mesh), 1.0 / 6.0, 1e-9);
  }
}

TEST(RobotDescription, AScaledOrMirroredMeshStaysOutward) {
  for (const char* scale : {"2 3 4", "-2 3 4", "-2 -3 4", "-2 -3 -4"}) {
    const TriangleMesh mesh =
        only(oneLink(visual(fmt::format("<mesh filename=\"any.stl\" scale=\"{}\"/>", scale))), corner);
    EXPECT_NEAR(signedVolume(mesh), 4.0, 1e-9) << scale;
  }
  EXPECT_NE(refusal(oneLink(visual("<mesh filename=\"any.stl\" scale=\"0 1 1\"/>"))), "");
}

TEST(RobotDescription, AllShapesOfALinkCount) {
  const std::string box = "<box size=\"1 1 1\"/>";
  const TriangleMesh mesh = only(oneLink(visual(box) + visual(box, "<origin xyz=\"5 0 0\" rpy=\"0 0 0\"/>")));
  EXPECT_NEAR(signedVolume(mesh), 2.0, 1e-9);
  EXPECT_NEAR(extent(mesh).x(), 6.0, 1e-9);
}

TEST(RobotDescription, CollisionIsUsedWhereVisualCannotBe) {
  const std::string box = "<box size=\"1 1 1\"/>";
  const std::string gone = "<mesh filename=\"package://arm/finger.dae\"/>";
  EXPECT_NEAR(signedVolume(only(oneLink(collision(box)))), 1.0, 1e-9);
  const RobotDescription robot = readRobotDescription(oneLink(visual(gone) + collision(box)), noMesh);
  ASSERT_EQ(robot.links.size(), 1U);
  EXPECT_NEAR(signedVolume(robot.links.front().surface), 1.0, 1e-9);
  ASSERT_EQ(robot.warnings.size(), 1U);
  EXPECT_TRUE(says(robot.warnings.front(), "link finger"));
  EXPECT_TRUE(says(robot.warnings.front(), "package://arm/finger.dae"));
}

TEST(RobotDescription, ABadLinkLeavesTheOthers) {
  const std::string urdf =
      "<robot name=\"arm\"><link name=\"base\">" + visual("<box size=\"1 1 1\"/>") +
      "</link><link name=\"tip\">" + visual("<sphere radius=\"0\"/>") +
      "</link><joint name=\"j\" type=\"fixed\"><parent link=\"base\"/><child link=\"tip\"/></joint></robot>";
  const RobotDescription robot = readRobotDescription(urdf, noMesh);
  ASSERT_EQ(robot.links.size(), 1U);
  EXPECT_EQ(robot.links.front().name, "base");
  ASSERT_EQ(robot.warnings.size(), 1U);
  EXPECT_TRUE(says(robot.warnings.front(), "link tip is left out"));
}

TEST(RobotDescription, BrokenUrdfsAreRefusedWithAReason) {
  for (const std::string& urdf :
       {std::string(), std::string("no xml"), std::string("<robot/>"),
        std::string("<robot name=\"a\"></robot>"), oneLink(""), oneLink(visual("<box size=\"nan 1 1\"/>")),
        oneLink(visual("<box size=\"-1 1 1\"/>")), oneLink(visual("<box size=\"1e300 1 1\"/>")),
        oneLink(visual("<cylinder radius=\"1\"/>")), oneLink(visual("<mesh filename=\"gone.stl\"/>")),
        oneLink(visual("<box size=\"1 1 1\"/>")).substr(0, 60)})
    EXPECT_GT(refusal(urdf).size(), 20U) << urdf;
  EXPECT_TRUE(says(refusal("<robot xmlns:xacro=\"x\"><xacro:arm/></robot>"), "xacro"));
  EXPECT_TRUE(says(refusal(oneLink("")), "no link"));
}

}  // namespace
}  // namespace softbody

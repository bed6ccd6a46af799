#include "measures/rest_symmetry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fixtures/grid_bodies.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody::evaluation {
namespace {

TriangleMesh meshOf(const MeshTopology& topology) { return {topology.rest_vertices, topology.triangles}; }

/// A motion as far from `motion` as a tracked pose is: some degrees and millimetres.
Eigen::Isometry3d near(const Eigen::Isometry3d& motion, std::mt19937* random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto direction = [&] { return Eigen::Vector3d(any(*random), any(*random), any(*random)); };
  return Eigen::Translation3d(0.004 * direction()) * turned(0.06, direction()) * motion;
}

double angleOf(const Eigen::Isometry3d& motion) { return Eigen::AngleAxisd(motion.linear()).angle(); }

TEST(RestSymmetry, ABoxHasFourPosesThatLookAlike) {
  std::mt19937 random(7);
  const TriangleMesh box = meshOf(spongeBox());
  for (const Eigen::Isometry3d& exact :
       {turned(0.0, Eigen::Vector3d::UnitX()), turned(M_PI, Eigen::Vector3d::UnitX()),
        turned(M_PI, Eigen::Vector3d::UnitY()), turned(M_PI, Eigen::Vector3d::UnitZ())}) {
    for (int i = 0; i < 5; ++i) {
      const SelfMap map = nearestSelfMap(box, near(exact, &random));
      EXPECT_TRUE(map.motion.matrix().isApprox(exact.matrix(), 1e-5)) << map.motion.matrix();
      EXPECT_LT(map.misfit_m, 1e-6);
      EXPECT_TRUE(isSymmetry(map, box));
    }
  }
}

TEST(RestSymmetry, AnotherPoseOfABoxIsNoSymmetry) {
  const TriangleMesh box = meshOf(spongeBox());
  for (const double degrees : {50.0, 90.0, 130.0}) {
    const SelfMap map = nearestSelfMap(box, turned(degrees * M_PI / 180.0, Eigen::Vector3d::UnitZ()));
    EXPECT_FALSE(isSymmetry(map, box)) << degrees << ": " << map.misfit_m;
  }
}

TEST(RestSymmetry, ABodyThatDiffersInAPartHasOnePose) {
  TriangleMesh box = meshOf(spongeBox());
  for (Eigen::Index v = 0; v < box.vertices.rows(); ++v) {
    if (box.vertices(v, 0) > 0.06 && box.vertices(v, 2) > 0.0)
      box.vertices(v, 2) += 0.03;  // a bump at one end
  }
  EXPECT_TRUE(isSymmetry(nearestSelfMap(box, turned(0.05, {1.0, 2.0, 3.0})), box));
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval(), Eigen::Vector3d::UnitZ().eval()})
    EXPECT_FALSE(isSymmetry(nearestSelfMap(box, turned(M_PI, axis)), box)) << axis.transpose();
}

/// A rod of 24 sides along z, with caps.
TriangleMesh rod() {
  constexpr int kSides = 24, kRings = 6;
  TriangleMesh mesh;
  mesh.vertices.resize(kSides * kRings + 2, 3);
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < kRings; ++i) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * M_PI * k / kSides;
      mesh.vertices.row(i * kSides + k) << 0.03 * std::cos(angle), 0.03 * std::sin(angle), 0.04 * (i - 2.5);
      const int next = (k + 1) % kSides, a = i * kSides + k, b = i * kSides + next;
      if (i + 1 < kRings) {
        triangles.emplace_back(a, b, b + kSides);
        triangles.emplace_back(a, b + kSides, a + kSides);
      }
      if (i == 0) triangles.emplace_back(kSides * kRings, b, a);
      if (i + 1 == kRings) triangles.emplace_back(kSides * kRings + 1, a, b);
    }
  }
  mesh.vertices.row(kSides * kRings) << 0.0, 0.0, -0.1;
  mesh.vertices.row(kSides * kRings + 1) << 0.0, 0.0, 0.1;
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    mesh.triangles.row(static_cast<Eigen::Index>(f)) = triangles[f];
  return mesh;
}

/// A ball of 60 mm radius: the box's vertices, moved onto it.
TriangleMesh ball() {
  TriangleMesh mesh = meshOf(gridBox({2.0, 2.0, 2.0}, {8, 8, 8}, [](double x) { return x; }));
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    mesh.vertices.row(v) *= 0.06 / mesh.vertices.row(v).norm();
  return mesh;
}

TEST(RestSymmetry, ARodMayTurnAboutItsAxisByAnyAngle) {
  std::mt19937 random(8);
  const TriangleMesh body = rod();
  for (const double degrees : {7.5, 37.0, 101.0}) {
    const double angle = degrees * M_PI / 180.0;
    const SelfMap map = nearestSelfMap(body, near(turned(angle, Eigen::Vector3d::UnitZ()), &random));
    EXPECT_TRUE(isSymmetry(map, body)) << degrees << ": " << map.misfit_m;
    EXPECT_NEAR(angleOf(map.motion), angle, 0.07);  // as in the start; a side is 0.26 wide
    EXPECT_NEAR(map.motion(2, 2), 1.0, 1e-3);
  }
}

TEST(RestSymmetry, ABallMayTurnByAnyAngleAboutAnyAxis) {
  const TriangleMesh body = ball();
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1.0, 0.2, 0.3), Eigen::Vector3d(0.1, -0.4, 1.0)}) {
    const Eigen::Isometry3d start = turned(1.3, axis);
    const SelfMap map = nearestSelfMap(body, Eigen::Translation3d(0.003, -0.002, 0.001) * start);
    EXPECT_TRUE(isSymmetry(map, body)) << map.misfit_m;
    EXPECT_LT(angleOf(map.motion.inverse() * start), 0.02) << "a facet is 0.2 wide";
    EXPECT_LT(map.motion.translation().norm(), 5e-4);
  }
}

TEST(RestSymmetry, TheMotionBetweenTwoStatesIsThatOfTheMaterial) {
  const Points rest = spongeBox().rest_vertices;
  const Eigen::Isometry3d pose = Eigen::Translation3d(0.1, 0.2, 0.6) * turned(0.7, {1.0, 2.0, 3.0}),
                          exact = turned(M_PI, Eigen::Vector3d::UnitY());
  // The result has the material p where the truth has exact * p.
  const Eigen::Isometry3d motion =
      motionBetween(rest, transformed(transformed(rest, exact), pose), transformed(rest, pose));
  EXPECT_TRUE(motion.matrix().isApprox(exact.matrix(), 1e-9)) << motion.matrix();
}

}  // namespace
}  // namespace softbody::evaluation

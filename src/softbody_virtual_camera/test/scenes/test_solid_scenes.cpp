#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "camera/camera_motion.h"
#include "fixtures/scene_fixtures.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"
#include "softbody_virtual_camera/rendering/renderer.h"

namespace softbody::virtual_camera {
namespace {

const Pinhole kSolidCamera = d435(640, 480);

/// Forces in the body's frame, whose z axis is up.
std::vector<SurfaceForce> forcesAt(const Scene& scene, double t) {
  const SceneState state = scene.state(t);
  return transformed(state.T_camera_body.inverse(), *state.forces);
}

/// The largest change of a distance between vertices of an end: 0 if it moves as a rigid body.
double distortionOf(const Points& rest, const Points& moved, double outward, double from) {
  std::vector<Eigen::Index> end;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    if (outward * rest(i, 0) > from) end.push_back(i);
  }
  double largest = 0.0;
  for (const Eigen::Index i : end) {
    const Eigen::Index j = end.front();
    largest = std::max(largest,
                       std::abs((moved.row(i) - moved.row(j)).norm() - (rest.row(i) - rest.row(j)).norm()));
  }
  return largest;
}

TEST(Grip, TheEndsMoveAsRigidBodiesWithTheFists) {
  for (const char* name : {"grip", "doll_grip"}) {
    const Scene& scene = madeScene(name);
    ASSERT_EQ(scene.hands, 2u);
    const Points &rest = scene.actors[0].rest.vertices, start = inBodyFrame(scene, 1.25);
    for (const double t : {1.7, 2.33, 2.81, 3.4, 4.02, 4.55, 5.2}) {
      const Points moved = inBodyFrame(scene, t);
      for (const std::size_t fist : {3u, 4u}) {
        const double outward = fist == 3u ? -1.0 : 1.0;
        EXPECT_LT(distortionOf(rest, moved, outward, 0.0601), 1e-5) << name << " at " << t;
        // The distance of a vertex of the end from one of the fist.
        Eigen::Index end = 0;
        (outward * rest.col(0)).maxCoeff(&end);
        const auto distance = [&](double time, const Points& body) {
          return (inBodyFrame(scene, time, fist).row(0) - body.row(end)).norm();
        };
        EXPECT_NEAR(distance(t, moved), distance(1.25, start), 1e-9) << name << " at " << t;
      }
    }
  }
}

TEST(Grip, BendsTwistsAndStretchesTheBodyInTheAir) {
  const Scene& scene = madeScene("grip");
  const Points rest = inBodyFrame(scene, 0.0);
  Eigen::Index left = 0, right = 0, side = 0;
  (rest * Eigen::Vector3d(-1.0, 0.1, 0.1)).maxCoeff(&left);
  (rest * Eigen::Vector3d(1.0, 0.1, 0.1)).maxCoeff(&right);
  (rest * Eigen::Vector3d(1.0, -0.1, 0.1)).maxCoeff(&side);
  const Points bent = inBodyFrame(scene, 2.4), twisted = inBodyFrame(scene, 3.5),
               long_one = inBodyFrame(scene, 4.45);
  EXPECT_GT(0.5 * (bent(left, 2) + bent(right, 2)) - bent.col(2).mean(), 0.02);
  EXPECT_GT(std::abs(twisted(right, 2) - twisted(side, 2)), 0.05);
  EXPECT_GT(long_one(right, 0) - long_one(left, 0), 0.2 + 0.25 * 0.11 - 2e-3);
  EXPECT_GT(long_one.col(2).mean() - rest.col(2).mean(), 0.028);
  // Of a pulled elastic body the middle becomes thinner.
  double width = 0.0;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    if (std::abs(rest(i, 0)) < 0.011) width = std::max(width, long_one(i, 1) / 0.05);
  }
  EXPECT_LT(width, 0.985);
  EXPECT_GT(width, 0.94);
}

TEST(Grip, TheFistsHideBothEnds) {
  for (const char* name : {"grip", "doll_grip"}) {
    const Scene& scene = madeScene(name);
    const Points& rest = scene.actors[0].rest.vertices;
    Renderer renderer(scene, kSolidCamera);
    RenderedImage image;
    for (const double t : {1.3, 2.4, 3.4, 4.5}) {
      renderer.render(scene.state(t), &image);
      int middle = 0, ends = 0, seen = 0;
      for (Eigen::Index i = 0; i < rest.rows(); ++i) {
        const bool visible = image.visibility[static_cast<std::size_t>(i)] == 1.0f;
        if (std::abs(rest(i, 0)) > 0.06) ++(visible ? seen : ends);
        if (std::abs(rest(i, 0)) < 0.03 && visible) ++middle;
      }
      EXPECT_LE(seen, name == std::string("grip") ? 0 : ends / 20) << name << " at " << t;
      EXPECT_GT(middle, 20) << name << " at " << t;
    }
  }
}

TEST(Stamp, ForcesAreKnownAndInBalance) {
  for (const char* name : {"stamp", "doll_stamp"}) {
    const Scene& scene = madeScene(name);
    for (const double t : {0.0, 1.4, 3.8, 5.0}) EXPECT_TRUE(forcesAt(scene, t).empty()) << name;
    const double largest = -forcesAt(scene, 2.5).at(0).force.z();
    for (const double t : {1.8, 2.1, 2.5, 3.1}) {
      const std::vector<SurfaceForce> forces = forcesAt(scene, t);
      ASSERT_EQ(forces.size(), 2u);
      EXPECT_EQ(forces[0].name, "stamp");
      EXPECT_EQ(forces[1].name, "table");
      EXPECT_LT((forces[0].force + forces[1].force).norm(), 1e-3 * forces[0].force.norm()) << name;
      EXPECT_LT((forces[0].normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
      EXPECT_LT((forces[1].normal + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
      EXPECT_LT((forces[0].place.head<2>() - Eigen::Vector2d(0.02, 0.0)).norm(), 0.03) << name;
      EXPECT_NEAR(forces[1].place.z(), scene.actors[0].rest.vertices.col(2).minCoeff(), 0.2e-3) << name;
      EXPECT_LE(-forces[0].force.z(), 1.001 * largest);
    }
    EXPECT_GT(largest, 2.0) << name;
  }
}

TEST(Stamp, LiesOnTheBodyThatItPresses) {
  for (const char* name : {"stamp", "doll_stamp"}) {
    const Scene& scene = madeScene(name);
    for (const double t : {1.5, 2.0, 2.5, 3.0}) {
      const Points body = inBodyFrame(scene, t), disc = inBodyFrame(scene, t, 3);
      const double low = disc.col(2).minCoeff(), top = low + 0.02;
      double highest = -1.0;
      for (Eigen::Index i = 0; i < body.rows(); ++i) {
        const double aside = (body.row(i).head<2>() - Eigen::RowVector2d(0.02, 0.0)).norm();
        if (aside < 0.029) highest = std::max(highest, body(i, 2));
        if (aside < 0.03) {
          EXPECT_FALSE(body(i, 2) > low + 0.5e-3 && body(i, 2) < top) << name << " at " << t;
        }
      }
      EXPECT_NEAR(highest, low, 0.5e-3) << name << " at " << t;
      EXPECT_GT(body.col(2).minCoeff(), scene.actors[0].rest.vertices.col(2).minCoeff() - 0.3e-3);
    }
  }
}

TEST(Stamp, IsRepeatable) {
  const Scene again = makeScene("stamp", shippedBody("sponge"), 1);
  EXPECT_EQ(again.state(2.2).vertices, madeScene("stamp").state(2.2).vertices);
}

TEST(Stamp, AStifferAndLargerBodyIsPressedHarderIntoTheSameShape) {
  Body large = shippedBody("sponge");
  large.rest.vertices *= 2.0;
  large.elasticity.youngs_modulus_pa *= 3.0;
  const Scene scene = makeScene("stamp", large, 1);
  const SurfaceForce usual = forcesAt(madeScene("stamp"), 2.5)[0], found = forcesAt(scene, 2.5)[0];
  EXPECT_NEAR(found.force.z() / usual.force.z(), 12.0, 1e-3);
  EXPECT_LT((found.place - 2.0 * usual.place).norm(), 1e-3);
  EXPECT_LT((inBodyFrame(scene, 2.5) - 2.0 * inBodyFrame(madeScene("stamp"), 2.5)).cwiseAbs().maxCoeff(),
            1e-6);
}

TEST(Stamp, WithAMovingCameraForcesAreInTheWorld) {
  VirtualCamera camera(withCameraMotion("orbit", madeScene("stamp")), kSolidCamera, noNoise(), 1);
  const Capture capture = camera.capture(75, 2.5);
  const SurfaceForce expected = forcesAt(madeScene("stamp"), 2.5)[0];
  ASSERT_TRUE(capture.forces);
  EXPECT_NEAR(capture.forces->at(0).force.z(), expected.force.z(), 1e-9);
  EXPECT_GT(capture.forces->at(0).place.z(), 0.03);
  EXPECT_FALSE(makeScene("still", shippedBody("sponge"), 1).state(0.0).forces);
}

}  // namespace
}  // namespace softbody::virtual_camera

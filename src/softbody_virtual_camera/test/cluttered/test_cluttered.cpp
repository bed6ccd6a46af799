#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "fixtures/cluttered_fixtures.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

constexpr int kSeeds = 6;
const char* const kOnTable[] = {"neighbour", "twin", "stack", "clutter"};

/// How deep a point is below all faces of a box, in its own frame; negative outside [m].
double depthInBox(const Points& rest, const Eigen::Vector3d& place) {
  const Eigen::Vector3d half = rest.cwiseAbs().colwise().maxCoeff();
  return (half - place.cwiseAbs()).minCoeff();
}

/// The pose of a rigid actor, from its vertices.
Eigen::Isometry3d poseOf(const Points& rest, const Points& now) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.matrix() = Eigen::umeyama(rest.transpose(), now.transpose(), false);
  return T;
}

/// The deepest that points of one actor are inside another one, which is a box or a ball [m].
double overlap(const Scene& scene, const SceneState& state, std::size_t thing, const Points& points) {
  const Points& rest = scene.actors[thing].rest.vertices;
  const Points places = transformed(poseOf(rest, state.vertices[thing]).inverse(), points);
  const bool is_box = rest.rows() == 24;
  double deepest = -1.0;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Eigen::Vector3d place = places.row(i);
    deepest = std::max(deepest, is_box ? depthInBox(rest, place) : rest.row(0).norm() - place.norm());
  }
  return deepest;
}

/// The surface of a mesh, as points at most 4 mm apart.
Points sampled(const Points& vertices, const Triangles& triangles) {
  constexpr double kSpacing = 4e-3;
  std::vector<Eigen::RowVector3d> points;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::RowVector3d a = vertices.row(triangles(f, 0)), u = vertices.row(triangles(f, 1)) - a,
                             v = vertices.row(triangles(f, 2)) - a;
    const int steps = 1 + static_cast<int>(std::max({u.norm(), v.norm(), (u - v).norm()}) / kSpacing);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) points.push_back(a + (i * u + j * v) / steps);
    }
  }
  Points all(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) all.row(static_cast<Eigen::Index>(i)) = points[i];
  return all;
}

TEST(Cluttered, ThingsDoNotIntersectTheBodyOrEachOther) {
  for (const std::string name :
       {"neighbour", "stack", "clutter", "doll_neighbour", "doll_stack", "doll_clutter"}) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const Scene scene = clutteredScene(name, seed);
      for (double t = 0.0; t <= scene.duration_s; t += 0.5) {
        const SceneState state = scene.state(t);
        const Points body = sampled(state.vertices[0], scene.actors[0].rest.triangles);
        for (std::size_t thing = 3; thing < scene.actors.size(); ++thing) {
          EXPECT_LT(overlap(scene, state, thing, body), 1e-6) << name << ' ' << seed << " at " << t;
          for (std::size_t other = 3; other < scene.actors.size(); ++other) {
            if (other == thing) continue;
            const Points points = sampled(state.vertices[other], scene.actors[other].rest.triangles);
            EXPECT_LT(overlap(scene, state, thing, points), 1e-6) << name << ' ' << seed;
          }
        }
      }
    }
  }
}

TEST(Cluttered, NeighbourAndStackTouchTheBodyAndThenLeaveIt) {
  for (const std::string name : {"neighbour", "stack", "doll_neighbour", "doll_stack"}) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const Scene scene = clutteredScene(name, seed);
      const auto depth = [&](double t) {
        const SceneState state = scene.state(t);
        return overlap(scene, state, 3, sampled(state.vertices[0], scene.actors[0].rest.triangles));
      };
      // A triangle of the doll may touch between two samples.
      EXPECT_GT(depth(0.0), -1e-3) << name << ' ' << seed;
      EXPECT_EQ(depth(0.9), depth(0.0));
      EXPECT_LT(depth(2.0), -0.05) << name << ' ' << seed;
    }
  }
}

TEST(Cluttered, ThingsOnTheTableStandOnIt) {
  for (const std::string name : kOnTable) {
    if (name == "stack") continue;
    const Scene scene = clutteredScene(name, 3);
    const SceneState state = scene.state(0.0);
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      if (scene.actors[i].background) continue;
      const Points places = transformed(scene.T_camera_world.inverse(), state.vertices[i]);
      EXPECT_NEAR(places.col(2).minCoeff(), 0.0, 2e-6) << name << ' ' << i;
    }
  }
}

TEST(Cluttered, TwinHasTheBodysMeshAndLooksAndLiesFourMillimetresBesideIt) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = clutteredScene("twin", seed);
    const SceneState state = scene.state(0.0);
    const Points rest = scene.actors[0].rest.vertices;
    EXPECT_EQ(scene.actors[3].rest.triangles, scene.actors[0].rest.triangles);
    const Eigen::Isometry3d T = poseOf(rest, state.vertices[3]);
    EXPECT_LT((transformed(T, rest) - state.vertices[3]).norm(), 1e-9);
    for (const Eigen::Index i : {0, 17, 200}) {
      const Eigen::Vector3d place = rest.row(i);
      EXPECT_EQ(scene.actors[3].texture(place), scene.actors[0].texture(place));
    }
    const Points beside = transformed(state.T_camera_body.inverse(), state.vertices[3]);
    EXPECT_NEAR(beside.col(1).cwiseAbs().minCoeff() - rest.col(1).maxCoeff(), 4e-3, 1e-9);
  }
}

TEST(Cluttered, TheScreenHidesAboutHalfOfTheBody) {
  for (const std::string name : {"clutter", "doll_clutter"}) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      EXPECT_NEAR(uncoveredShare(clutteredScene(name, seed), 0.0), 0.5, 0.12) << name << ' ' << seed;
    }
  }
}

TEST(Cluttered, TheStackedBoxHidesAboutAThirdUntilItIsLifted) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = clutteredScene("stack", seed);
    EXPECT_NEAR(uncoveredShare(scene, 0.0), 2.0 / 3.0, 0.15) << seed;
    EXPECT_EQ(uncoveredShare(scene, 2.3), 1.0) << seed;
    EXPECT_NEAR(uncoveredShare(scene, 4.0), uncoveredShare(scene, 0.0), 0.02) << seed;
  }
}

TEST(Cluttered, TheFistHoldsTheSameEndWhileItMoves) {
  std::set<bool> ends;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = clutteredScene("held", seed);
    const double end = inBodyFrame(scene, 0.0, 3).col(0).mean() > 0.0 ? 1.0 : -1.0;
    ends.insert(end > 0.0);
    EXPECT_LT((inBodyFrame(scene, 2.0, 3) - inBodyFrame(scene, 0.0, 3)).norm(), 1e-9);
    const Points rest = inBodyFrame(scene, 0.0), moved = inBodyFrame(scene, 2.0);
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
      if (end * rest(i, 0) > 0.056) {
        EXPECT_LT((moved.row(i) - rest.row(i)).norm(), 1e-9);
      }
    }
    EXPECT_GT((moved - rest).rowwise().norm().maxCoeff(), 0.01);
    EXPECT_LT(uncoveredShare(scene, 0.0), 0.85);
  }
  EXPECT_EQ(ends.size(), 2u);
}

TEST(Cluttered, EverySeedIsAnotherLayoutOfTheSameBody) {
  for (const std::string name : {"neighbour", "twin", "stack", "clutter", "held"}) {
    std::vector<Points> layouts;
    for (int seed = 1; seed <= 20; ++seed) {
      const Scene scene = clutteredScene(name, seed);
      layouts.push_back(scene.state(0.0).vertices.at(3));
      for (std::size_t other = 0; other + 1 < layouts.size(); ++other) {
        const Points& last = layouts.back();
        ASSERT_TRUE(last.rows() != layouts[other].rows() || (last - layouts[other]).norm() > 1e-3)
            << name << ' ' << seed << ' ' << other;
      }
      const Scene alone = withoutHands(scene);
      EXPECT_EQ(alone.actors.size(), 3u);
      EXPECT_EQ(alone.state(2.0).vertices.at(0), scene.state(2.0).vertices.at(0));
    }
  }
}

TEST(Cluttered, SameSeedGivesTheSameBytesAndTheEndLasts) {
  VirtualCamera one(clutteredScene("clutter", 5), kClutterCamera, {}, 5),
      two(clutteredScene("clutter", 5), kClutterCamera, {}, 5);
  const Capture a = one.capture(3, 0.1), b = two.capture(3, 0.1);
  EXPECT_EQ(cv::norm(a.color, b.color, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(a.depth_mm, b.depth_mm, cv::NORM_INF), 0.0);
  for (const std::string name : {"neighbour", "twin", "stack", "clutter", "held"}) {
    const Scene scene = clutteredScene(name, 2);
    const SceneState end = scene.state(scene.duration_s), later = scene.state(3.7 * scene.duration_s);
    for (std::size_t i = 0; i < end.vertices.size(); ++i)
      EXPECT_LT((end.vertices[i] - later.vertices[i]).norm(), 1e-9);
  }
}

TEST(Cluttered, FitBodiesOfAllSizesAndTextures) {
  for (const double scale : {0.3, 4.0}) {
    Body body = shippedBody("sponge");
    body.rest.vertices *= scale;
    for (const std::string name : {"neighbour", "twin", "stack", "clutter", "held"}) {
      const Scene own = makeScene(name, body, 3), usual = clutteredScene(name, 3);
      const SceneState state = own.state(1.4), expected = usual.state(1.4);
      for (std::size_t i = 0; i < state.vertices.size(); ++i)
        EXPECT_LT((state.vertices[i] / scale - expected.vertices[i]).norm(), 1e-9) << name;
    }
  }
}

}  // namespace
}  // namespace softbody::virtual_camera

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "fixtures/scene_fixtures.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"
#include "softbody_virtual_camera/rendering/renderer.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

const Pinhole kHandCamera = d435(640, 480);

Scene handScene(const std::string& name, const std::string& texture = "plain") {
  return makeScene(name, shippedBody(objectOf(name)), 1, "", texture);
}

/// Distance from the sponge at rest, negative inside.
double distanceFromSponge(const Eigen::Vector3d& place) {
  const Eigen::Vector3d beyond = place.cwiseAbs() - Eigen::Vector3d(0.1, 0.05, 0.02);
  return beyond.maxCoeff() > 0.0 ? beyond.cwiseMax(0.0).norm() : beyond.maxCoeff();
}

using ToRest = std::function<Eigen::Vector3d(const Eigen::Vector3d& place)>;

/// Takes away the bend of `touch`, about the end at x = -0.1.
ToRest straightened(double curvature) {
  return [=](const Eigen::Vector3d& place) -> Eigen::Vector3d {
    if (curvature == 0.0) return place;
    const Eigen::Vector3d center(-0.1, 0.0, 1.0 / curvature), ray = place - center;
    return {std::atan2(ray.x(), -ray.z()) / curvature - 0.1, place.y(),
            1.0 / curvature - std::hypot(ray.x(), ray.z())};
  };
}

ToRest lengthened(double along) {
  const double across = std::pow(along, -0.2);
  return [=](const Eigen::Vector3d& place) -> Eigen::Vector3d {
    return place.cwiseQuotient(Eigen::Vector3d(along, across, across));
  };
}

/// Distances of a hand's vertices from the sponge, in the sponge's rest shape.
std::vector<double> handDistances(const Scene& scene, double t, std::size_t hand, const ToRest& to_rest) {
  const Points places = inBodyFrame(scene, t, hand);
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    distances.push_back(distanceFromSponge(to_rest(places.row(i).transpose())));
  return distances;
}

void expectTouching(const std::vector<double>& distances, const std::string& words) {
  const double nearest = *std::min_element(distances.begin(), distances.end());
  EXPECT_LT(nearest, 0.2e-3) << words;
  EXPECT_GT(nearest, -2.5e-3) << words;
}

TEST(Hands, TouchTheSpongeWhileTheyHoldItAndOnlyThen) {
  const Scene touch = handScene("touch"), squeeze = handScene("squeeze");
  ASSERT_EQ(touch.hands, 1u);
  ASSERT_EQ(squeeze.hands, 2u);
  for (const auto& [t, curvature] :
       {std::pair(1.5, 0.0), std::pair(2.4, 5.0), std::pair(2.5, 5.0), std::pair(3.5, 0.0)})
    expectTouching(handDistances(touch, t, 3, straightened(curvature)), "touch at " + std::to_string(t));
  for (const auto& [t, along] : {std::pair(1.5, 1.0), std::pair(2.4, 0.7), std::pair(3.5, 1.0)}) {
    for (const std::size_t hand : {3u, 4u})
      expectTouching(handDistances(squeeze, t, hand, lengthened(along)), "squeeze at " + std::to_string(t));
  }
  for (const double t : {0.5, 1.0, 3.9, 4.5}) {
    for (const double distance : handDistances(touch, t, 3, straightened(0.0))) EXPECT_GT(distance, 1e-3);
  }
}

TEST(Gripper, HoldsTheEndWhileItIsClosedAndOnlyThen) {
  const Scene scene = handScene("grasp");
  const Points& rest = scene.actors[0].rest.vertices;
  ASSERT_EQ(scene.hands, 3u);
  for (const double t : {0.5, 1.0, 1.2, 1.5, 2.0, 2.5, 3.5, 3.9, 4.9}) {
    const SceneState state = scene.state(t);
    ASSERT_TRUE(state.gripper);
    EXPECT_EQ(state.gripper->closed, t > 1.4 && t < 3.7) << t;
    // Top and bottom of the end, in the gripper's frame: y points from one finger to the other.
    const Points end = transformed(state.gripper->T_camera_gripper.inverse(), state.vertices[0]);
    for (std::size_t finger : {0u, 1u}) {
      const Points pad = transformed(state.gripper->T_camera_gripper.inverse(), state.vertices[4 + finger]);
      const double inner = pad.col(1).cwiseAbs().minCoeff();
      EXPECT_EQ(pad.col(1).mean() > 0.0, finger == 1u);
      if (state.gripper->closed)
        EXPECT_NEAR(inner, 0.02, 1e-9) << t;
      else
        EXPECT_GT(inner, 0.021) << t;
    }
    for (Eigen::Index i = 0; state.gripper->closed && i < rest.rows(); ++i) {
      if (rest(i, 0) < 0.05) continue;  // the fingers reach from x = 0.05 to 0.11
      EXPECT_NEAR(end(i, 2), 0.08 - rest(i, 0), 1e-9) << t;
      EXPECT_NEAR(end(i, 1), rest(i, 2), 1e-9) << t;
    }
  }
}

TEST(Hands, ThumbAndFingersTouchOppositeSides) {
  const Scene scene = handScene("touch");
  const Points places = inBodyFrame(scene, 1.5, 3);
  double over = 1.0, under = 1.0;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    if (places(i, 0) > 0.095) continue;
    if (places(i, 2) > 0.0) over = std::min(over, places(i, 2) - 0.02);
    if (places(i, 2) < 0.0) under = std::min(under, -places(i, 2) - 0.02);
  }
  EXPECT_NEAR(over, 0.0, 0.3e-3);
  EXPECT_NEAR(under, 0.0, 0.3e-3);
}

TEST(Hands, MoveAndTurnWithTheEndThatTheyHold) {
  const Scene scene = handScene("touch");
  const Points rest = inBodyFrame(scene, 1.5), bent = inBodyFrame(scene, 2.5);
  const Points arm = inBodyFrame(scene, 1.5, 3), bent_arm = inBodyFrame(scene, 2.5, 3);
  Eigen::Index end = 0, fixed = 0, elbow = 0;
  rest.col(0).maxCoeff(&end);
  rest.col(0).minCoeff(&fixed);
  arm.col(0).maxCoeff(&elbow);
  EXPECT_LT((bent.row(fixed) - rest.row(fixed)).norm(), 1e-9);
  EXPECT_GT(bent(end, 2) - rest(end, 2), 0.05);
  // The arm turns with the end by curvature times length: 1 rad.
  const Eigen::RowVector3d before = arm.row(elbow) - rest.row(end),
                           after = bent_arm.row(elbow) - bent.row(end);
  EXPECT_NEAR(after.norm(), before.norm(), 1e-3);
  EXPECT_NEAR(std::atan2(after.z(), after.x()) - std::atan2(before.z(), before.x()), 1.0, 1e-2);
}

TEST(Hands, OfSqueezeHideBothEnds) {
  const Scene scene = handScene("squeeze");
  RenderedImage image;
  Renderer renderer(scene, kHandCamera);
  renderer.render(scene.state(0.4), &image);
  const std::vector<float> before = image.visibility;
  renderer.render(scene.state(2.5), &image);
  const Points& rest = scene.actors[0].rest.vertices;
  int seen = 0, hidden = 0, middle = 0;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    const auto vertex = static_cast<std::size_t>(i);
    if (std::abs(rest(i, 0)) > 0.099 && before[vertex] == 1.0f)
      (image.visibility[vertex] == 1.0f ? seen : hidden)++;
    if (std::abs(rest(i, 0)) < 0.02) middle += image.visibility[vertex] == 1.0f;
  }
  EXPECT_GT(hidden, 10);
  EXPECT_LE(seen, hidden / 5);
  EXPECT_GT(middle, 10);
}

TEST(Hands, HaveTheColourOfAPlainBodyAndReachTheEdgeOfTheImage) {
  for (const std::string name : {"touch", "squeeze", "doll_touch", "doll_squeeze"}) {
    const Scene scene = handScene(name);
    RenderedImage image, bare;
    const SceneState state = scene.state(2.5);
    Renderer(scene, kHandCamera).render(state, &image);
    const Scene alone = withoutHands(scene);
    Renderer(alone, kHandCamera).render(alone.state(2.5), &bare);
    const Eigen::Vector3f color = plainColor();
    int count = 0, at_edge = 0;
    for (int v = 1; v + 1 < image.depth.rows; ++v) {
      for (int u = 0; u < image.depth.cols; ++u) {
        const cv::Rect around =
            cv::Rect(u - 1, v - 1, 3, 3) & cv::Rect(0, 0, image.depth.cols, image.depth.rows);
        const cv::Mat1b hand = bare.depth(around) - image.depth(around) > 5e-3f;
        if (cv::countNonZero(hand) < around.area()) continue;
        const cv::Vec3b& seen = image.color(v, u);
        EXPECT_NEAR(seen[2], seen[1] * color.z() / color.y(), 2.5) << name << ' ' << u << ' ' << v;
        ++count;
        at_edge += u == 0 || u + 1 == image.depth.cols || v == 1 || v + 2 == image.depth.rows;
      }
    }
    EXPECT_GT(count, 5000) << name;
    EXPECT_GT(at_edge, 10) << name;
  }
}

TEST(Hands, AreOutOfTheImageAtTheBeginningAndAtTheEnd) {
  for (const std::string name : {"touch", "squeeze", "doll_touch", "doll_squeeze"}) {
    const Scene scene = handScene(name), alone = withoutHands(scene);
    Renderer renderer(scene, kHandCamera), without(alone, kHandCamera);
    for (const double t : {0.0, 0.5, 4.5, 5.0}) {
      RenderedImage image, bare;
      renderer.render(scene.state(t), &image);
      without.render(alone.state(t), &bare);
      EXPECT_EQ(cv::norm(image.depth, bare.depth, cv::NORM_INF), 0.0) << name << " at " << t;
    }
  }
}

}  // namespace
}  // namespace softbody::virtual_camera

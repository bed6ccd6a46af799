#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <sstream>

#include "fixtures/cluttered_fixtures.h"

namespace softbody::virtual_camera {
namespace {

constexpr int kLayouts = 4;

Scene crossing(const std::string& name, int seed) {
  return makeScene(name, shippedBody(objectOf(name)), static_cast<std::uint64_t>(seed), "", "rich",
                   shippedBody(secondObjectOf(name)));
}

/// Depth of the image where a point is, bilinear neighbourhood: nearest and farthest [m].
std::pair<double, double> depthsAt(const cv::Mat1f& depth, const Eigen::Vector3d& place) {
  const Eigen::Vector2d pixel = kClutterCamera.project(place);
  double nearest = 0.0, farthest = 0.0;
  cv::minMaxLoc(depth(cv::Rect(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()), 2, 2)), &nearest,
                &farthest);
  return {nearest, farthest};
}

TEST(TwoBodies, TheTruthOfTheSecondAgreesWithTheDepthImage) {
  for (const std::string name : {"two_bodies", "doll_two_bodies"}) {
    VirtualCamera camera(crossing(name, 2), kClutterCamera, noNoise(), 2);
    ASSERT_TRUE(camera.secondTopology());
    EXPECT_EQ(camera.secondTopology()->rest_vertices.rows(),
              shippedBody(secondObjectOf(name)).rest.vertices.rows());
    for (const double t : {0.0, 1.3, 1.75, 3.0}) {
      const Capture capture = camera.capture(0, t);
      cv::Mat1f depth;
      capture.depth_mm.convertTo(depth, CV_32F, 1e-3);
      ASSERT_TRUE(capture.second);
      int visible = 0, between = 0;
      for (Eigen::Index i = 0; i < capture.second->vertices.rows(); ++i) {
        const Eigen::Vector3d place = capture.second->vertices.row(i);
        if (capture.second->confidence[static_cast<std::size_t>(i)] != 1.0f) continue;
        const auto [nearest, farthest] = depthsAt(depth, place);
        ++visible;
        between += nearest < place.z() + 2e-3 && place.z() < farthest + 2e-3;
      }
      EXPECT_GT(visible, 100) << name << ' ' << t;
      EXPECT_GT(between, 0.97 * visible) << name << ' ' << t;  // a coarse mesh bends between its vertices
    }
  }
}

TEST(TwoBodies, DoNotTouch) {
  for (int seed = 1; seed <= kLayouts; ++seed) {
    const Scene scene = crossing("two_bodies", seed);
    for (const double t : {0.0, 0.9, 1.2, 1.75, 2.3, 3.5}) {
      const std::vector<Points> vertices = scene.state(t).vertices;
      double nearest = 1.0;
      for (Eigen::Index i = 0; i < vertices[0].rows(); ++i)
        nearest = std::min(nearest, (vertices[3].rowwise() - vertices[0].row(i)).rowwise().norm().minCoeff());
      EXPECT_GT(nearest, 5e-3) << seed << " at " << t;
    }
  }
}

TEST(TwoBodies, AreApartAtTheStartAndTheSecondPassesBeforeTheFirst) {
  for (const std::string name : {"two_bodies", "doll_two_bodies"}) {
    for (int seed = 1; seed <= kLayouts; ++seed) {
      const Scene scene = crossing(name, seed);
      EXPECT_EQ(uncoveredShare(scene, 0.0), 1.0) << name << ' ' << seed;
      EXPECT_LT(uncoveredShare(scene, 1.75), 0.7) << name << ' ' << seed;
      EXPECT_EQ(uncoveredShare(scene, 3.2), 1.0) << name << ' ' << seed;
      const SceneState start = scene.state(0.0), end = scene.state(scene.duration_s);
      EXPECT_LT(start.T_camera_second->translation().x() * end.T_camera_second->translation().x(), 0.0);
      for (const double t : {0.0, 0.8, 1.75, 3.5}) {
        const SceneState state = scene.state(t);
        for (Eigen::Index i = 0; i < state.vertices[3].rows(); ++i) {
          const Eigen::Vector3d place = state.vertices[3].row(i);
          const Eigen::Vector2d pixel = kClutterCamera.project(place);
          ASSERT_TRUE(kClutterCamera.contains(pixel.x(), pixel.y())) << name << ' ' << seed << ' ' << t;
          ASSERT_GT((scene.T_camera_world.inverse() * place).z(), 0.0) << name;
        }
      }
      EXPECT_FALSE(withoutHands(scene).second);
      EXPECT_FALSE(withoutHands(scene).state(1.0).T_camera_second);
    }
  }
  EXPECT_THROW(makeScene("two_bodies", shippedBody("sponge"), 1), std::invalid_argument);
}

TEST(Arm, HidesMoreThanFortyPercentForAPartOfTheSceneOnly) {
  for (const std::string name : {"arm", "doll_arm"}) {
    for (int seed = 1; seed <= 2 * kLayouts; ++seed) {
      const Scene scene = clutteredScene(name, seed);
      EXPECT_EQ(uncoveredShare(scene, 0.0), 1.0) << name << ' ' << seed;
      EXPECT_EQ(uncoveredShare(scene, scene.duration_s), 1.0) << name << ' ' << seed;
      EXPECT_LT(uncoveredShare(scene, 2.0), 0.6) << name << ' ' << seed;
      EXPECT_GT(uncoveredShare(scene, 2.0), 0.1) << name << ' ' << seed;
    }
  }
}

/// Depth along the ray of a pixel to a link's box or cylinder, from its pose on tf alone; 0: it misses it.
double linkDepth(const RobotLink& link, const Eigen::Isometry3d& T_camera_link, const Eigen::Vector3d& ray) {
  const Eigen::Isometry3d T_shape_camera = (T_camera_link * link.T_link_shape).inverse();
  const Eigen::Vector3d eye = T_shape_camera.translation(), way = T_shape_camera.linear() * ray;
  double enter = 0.0, leave = 1e9;
  const auto slab = [&](int axis, double half) {
    const double a = (-half - eye[axis]) / way[axis], b = (half - eye[axis]) / way[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  };
  if (link.radius_m > 0.0) {
    slab(2, 0.5 * link.length_m);
    const double a = way.head<2>().squaredNorm(), b = eye.head<2>().dot(way.head<2>()),
                 c = eye.head<2>().squaredNorm() - link.radius_m * link.radius_m;
    if (b * b < a * c) return 0.0;
    enter = std::max(enter, (-b - std::sqrt(b * b - a * c)) / a);
    leave = std::min(leave, (-b + std::sqrt(b * b - a * c)) / a);
  } else {
    for (int axis = 0; axis < 3; ++axis) slab(axis, 0.5 * link.box[axis]);
  }
  return enter < leave ? enter : 0.0;
}

TEST(Arm, PosesOfTheLinksAgreeWithTheDepthImage) {
  const Scene scene = clutteredScene("arm", 3);
  Renderer renderer(scene, kClutterCamera);
  for (const double t : {1.2, 2.0, 2.9}) {
    const SceneState state = scene.state(t);
    RenderedImage image;
    renderer.renderDepth(state, &image);
    int arm = 0, agree = 0;
    for (int v = 0; v < image.depth.rows; v += 3) {
      for (int u = 0; u < image.depth.cols; u += 3) {
        if (image.labels(v, u) != 2) continue;
        const Eigen::Vector3d ray((u - kClutterCamera.cx) / kClutterCamera.fx,
                                  (v - kClutterCamera.cy) / kClutterCamera.fy, 1.0);
        double nearest = 1e9;
        for (std::size_t i = 0; i < scene.robot.size(); ++i) {
          const double depth = linkDepth(scene.robot[i], state.links[i].T_camera_link, ray);
          if (depth > 0.0) nearest = std::min(nearest, depth);
        }
        ++arm;
        agree += std::abs(nearest - image.depth(v, u)) < 2e-3;  // the cylinder is rendered as a prism
      }
    }
    EXPECT_GT(arm, 300) << t;
    EXPECT_GT(agree, 0.97 * arm) << t;
  }
}

TEST(Arm, LinksAreConnectedByTheJointsOfTheUrdf) {
  const Scene scene = clutteredScene("doll_arm", 1);
  for (const double t : {0.0, 1.4, 2.2}) {
    const std::vector<LinkPose> links = scene.state(t).links;
    ASSERT_EQ(links.size(), scene.robot.size());
    for (std::size_t i = 1; i < links.size(); ++i) {
      const Eigen::Isometry3d joint =
          (links[i - 1].T_camera_link * scene.robot[i].T_parent_joint).inverse() * links[i].T_camera_link;
      EXPECT_LT(joint.translation().norm(), 1e-9);
      EXPECT_NEAR(joint.linear()(2, 2), 1.0, 1e-9);
    }
  }
}

TEST(Arm, TheShippedUrdfIsTheRobotOfTheScene) {
  std::ifstream file(CONFIG_DIR "/arm.urdf");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), urdfText(clutteredScene("arm", 1).robot));
  EXPECT_EQ(text.str(), urdfText(clutteredScene("doll_arm", 5).robot));
}

}  // namespace
}  // namespace softbody::virtual_camera

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>

#include "elastic/pressed_states.h"
#include "fixtures/scene_fixtures.h"

namespace softbody::virtual_camera {
namespace {

const char* const kHeldScenes[] = {"pull_held", "bend_held", "twist_held", "push_held", "press_held"};

std::map<std::string, Eigen::Isometry3d> framesAt(const Scene& scene, double t) {
  const SceneState state = scene.state(t);
  std::map<std::string, Eigen::Isometry3d> frames;
  for (const FramePose& thing : state.frames) frames[thing.name] = thing.T_camera_frame;
  if (state.gripper) frames["gripper"] = state.gripper->T_camera_gripper;
  return frames;
}

/// What the body does to all things together, in the optical frame: force and torque about the camera.
/// @param largest_n of the forces, or of the torques over 0.1 m.
Eigen::Matrix<double, 6, 1> sumOfWrenches(const Scene& scene, double t, double* largest_n) {
  const auto frames = framesAt(scene, t);
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const ContactWrench& wrench : scene.state(t).wrenches) {
    const Eigen::Isometry3d& T = frames.at(wrench.name);
    const Eigen::Vector3d force = T.linear() * wrench.force;
    sum.head<3>() += force;
    sum.tail<3>() += T.linear() * wrench.torque + T.translation().cross(force);
    *largest_n = std::max({*largest_n, force.norm(), wrench.torque.norm() / 0.1});
  }
  return sum;
}

double wayBetween(const Scene& scene, double from, double to) {
  return (inBodyFrame(scene, to) - inBodyFrame(scene, from)).rowwise().norm().maxCoeff();
}

TEST(Held, WhatHoldsAndPressesTheBodyIsInBalance) {
  for (const char* name : kHeldScenes) {
    const Scene& scene = madeScene(name);
    for (const double t : {1.6, 2.6, 3.5, 4.8, 5.4}) {
      double largest = 0.0;
      const auto sum = sumOfWrenches(scene, t, &largest);
      EXPECT_GT(largest, 0.2) << name << " at " << t;
      EXPECT_LT(sum.head<3>().norm(), 0.01 * largest) << name << " at " << t;
      EXPECT_LT(sum.tail<3>().norm(), 0.003 * largest) << name << " at " << t;
    }
  }
}

TEST(Held, TheBodyMovesInTheLastFifthAndElsewhere) {
  for (const char* name : kHeldScenes) {
    const Scene& scene = madeScene(name);
    EXPECT_GE(scene.duration_s, 5.0);
    EXPECT_LE(scene.duration_s, 6.0);
    EXPECT_GT(wayBetween(scene, 0.8 * scene.duration_s, scene.duration_s), 3e-3) << name;
    EXPECT_GT(wayBetween(scene, 0.5, 2.5), 3e-3) << name;
  }
}

TEST(Held, TheEndsFollowClampAndGripper) {
  for (const char* name : {"pull_held", "bend_held", "twist_held", "press_held"}) {
    const Scene& scene = madeScene(name);
    const Points& rest = scene.actors[0].rest.vertices;
    const auto inFrame = [&](double t, const std::string& frame) {
      return transformed(framesAt(scene, t).at(frame).inverse(), scene.state(t).vertices[0]);
    };
    EXPECT_TRUE(scene.state(0.0).gripper->closed);
    for (const double t : {1.7, 3.0, 5.1}) {
      const Points clamp_start = inFrame(0.0, "clamp"), clamp_now = inFrame(t, "clamp");
      const Points start = inFrame(0.0, "gripper"), now = inFrame(t, "gripper");
      for (Eigen::Index i = 0; i < rest.rows(); ++i) {
        if (rest(i, 0) < -0.0599) {
          ASSERT_LT((clamp_now.row(i) - clamp_start.row(i)).norm(), 1e-6) << name;
        }
        if (rest(i, 0) > 0.0599) {
          ASSERT_LT((now.row(i) - start.row(i)).norm(), 1e-6) << name;
        }
      }
    }
  }
}

TEST(Held, AStifferAndLargerBodyPullsHarder) {
  Body large = shippedBody("sponge");
  large.rest.vertices *= 2.0;
  large.elasticity.youngs_modulus_pa *= 3.0;
  const Scene scene = makeScene("pull_held", large, 1);
  const ContactWrench small = madeScene("pull_held").state(3.1).wrenches.at(1),
                      found = scene.state(3.1).wrenches.at(1);
  EXPECT_LT((found.force - 12.0 * small.force).norm(), 1e-3 * found.force.norm());
  EXPECT_LT((found.torque - 24.0 * small.torque).norm(), 1e-3 * found.torque.norm());
}

TEST(Held, APulledBodyPullsAsHookesLawSays) {
  const Scene& scene = madeScene("pull_held");
  // By 20 %: stiffer than a free bar, because its ends keep their size, and softer, because it becomes
  // thinner.
  const double expected = 2.0e4 * 0.2 * 0.1 * 0.04;
  EXPECT_NEAR(scene.state(1.95).wrenches.at(1).force.z(), expected, 0.2 * expected);
}

TEST(Pressed, TheWrenchOnAStampIsThatOfAForceAtItsPlace) {
  const Eigen::Vector3d place(0.03, -0.02, 0.05), force(0.4, 0.7, -2.0);
  const Eigen::Isometry3d T_solver_stamp =
      Eigen::Translation3d(0.1, 0.2, 0.3) *
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, 2.0, -1.0).normalized());
  const ContactWrench wrench = wrenchOn("stamp", T_solver_stamp, {force, place, place.cross(force)});
  const Eigen::Vector3d on_stamp = -(T_solver_stamp.linear().transpose() * force);
  EXPECT_LT((wrench.force - on_stamp).norm(), 1e-12);
  EXPECT_LT((wrench.torque - (T_solver_stamp.inverse() * place).cross(on_stamp)).norm(), 1e-12);
}

TEST(Plates, AreInBalanceWithTheForceOfTheBlock) {
  const Scene& scene = madeScene("plates");
  const auto frames = framesAt(scene, 2.8);
  const ContactWrench wrench = scene.state(2.8).wrenches.at(0);
  EXPECT_EQ(wrench.name, "plate");
  const Eigen::Isometry3d T_table_plate = frames.at("table_plate").inverse() * frames.at("plate");
  const double shorter = (0.1 + T_table_plate.translation().z()) / 0.1;  // the axes point apart
  EXPECT_GT(shorter, 0.1);
  EXPECT_LT(shorter, 0.17);
  EXPECT_NEAR(wrench.force.z(), 2.0e4 * shorter * 0.2 * 0.04, 0.15 * wrench.force.z());
  EXPECT_LT(wrench.force.head<2>().norm(), 1e-3 * wrench.force.z());
  EXPECT_LT(wrench.torque.norm(), 1e-3 * wrench.force.z());
  EXPECT_LT(scene.state(0.3).wrenches.at(0).force.norm(), 1e-9);
  // The body touches both plates and becomes wider in between.
  const Points body = inBodyFrame(scene, 2.8);
  EXPECT_NEAR(body.col(1).maxCoeff() - body.col(1).minCoeff(), 0.1 * (1.0 - shorter), 0.4e-3);
  EXPECT_GT(body.col(0).maxCoeff(), 0.1 + 1e-3);
}

}  // namespace
}  // namespace softbody::virtual_camera

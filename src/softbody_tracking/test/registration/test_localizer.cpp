#include <gtest/gtest.h>

#include "fixtures/synthetic_scene.h"
#include "registration/localizer.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

const BoxBody kBox = makeBox();
const TriangleMesh kMesh{kBox.surface.rest_vertices, kBox.surface.triangles};

const Localizer& localizer() {
  static const Localizer result(kMesh, RegistrationConfig());
  return result;
}

Eigen::Isometry3d nearPose() { return Eigen::Translation3d(-0.1, 0.0, 0.0) * boxPose(); }
Eigen::Isometry3d farPose() { return Eigen::Translation3d(0.2, 0.1, 0.3) * boxPose(); }

/// A body whose depth is exact, or noisy.
RgbdFrame bodyAt(const Eigen::Isometry3d& pose, double noise_m) {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, pose), 1);
  cv::Mat1f noise(frame.depth.size());
  cv::theRNG().state = 1;
  cv::randn(noise, 0.0, noise_m);
  cv::add(frame.depth, noise, frame.depth, frame.depth < 1.2f);
  return frame;
}

RgbdFrame both(const RgbdFrame& one, const RgbdFrame& other) {
  RgbdFrame frame = one;
  other.color.copyTo(frame.color, other.depth < one.depth);
  frame.depth = cv::min(one.depth, other.depth);
  return frame;
}

bool isAt(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& place) {
  return (pose.translation() - place.translation()).norm() < 0.05;
}

double unknown(const Eigen::Isometry3d&) { return -1.0; }

TEST(Localizer, CountsPosesAlikeInOnePlaceOnly) {
  const RgbdFrame noisy = bodyAt(nearPose(), 0.004);
  const auto alone = localizer().anywhere(noisy, ColorModel(), {}, unknown);
  const auto beside = localizer().anywhere(both(noisy, bodyAt(farPose(), 0.0)), ColorModel(), {}, unknown);
  ASSERT_TRUE(alone && beside);
  EXPECT_GT(alone->alike, 1) << "a box has poses that look alike";
  EXPECT_EQ(beside->alike, alone->alike);
  EXPECT_TRUE(isAt(beside->pose, nearPose()));
}

TEST(Localizer, CountsNoPoseThatFitsWorse) {
  BoxBody wedge = kBox;
  for (auto vertex : wedge.surface.rest_vertices.rowwise()) {
    vertex.z() *= 1.0 + 6.0 * vertex.x() + 5.0 * vertex.y();
    vertex.y() *= 1.0 + 2.0 * vertex.x();
  }
  const TriangleMesh mesh{wedge.surface.rest_vertices, wedge.surface.triangles};
  const RgbdFrame frame = renderFrame(wedge, transformed(mesh.vertices, boxPose()), 1);
  const auto found = Localizer(mesh, RegistrationConfig()).anywhere(frame, ColorModel(), {}, unknown);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->alike, 1);
}

/// Thinner than the cells of a coarse mesh.
TEST(Localizer, FindsAThread) {
  BoxBody thread = makeBox(220, 4, 4);
  thread.surface.rest_vertices.col(1) *= 0.03;
  thread.surface.rest_vertices.col(2) *= 0.06;
  thread.surface.rest_vertices.rightCols(2).array() += 0.0017;  // in a single row of cells
  const TriangleMesh mesh{thread.surface.rest_vertices, thread.surface.triangles};
  const RgbdFrame frame = renderFrame(thread, transformed(mesh.vertices, boxPose()), 1);
  const auto found =
      Localizer(mesh, RegistrationConfig()).anywhere(frame, ColorModel(), {boxPose()}, unknown);
  ASSERT_TRUE(found);
  EXPECT_TRUE(isAt(found->pose, boxPose()));
}

TEST(Localizer, TakesTheNextPlaceIfItsFeaturesAreThere) {
  const RgbdFrame frame = both(bodyAt(nearPose(), 0.0), bodyAt(farPose(), 0.005));
  for (double share_of_near : {0.0, -1.0}) {
    const auto found = localizer().anywhere(frame, ColorModel(), {}, [&](const Eigen::Isometry3d& pose) {
      return isAt(pose, farPose()) ? 0.8 : share_of_near;
    });
    ASSERT_TRUE(found);
    EXPECT_TRUE(isAt(found->pose, farPose()));
    EXPECT_EQ(found->alike, 1);
  }
}

TEST(Localizer, DoesNotTakeTheNextPlaceUnlessItsFeaturesAreThere) {
  const RgbdFrame frame = both(bodyAt(nearPose(), 0.0), bodyAt(farPose(), 0.005));
  for (double share_of_far : {0.0, -1.0}) {
    EXPECT_FALSE(localizer().anywhere(frame, ColorModel(), {}, [&](const Eigen::Isometry3d& pose) {
      return isAt(pose, nearPose()) ? 0.0 : share_of_far;
    }));
  }
}

TEST(Localizer, PrefersAPoseOfWhichNothingIsKnownToOneWithoutItsFeatures) {
  int asked = 0;
  const auto found =
      localizer().anywhere(bodyAt(nearPose(), 0.0), ColorModel(), {},
                           [&](const Eigen::Isometry3d&) { return asked++ == 0 ? -1.0 : 0.0; });
  EXPECT_GT(asked, 1);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->alike, 1);
}

TEST(Localizer, TriesEveryPoseOfABoxThatLooksAlike) {
  const RgbdFrame frame = bodyAt(nearPose(), 0.0);
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d::Zero().eval(), Eigen::Vector3d::UnitX().eval(),
                                      Eigen::Vector3d::UnitY().eval(), Eigen::Vector3d::UnitZ().eval()}) {
    const Eigen::Isometry3d truth = nearPose() * Eigen::AngleAxisd(axis.isZero() ? 0.0 : M_PI, axis);
    const auto found = localizer().anywhere(frame, ColorModel(), {}, [&](const Eigen::Isometry3d& pose) {
      return Eigen::AngleAxisd((pose.inverse() * truth).linear()).angle() < 0.2 ? 0.9 : 0.05;
    });
    EXPECT_TRUE(found) << axis.transpose();
  }
}

}  // namespace
}  // namespace softbody

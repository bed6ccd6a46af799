#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <vector>

#include "ros/random_bodies.h"
#include "softbody_common/geometry/tet_topology_check.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"

namespace softbody {
namespace {

class RoundTrip : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RoundTrip, testing::Range(0u, 6u));

TEST_P(RoundTrip, Pose) {
  std::mt19937 random(GetParam());
  const Eigen::Isometry3d pose = randomMotion(&random);
  EXPECT_TRUE(fromMessage(toMessage(pose)).isApprox(pose, 1e-12));
}

TEST_P(RoundTrip, TetTopology) {
  const TetTopology before = randomVolume(GetParam()), after = fromMessage(toMessage(before));
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_LT((after.rest_vertices - before.rest_vertices).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(after.tets, before.tets);
  EXPECT_EQ(after.surface, before.surface);
  EXPECT_EQ(after.vertex_parents, before.vertex_parents);
  EXPECT_EQ(after.tet_pieces, before.tet_pieces);
  EXPECT_EQ(after.has_initial_pose, before.has_initial_pose);
  EXPECT_TRUE(after.initial_pose.isApprox(before.initial_pose, 1e-12));
}

/// Every field but header and initial pose makes another topology.
TEST_P(RoundTrip, SameTopology) {
  const auto volume = toMessage(randomVolume(GetParam()));
  auto resent = volume;
  resent.header.stamp = ros::Time(5.0);
  resent.initial_pose.position.x += 1.0;
  EXPECT_TRUE(sameTopology(volume, volume));
  EXPECT_TRUE(sameTopology(volume, resent));
  using Volume = softbody_msgs::TetTopology;
  for (const auto& change : std::vector<std::function<void(Volume&)>>{
           [](Volume& m) { ++m.revision; }, [](Volume& m) { m.rest_vertices.back().z += 1e-3f; },
           [](Volume& m) { m.rest_vertices.pop_back(); },
           [](Volume& m) { ++m.tets.back().vertex_indices[3]; },
           [](Volume& m) { ++m.surface_triangles.back().vertex_indices[2]; },
           [](Volume& m) { ++m.vertex_parents.back(); }, [](Volume& m) { ++m.tet_bodies.back(); }}) {
    auto other = volume;
    change(other);
    EXPECT_FALSE(sameTopology(volume, other));
  }
  const auto surface = toMessage(randomSurface(GetParam()));
  EXPECT_TRUE(sameTopology(surface, softbody_msgs::MeshTopology(surface)));
  using Surface = softbody_msgs::MeshTopology;
  for (const auto& change : std::vector<std::function<void(Surface&)>>{
           [](Surface& m) { ++m.revision; }, [](Surface& m) { m.rest_vertices.front().x += 1e-3f; },
           [](Surface& m) { ++m.triangles.back().vertex_indices[0]; },
           [](Surface& m) { ++m.vertex_parents.front(); }, [](Surface& m) { ++m.triangle_bodies.back(); },
           [](Surface& m) { m.cut_triangles.back() ^= 1; },
           [](Surface& m) { m.texture_coordinates.emplace_back(); }}) {
    auto other = surface;
    change(other);
    EXPECT_FALSE(sameTopology(surface, other));
  }
}

TEST_P(RoundTrip, MeshTopology) {
  const MeshTopology before = randomSurface(GetParam()), after = fromMessage(toMessage(before));
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_LT((after.rest_vertices - before.rest_vertices).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(after.triangles, before.triangles);
  EXPECT_EQ(after.vertex_parents, before.vertex_parents);
  EXPECT_EQ(after.triangle_pieces, before.triangle_pieces);
  EXPECT_EQ(after.cut, before.cut);
  EXPECT_TRUE(after.texture_coordinates.isApprox(before.texture_coordinates, 1e-6));
}

TEST_P(RoundTrip, MeshState) {
  MeshState before;
  before.revision = GetParam();
  before.observed = 1'600'000'000'123'456'789LL;
  before.vertices = Points::Random(30, 3);
  before.confidence.assign(30, 0.25f);
  before.standard_deviation.assign(30, 0.001f * static_cast<float>(GetParam()));
  const MeshState after = fromMessage(toMessage(before));
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_EQ(after.observed, before.observed);
  EXPECT_LT((after.vertices - before.vertices).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(after.confidence, before.confidence);
  EXPECT_EQ(after.standard_deviation, before.standard_deviation);
}

TEST_P(RoundTrip, Targets) {
  const TargetSet before = randomTargets(GetParam()), after = fromMessage(toMessage(before));
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_EQ(after.reset, before.reset);
  EXPECT_TRUE(after.body_pose.isApprox(before.body_pose, 1e-12));
  ASSERT_EQ(after.targets.size(), before.targets.size());
  for (std::size_t i = 0; i < after.targets.size(); ++i) {
    const Target &a = after.targets[i], &b = before.targets[i];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.place.tet, b.place.tet);
    EXPECT_LT((a.place.barycentric - b.place.barycentric).norm(), 1e-6);
    EXPECT_LT((a.position - b.position).norm() + (a.normal - b.normal).norm(), 1e-6);
    EXPECT_NEAR(a.weight, b.weight, 1e-6);
  }
}

TEST_P(RoundTrip, Cut) {
  const MeshTopology mesh = randomSurface(GetParam());
  Cut before{GetParam(), GetParam() / 2, static_cast<CutKind>(GetParam() % 4), {}};
  if (before.kind == CutKind::kCut) before.patch = {mesh.rest_vertices, mesh.triangles};
  const Cut after = fromMessage(toMessage(before));
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_EQ(after.stroke, before.stroke);
  EXPECT_EQ(after.kind, before.kind);
  ASSERT_EQ(after.patch.vertices.rows(), before.patch.vertices.rows());
  EXPECT_TRUE(after.patch.vertices.isApprox(before.patch.vertices, 1e-7));
  EXPECT_EQ(after.patch.triangles, before.patch.triangles);
}

TEST_P(RoundTrip, CutHistory) {
  const TetTopology uncut = randomVolume(GetParam());
  const EditHistory before = someEdits(GetParam());
  const EditedBody after = fromMessage(toMessage(before, uncut));
  EXPECT_EQ(after.edits.body, before.body);
  EXPECT_EQ(after.edits.revision, before.revision);
  EXPECT_TRUE(sameEdits(after.edits, before));
  EXPECT_TRUE(sameRestBody(after.uncut, uncut));
}

TEST(Conversions, StatusKeepsItsWords) {
  TrackingStatus status;
  status.state = TrackingState::kLost;
  status.reason = "out of sight";
  EXPECT_EQ(toMessage(status).state, softbody_msgs::TrackingStatus::LOST);
  EXPECT_EQ(toMessage(status).reason, "out of sight");
}

TEST(Conversions, CamerasComeFromPOrElseFromK) {
  const Pinhole camera{640, 480, 600.0, 601.0, 320.0, 240.0};
  sensor_msgs::CameraInfo info = toMessage(camera);
  EXPECT_EQ(pinholeFromMessage(info), camera);
  info.K.fill(0.0);
  EXPECT_EQ(pinholeFromMessage(info), camera);
  info = toMessage(camera);
  info.P.fill(0.0);
  EXPECT_EQ(pinholeFromMessage(info), camera);
}

TEST(Conversions, UnusableCamerasAreRefused) {
  const sensor_msgs::CameraInfo good = toMessage(Pinhole{640, 480, 600.0, 601.0, 320.0, 240.0});
  const auto refused = [&good](const std::function<void(sensor_msgs::CameraInfo&)>& spoil) {
    sensor_msgs::CameraInfo info = good;
    spoil(info);
    EXPECT_THROW(pinholeFromMessage(info), std::invalid_argument);
  };
  refused([](auto& info) { info = sensor_msgs::CameraInfo(); });
  refused([](auto& info) { info.width = 0; });
  refused([](auto& info) { info.height = 0xffffffffu; });
  refused([](auto& info) { info.P[0] = -600.0; });
  refused([](auto& info) { info.P[5] = 0.0; });
  refused([](auto& info) { info.P[0] = NAN; });
  refused([](auto& info) { info.P[0] = INFINITY; });
  refused([](auto& info) { info.P[2] = NAN; });
  refused([](auto& info) { info.P[0] = 1e300; });
  refused([](auto& info) { info.P[5] = 1e-300; });
  refused([](auto& info) { info.P[6] = 1e20; });
  refused([](auto& info) { info.width = 1u << 20; });
}

TEST(Conversions, StampsKeepEveryNanosecond) {
  for (const Nanoseconds stamp : {0LL, 1LL, 999'999'999LL, 1'600'000'000'000'000'001LL}) {
    EXPECT_EQ(toNanoseconds(toTime(stamp)), stamp);
  }
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "random_meshes.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_topology_check.h"

namespace softbody {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TetTopology randomVolume(unsigned seed) {
  std::mt19937 random(seed);
  const TetMesh mesh = shakenBlock(2, 2, 1, 0.03, 0.15, &random);
  TetTopology topology;
  topology.revision = seed;
  topology.rest_vertices = mesh.vertices;
  topology.tets = mesh.tets;
  topology.surface = boundaryTriangles(mesh.tets);
  topology.tet_pieces = tetPieces(mesh.tets, static_cast<int>(mesh.vertices.rows()));
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    topology.vertex_parents.push_back(static_cast<int>(v) - 1);
  topology.has_initial_pose = seed % 2 == 0;
  if (topology.has_initial_pose) topology.initial_pose = randomMotion(&random);
  return topology;
}

MeshTopology randomSurface(unsigned seed) {
  const TetTopology volume = randomVolume(seed);
  MeshTopology topology;
  topology.revision = seed;
  topology.rest_vertices = volume.rest_vertices;
  topology.triangles = volume.surface;
  topology.vertex_parents = volume.vertex_parents;
  topology.triangle_pieces.assign(static_cast<std::size_t>(volume.surface.rows()), 1u);
  for (Eigen::Index f = 0; f < volume.surface.rows(); ++f) topology.cut.push_back(f % 3 == 0);
  if (seed % 2 == 0) topology.texture_coordinates = Points::Random(3 * volume.surface.rows(), 3);
  return topology;
}

TargetSet randomTargets(unsigned seed) {
  std::mt19937 random(seed);
  TargetSet set;
  set.revision = seed;
  set.reset = seed % 2 == 1;
  set.body_pose = randomMotion(&random);
  for (int i = 0; i < 20; ++i) {
    Target target;
    target.kind = static_cast<TargetKind>(i % 4);
    target.place.tet = i;
    const Eigen::Vector3d weights = randomPoint(-2.0, 2.0, &random);
    target.place.barycentric << weights, 1.0 - weights.sum();
    target.position = randomPoint(-1.0, 1.0, &random);
    if (i % 2 == 0) target.normal = randomPoint(-1.0, 1.0, &random).normalized();
    target.weight = 0.1 + i;
    set.targets.push_back(target);
  }
  return set;
}

/// Fails unless the message is refused with a sentence that holds these words.
template <typename Message>
void expectRefused(Message message, const std::function<void(Message&)>& spoil, const std::string& words) {
  ASSERT_NO_THROW(fromMessage(message));
  spoil(message);
  try {
    fromMessage(message);
    ADD_FAILURE() << "accepted; expected a sentence with " << words;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

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
  const MeshState after = fromMessage(toMessage(before));
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_EQ(after.observed, before.observed);
  EXPECT_LT((after.vertices - before.vertices).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(after.confidence, before.confidence);
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

/// Two strokes in force, of two patches and of one, and an undone one.
EditHistory someEdits(unsigned seed) {
  EditHistory edits;
  for (std::uint32_t k = 0; k < 4; ++k) {
    MeshTopology mesh = randomSurface(seed + k);
    mesh.rest_vertices = mesh.rest_vertices.cast<float>().cast<double>().eval();
    addEdit({edits.revision + 1, (k + 1) / 2, CutKind::kCut, {mesh.rest_vertices, mesh.triangles}}, &edits);
  }
  addEdit({edits.revision + 1, 0, CutKind::kUndo, {}}, &edits);
  edits.body = 17;
  return edits;
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

TEST(Conversions, EveryFieldOfACutIsChecked) {
  using Message = softbody_msgs::Cut;
  const MeshTopology mesh = randomSurface(1);
  const Message good = toMessage(Cut{1, 1, CutKind::kCut, {mesh.rest_vertices, mesh.triangles}});
  expectRefused<Message>(
      good, [](Message& m) { m.kind = 4; }, "kind");
  expectRefused<Message>(
      good, [](Message& m) { m.patch_vertices[1].y = kNaN; }, "patch_vertices[1]");
  expectRefused<Message>(
      good, [](Message& m) { m.patch_triangles[2].vertex_indices[0] = 999; }, "patch_triangles[2]");
  expectRefused<Message>(
      good, [](Message& m) { m.patch_vertices[1].x = 1e6f; }, "patch_vertices[1]");
  expectRefused<Message>(
      good, [](Message& m) { m.patch_triangles.clear(); }, "patch_triangles");
  expectRefused<Message>(
      good, [](Message& m) { m.patch_triangles.resize(kMostPatchTriangles + 1); }, "20001 triangles");
  expectRefused<Message>(
      good, [](Message& m) { m.kind = Message::UNDO; }, "no patch");
  expectRefused<Message>(
      good, [](Message& m) { m.patch_triangles.assign(5, {}); }, "no area");
}

TEST(Conversions, EveryFieldOfACutHistoryIsChecked) {
  using Message = softbody_msgs::CutHistory;
  const Message good = toMessage(someEdits(0), randomVolume(0));
  expectRefused<Message>(
      good, [](Message& m) { m.uncut.surface_triangles.clear(); }, "surface_triangles");
  expectRefused<Message>(
      good, [](Message& m) { m.cuts[1].patch_vertices[2].z = kNaN; }, "patch_vertices[2]");
  expectRefused<Message>(
      good, [](Message& m) { m.cuts[1].kind = softbody_msgs::Cut::RESET; }, "patch");
  expectRefused<Message>(
      good, [](Message& m) { ++m.cuts[2].stroke; }, "cuts[2]");
  expectRefused<Message>(
      good, [](Message& m) { m.stroke_sizes.pop_back(); }, "stroke_sizes");
  expectRefused<Message>(
      good, [](Message& m) { m.stroke_sizes[0] = 0xffffffffu; }, "stroke_sizes");
  expectRefused<Message>(
      good, [](Message& m) { m.stroke_sizes[0] = 0; }, "stroke_sizes");
  expectRefused<Message>(
      good, [](Message& m) { m.strokes_in_force = 4; }, "in force");
  expectRefused<Message>(
      good, [](Message& m) { m.strokes_in_force = 0, m.stroke_is_open = 1; }, "in force");
}

TEST(Conversions, EveryFieldOfAVolumeIsChecked) {
  using Message = softbody_msgs::TetTopology;
  const Message good = toMessage(randomVolume(0));
  expectRefused<Message>(
      good, [](Message& m) { m.rest_vertices[3].y = kNaN; }, "rest_vertices[3]");
  expectRefused<Message>(
      good, [](Message& m) { m.tets[2].vertex_indices[1] = 18; }, "tets[2]");
  expectRefused<Message>(
      good, [](Message& m) { m.tets[0].vertex_indices[3] = 0xffffffffu; }, "tets[0]");
  expectRefused<Message>(
      good, [](Message& m) { m.surface_triangles[5].vertex_indices[0] = 99; }, "surface_triangles[5]");
  expectRefused<Message>(
      good, [](Message& m) { m.vertex_parents.pop_back(); }, "vertex_parents");
  expectRefused<Message>(
      good, [](Message& m) { m.tet_bodies.push_back(0); }, "tet_bodies");
  expectRefused<Message>(
      good, [](Message& m) { m.tet_bodies[1] = 0xffffffffu; }, "tet_bodies[1]");
  expectRefused<Message>(
      good, [](Message& m) { m.tets.clear(), m.tet_bodies.clear(); }, "tets is empty");
  expectRefused<Message>(
      good, [](Message& m) { m.surface_triangles.clear(); }, "surface_triangles is empty");
  expectRefused<Message>(
      good, [](Message& m) { m.surface_triangles.pop_back(); }, "not closed");
  expectRefused<Message>(
      good, [](Message& m) { m.rest_vertices[3].y = 1e7f; }, "rest_vertices[3]");
  expectRefused<Message>(
      good, [](Message& m) { m.tets[1].vertex_indices[0] = m.tets[1].vertex_indices[1]; }, "twice");
  expectRefused<Message>(
      good, [](Message& m) { std::swap(m.tets[1].vertex_indices[0], m.tets[1].vertex_indices[1]); },
      "tets[1] has the negative volume");
  expectRefused<Message>(
      good, [](Message& m) { m.rest_vertices.emplace_back(), m.vertex_parents.push_back(-1); }, "no tet");
  expectRefused<Message>(
      good, [](Message& m) { m.initial_pose.orientation.w += 0.5; }, "pose");
  expectRefused<Message>(
      good, [](Message& m) { m.initial_pose.position.x = kNaN; }, "pose");
}

TEST(Conversions, EveryFieldOfASurfaceIsChecked) {
  using Message = softbody_msgs::MeshTopology;
  const Message good = toMessage(randomSurface(0));
  expectRefused<Message>(
      good, [](Message& m) { m.rest_vertices[1].z = kNaN; }, "rest_vertices[1]");
  expectRefused<Message>(
      good, [](Message& m) { m.triangles[4].vertex_indices[2] = 18; }, "triangles[4]");
  expectRefused<Message>(
      good, [](Message& m) { m.vertex_parents.clear(); }, "vertex_parents");
  expectRefused<Message>(
      good, [](Message& m) { m.triangle_bodies.pop_back(); }, "triangle_bodies");
  expectRefused<Message>(
      good, [](Message& m) { m.cut_triangles.pop_back(); }, "cut_triangles");
  expectRefused<Message>(
      good, [](Message& m) { m.texture_coordinates.pop_back(); }, "texture_coordinates");
  expectRefused<Message>(
      good, [](Message& m) { m.texture_coordinates[7].x = kNaN; }, "texture_coordinates[7]");
}

TEST(Conversions, EveryFieldOfAStateIsChecked) {
  using Message = softbody_msgs::MeshState;
  MeshState state;
  state.vertices = Points::Random(4, 3);
  state.confidence.assign(4, 1.0f);
  const Message good = toMessage(state);
  expectRefused<Message>(
      good, [](Message& m) { m.vertices[2].x = INFINITY; }, "vertices[2]");
  expectRefused<Message>(
      good, [](Message& m) { m.confidence.pop_back(); }, "confidence");
  for (const float bad : {-0.1f, 1.1f, kNaN}) {
    expectRefused<Message>(
        good, [bad](Message& m) { m.confidence[3] = bad; }, "confidence[3]");
  }
}

TEST(Conversions, EveryFieldOfATargetIsChecked) {
  using Message = softbody_msgs::Targets;
  const Message good = toMessage(randomTargets(2));
  const auto refused = [&good](const std::function<void(softbody_msgs::Target&)>& spoil) {
    expectRefused<Message>(
        good, [&spoil](Message& m) { spoil(m.targets[6]); }, "targets[6]");
  };
  refused([](auto& t) { t.kind = 9; });
  refused([](auto& t) { t.tet = 0x80000000u; });
  refused([](auto& t) { t.barycentric[2] = kNaN; });
  refused([](auto& t) { t.barycentric[0] += 0.1f; });
  refused([](auto& t) { t.position.z = kNaN; });
  refused([](auto& t) { t.normal.x = kNaN; });
  refused([](auto& t) { t.normal.x += 3.0f; });
  for (const float bad : {0.0f, -1.0f, kNaN, INFINITY}) refused([bad](auto& t) { t.weight = bad; });
  expectRefused<Message>(
      good, [](Message& m) { m.body_pose.orientation.x = 7.0; }, "pose");
}

/// Beyond ten kilometres single precision rounds by more than half a millimetre.
TEST(Conversions, PositionsThatNobodyMeasuredAreRefused) {
  for (const float far : {1.1e4f, -1e10f, 1e20f, 3e38f}) {
    expectRefused<softbody_msgs::Targets>(
        toMessage(randomTargets(2)), [far](auto& m) { m.targets[6].position.y = far; }, "targets[6]");
    expectRefused<softbody_msgs::Targets>(
        toMessage(randomTargets(2)), [far](auto& m) { m.body_pose.position.z = far; }, "pose");
    expectRefused<softbody_msgs::MeshTopology>(
        toMessage(randomSurface(0)), [far](auto& m) { m.rest_vertices[1].x = far; }, "rest_vertices[1]");
  }
}

/// What the receivers' time or memory grows with.
TEST(Conversions, CountsAreBounded) {
  expectRefused<softbody_msgs::Targets>(
      toMessage(randomTargets(2)), [](auto& m) { m.targets.resize(1'000'000, m.targets[0]); }, "targets has");
  expectRefused<softbody_msgs::MeshTopology>(
      toMessage(randomSurface(0)), [](auto& m) { m.triangle_bodies[3] = 0xffffffffu; }, "triangle_bodies[3]");
  expectRefused<softbody_msgs::MeshTopology>(
      toMessage(randomSurface(0)),
      [](auto& m) {
        m.triangles.clear();
        m.triangle_bodies.clear();
        m.cut_triangles.clear();
        m.texture_coordinates.clear();
      },
      "triangles is empty");
}

geometry_msgs::Polygon roundBlade(int corners) {
  geometry_msgs::Polygon blade;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    blade.points.push_back(toPoint32({0.1 * std::cos(angle), 0.05 * std::sin(angle), 0.5}));
  }
  return blade;
}

TEST(Conversions, ABladeIsASmallPlanarPolygonOfFewCorners) {
  using Message = geometry_msgs::Polygon;
  EXPECT_EQ(fromMessage(roundBlade(64)).rows(), 64);
  const Message good = roundBlade(8);
  expectRefused<Message>(
      good, [](Message& m) { m = roundBlade(1'000'000); }, "1000000 corners; allowed: 3 to 64");
  expectRefused<Message>(
      good, [](Message& m) { m = roundBlade(65); }, "65 corners");
  expectRefused<Message>(
      good, [](Message& m) { m.points.resize(2); }, "2 corners");
  expectRefused<Message>(
      good, [](Message& m) { m.points[3].x = kNaN; }, "polygon.points[3]");
  expectRefused<Message>(
      good, [](Message& m) { m.points[3].x = 5.0f; }, "spans");
  expectRefused<Message>(
      good, [](Message& m) { m.points[3].z += 0.1f; }, "planar");
  expectRefused<Message>(
      good,
      [](Message& m) {
        for (auto& p : m.points) p.y = 0.0f;
      },
      "no area");
}

TEST(Conversions, TransformsAreCheckedAsPosesAre) {
  geometry_msgs::Transform transform;
  transform.rotation.w = 1.0;
  EXPECT_TRUE(fromMessage(transform).isApprox(Eigen::Isometry3d::Identity()));
  expectRefused<geometry_msgs::Transform>(
      transform, [](auto& m) { m.translation.x = 1e20; }, "transform");
  expectRefused<geometry_msgs::Transform>(
      transform, [](auto& m) { m.rotation.w = 0.0; }, "transform");
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

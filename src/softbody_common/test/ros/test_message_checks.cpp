#include <test_support/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "ros/random_bodies.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"

namespace softbody {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Fails unless the message is refused with a sentence that holds these words.
template <typename Message>
void expectRefused(Message message, const std::string& words, const std::function<void(Message&)>& spoil) {
  ASSERT_NO_THROW(fromMessage(message));
  spoil(message);
  EXPECT_TRUE(says(complaint([&] { fromMessage(message); }), words));
}

TEST(MessageChecks, EveryFieldOfACutIsChecked) {
  using Message = softbody_msgs::Cut;
  const MeshTopology mesh = randomSurface(1);
  const Message good = toMessage(Cut{1, 1, CutKind::kCut, {mesh.rest_vertices, mesh.triangles}});
  expectRefused<Message>(good, "kind", [](Message& m) { m.kind = 4; });
  expectRefused<Message>(good, "patch_vertices[1]", [](Message& m) { m.patch_vertices[1].y = kNaN; });
  expectRefused<Message>(good, "patch_triangles[2]",
                         [](Message& m) { m.patch_triangles[2].vertex_indices[0] = 999; });
  expectRefused<Message>(good, "patch_vertices[1]", [](Message& m) { m.patch_vertices[1].x = 1e6f; });
  expectRefused<Message>(good, "patch_triangles", [](Message& m) { m.patch_triangles.clear(); });
  expectRefused<Message>(good, "20001 triangles",
                         [](Message& m) { m.patch_triangles.resize(kMostPatchTriangles + 1); });
  expectRefused<Message>(good, "no patch", [](Message& m) { m.kind = Message::UNDO; });
  expectRefused<Message>(good, "no area", [](Message& m) { m.patch_triangles.assign(5, {}); });
}

TEST(MessageChecks, EveryFieldOfACutHistoryIsChecked) {
  using Message = softbody_msgs::CutHistory;
  const Message good = toMessage(someEdits(0), randomVolume(0));
  expectRefused<Message>(good, "surface_triangles", [](Message& m) { m.uncut.surface_triangles.clear(); });
  expectRefused<Message>(good, "patch_vertices[2]", [](Message& m) { m.cuts[1].patch_vertices[2].z = kNaN; });
  expectRefused<Message>(good, "patch", [](Message& m) { m.cuts[1].kind = softbody_msgs::Cut::RESET; });
  expectRefused<Message>(good, "cuts[2]", [](Message& m) { ++m.cuts[2].stroke; });
  expectRefused<Message>(good, "stroke_sizes", [](Message& m) { m.stroke_sizes.pop_back(); });
  expectRefused<Message>(good, "stroke_sizes", [](Message& m) { m.stroke_sizes[0] = 0xffffffffu; });
  expectRefused<Message>(good, "stroke_sizes", [](Message& m) { m.stroke_sizes[0] = 0; });
  expectRefused<Message>(good, "in force", [](Message& m) { m.strokes_in_force = 4; });
  expectRefused<Message>(good, "in force", [](Message& m) { m.strokes_in_force = 0, m.stroke_is_open = 1; });
}

TEST(MessageChecks, EveryFieldOfAVolumeIsChecked) {
  using Message = softbody_msgs::TetTopology;
  const Message good = toMessage(randomVolume(0));
  expectRefused<Message>(good, "rest_vertices[3]", [](Message& m) { m.rest_vertices[3].y = kNaN; });
  expectRefused<Message>(good, "tets[2]", [](Message& m) { m.tets[2].vertex_indices[1] = 18; });
  expectRefused<Message>(good, "tets[0]", [](Message& m) { m.tets[0].vertex_indices[3] = 0xffffffffu; });
  expectRefused<Message>(good, "surface_triangles[5]",
                         [](Message& m) { m.surface_triangles[5].vertex_indices[0] = 99; });
  expectRefused<Message>(good, "vertex_parents", [](Message& m) { m.vertex_parents.pop_back(); });
  expectRefused<Message>(good, "tet_bodies", [](Message& m) { m.tet_bodies.push_back(0); });
  expectRefused<Message>(good, "tet_bodies[1]", [](Message& m) { m.tet_bodies[1] = 0xffffffffu; });
  expectRefused<Message>(good, "tets is empty", [](Message& m) { m.tets.clear(), m.tet_bodies.clear(); });
  expectRefused<Message>(good, "surface_triangles is empty", [](Message& m) { m.surface_triangles.clear(); });
  expectRefused<Message>(good, "not closed", [](Message& m) { m.surface_triangles.pop_back(); });
  expectRefused<Message>(good, "rest_vertices[3]", [](Message& m) { m.rest_vertices[3].y = 1e7f; });
  expectRefused<Message>(good, "twice",
                         [](Message& m) { m.tets[1].vertex_indices[0] = m.tets[1].vertex_indices[1]; });
  expectRefused<Message>(good, "tets[1] has the negative volume", [](Message& m) {
    std::swap(m.tets[1].vertex_indices[0], m.tets[1].vertex_indices[1]);
  });
  expectRefused<Message>(good, "no tet",
                         [](Message& m) { m.rest_vertices.emplace_back(), m.vertex_parents.push_back(-1); });
  expectRefused<Message>(good, "pose", [](Message& m) { m.initial_pose.orientation.w += 0.5; });
  expectRefused<Message>(good, "pose", [](Message& m) { m.initial_pose.position.x = kNaN; });
}

TEST(MessageChecks, EveryFieldOfASurfaceIsChecked) {
  using Message = softbody_msgs::MeshTopology;
  const Message good = toMessage(randomSurface(0));
  expectRefused<Message>(good, "rest_vertices[1]", [](Message& m) { m.rest_vertices[1].z = kNaN; });
  expectRefused<Message>(good, "triangles[4]", [](Message& m) { m.triangles[4].vertex_indices[2] = 18; });
  expectRefused<Message>(good, "vertex_parents", [](Message& m) { m.vertex_parents.clear(); });
  expectRefused<Message>(good, "triangle_bodies", [](Message& m) { m.triangle_bodies.pop_back(); });
  expectRefused<Message>(good, "cut_triangles", [](Message& m) { m.cut_triangles.pop_back(); });
  expectRefused<Message>(good, "texture_coordinates", [](Message& m) { m.texture_coordinates.pop_back(); });
  expectRefused<Message>(good, "texture_coordinates[7]",
                         [](Message& m) { m.texture_coordinates[7].x = kNaN; });
}

TEST(MessageChecks, EveryFieldOfAStateIsChecked) {
  using Message = softbody_msgs::MeshState;
  MeshState state;
  state.vertices = Points::Random(4, 3);
  state.confidence.assign(4, 1.0f);
  const Message good = toMessage(state);
  expectRefused<Message>(good, "vertices[2]", [](Message& m) { m.vertices[2].x = INFINITY; });
  expectRefused<Message>(good, "confidence", [](Message& m) { m.confidence.pop_back(); });
  for (const float bad : {-0.1f, 1.1f, kNaN}) {
    expectRefused<Message>(good, "confidence[3]", [bad](Message& m) { m.confidence[3] = bad; });
  }
  expectRefused<Message>(good, "standard_deviation",
                         [](Message& m) { m.standard_deviation.assign(3, 0.001f); });
  for (const float bad : {-0.1f, INFINITY, kNaN}) {
    expectRefused<Message>(good, "standard_deviation[2]", [bad](Message& m) {
      m.standard_deviation = {0.0f, 0.0f, bad, 0.0f};
    });
  }
}

TEST(MessageChecks, EveryFieldOfATargetIsChecked) {
  using Message = softbody_msgs::Targets;
  const Message good = toMessage(randomTargets(2));
  const auto refused = [&good](const std::function<void(softbody_msgs::Target&)>& spoil) {
    expectRefused<Message>(good, "targets[6]", [&spoil](Message& m) { spoil(m.targets[6]); });
  };
  refused([](auto& t) { t.kind = softbody_msgs::Target::PRIOR + 1; });
  refused([](auto& t) { t.tet = 0x80000000u; });
  refused([](auto& t) { t.barycentric[2] = kNaN; });
  refused([](auto& t) { t.barycentric[0] += 0.1f; });
  refused([](auto& t) { t.position.z = kNaN; });
  refused([](auto& t) { t.normal.x = kNaN; });
  refused([](auto& t) { t.normal.x += 3.0f; });
  for (const float bad : {0.0f, -1.0f, kNaN, INFINITY}) refused([bad](auto& t) { t.weight = bad; });
  expectRefused<Message>(good, "pose", [](Message& m) { m.body_pose.orientation.x = 7.0; });
}

/// Beyond ten kilometres single precision rounds by more than half a millimetre.
TEST(MessageChecks, PositionsThatNobodyMeasuredAreRefused) {
  for (const float far : {1.1e4f, -1e10f, 1e20f, 3e38f}) {
    expectRefused<softbody_msgs::Targets>(toMessage(randomTargets(2)), "targets[6]",
                                          [far](auto& m) { m.targets[6].position.y = far; });
    expectRefused<softbody_msgs::Targets>(toMessage(randomTargets(2)), "pose",
                                          [far](auto& m) { m.body_pose.position.z = far; });
    expectRefused<softbody_msgs::MeshTopology>(toMessage(randomSurface(0)), "rest_vertices[1]",
                                               [far](auto& m) { m.rest_vertices[1].x = far; });
  }
}

/// What the receivers' time or memory grows with.
TEST(MessageChecks, CountsAreBounded) {
  expectRefused<softbody_msgs::Targets>(toMessage(randomTargets(2)), "targets has",
                                        [](auto& m) { m.targets.resize(1'000'000, m.targets[0]); });
  expectRefused<softbody_msgs::MeshTopology>(toMessage(randomSurface(0)), "triangle_bodies[3]",
                                             [](auto& m) { m.triangle_bodies[3] = 0xffffffffu; });
  expectRefused<softbody_msgs::MeshTopology>(toMessage(randomSurface(0)), "triangles is empty", [](auto& m) {
    m.triangles.clear();
    m.triangle_bodies.clear();
    m.cut_triangles.clear();
    m.texture_coordinates.clear();
  });
}

geometry_msgs::Polygon roundBlade(int corners) {
  geometry_msgs::Polygon blade;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    blade.points.push_back(toPoint32({0.1 * std::cos(angle), 0.05 * std::sin(angle), 0.5}));
  }
  return blade;
}

TEST(MessageChecks, ABladeIsASmallPlanarPolygonOfFewCorners) {
  using Message = geometry_msgs::Polygon;
  EXPECT_EQ(fromMessage(roundBlade(64)).rows(), 64);
  const Message good = roundBlade(8);
  expectRefused<Message>(good, "1000000 corners; allowed: 3 to 64",
                         [](Message& m) { m = roundBlade(1'000'000); });
  expectRefused<Message>(good, "65 corners", [](Message& m) { m = roundBlade(65); });
  expectRefused<Message>(good, "2 corners", [](Message& m) { m.points.resize(2); });
  expectRefused<Message>(good, "polygon.points[3]", [](Message& m) { m.points[3].x = kNaN; });
  expectRefused<Message>(good, "spans", [](Message& m) { m.points[3].x = 5.0f; });
  expectRefused<Message>(good, "planar", [](Message& m) { m.points[3].z += 0.1f; });
  expectRefused<Message>(good, "no area", [](Message& m) {
    for (auto& p : m.points) p.y = 0.0f;
  });
}

TEST(MessageChecks, TransformsAreCheckedAsPosesAre) {
  geometry_msgs::Transform transform;
  transform.rotation.w = 1.0;
  EXPECT_TRUE(fromMessage(transform).isApprox(Eigen::Isometry3d::Identity()));
  expectRefused<geometry_msgs::Transform>(transform, "transform", [](auto& m) { m.translation.x = 1e20; });
  expectRefused<geometry_msgs::Transform>(transform, "transform", [](auto& m) { m.rotation.w = 0.0; });
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

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

TEST(MessageChecks, EveryFieldOfACutIsChecked) {
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

TEST(MessageChecks, EveryFieldOfACutHistoryIsChecked) {
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

TEST(MessageChecks, EveryFieldOfAVolumeIsChecked) {
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

TEST(MessageChecks, EveryFieldOfASurfaceIsChecked) {
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

TEST(MessageChecks, EveryFieldOfAStateIsChecked) {
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
  expectRefused<Message>(
      good, [](Message& m) { m.standard_deviation.assign(3, 0.001f); }, "standard_deviation");
  for (const float bad : {-0.1f, INFINITY, kNaN}) {
    expectRefused<Message>(
        good,
        [bad](Message& m) {
          m.standard_deviation = {0.0f, 0.0f, bad, 0.0f};
        },
        "standard_deviation[2]");
  }
}

TEST(MessageChecks, EveryFieldOfATargetIsChecked) {
  using Message = softbody_msgs::Targets;
  const Message good = toMessage(randomTargets(2));
  const auto refused = [&good](const std::function<void(softbody_msgs::Target&)>& spoil) {
    expectRefused<Message>(
        good, [&spoil](Message& m) { spoil(m.targets[6]); }, "targets[6]");
  };
  refused([](auto& t) { t.kind = softbody_msgs::Target::PRIOR + 1; });
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
TEST(MessageChecks, PositionsThatNobodyMeasuredAreRefused) {
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
TEST(MessageChecks, CountsAreBounded) {
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

TEST(MessageChecks, ABladeIsASmallPlanarPolygonOfFewCorners) {
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

TEST(MessageChecks, TransformsAreCheckedAsPosesAre) {
  geometry_msgs::Transform transform;
  transform.rotation.w = 1.0;
  EXPECT_TRUE(fromMessage(transform).isApprox(Eigen::Isometry3d::Identity()));
  expectRefused<geometry_msgs::Transform>(
      transform, [](auto& m) { m.translation.x = 1e20; }, "transform");
  expectRefused<geometry_msgs::Transform>(
      transform, [](auto& m) { m.rotation.w = 0.0; }, "transform");
}

}  // namespace
}  // namespace softbody

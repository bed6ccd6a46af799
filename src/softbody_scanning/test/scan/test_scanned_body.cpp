#include <test_support/gtest.h>

#include <algorithm>

#include "fixtures/seen_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_scanning/scan/checked_scan.h"

namespace softbody::scanning {
namespace {

constexpr double kRadius = 0.04;

PosedRecording recordingOf(const std::vector<KeyFrame>& frames) {
  return {"walk", frames, {Eigen::Vector3d(-0.14, -0.14, -0.01), Eigen::Vector3d(0.14, 0.14, 0.2)}};
}

/// A ball that is a little in the table, so that all of it but a ring near the table is seen.
TriangleMesh ballOnTable() {
  constexpr int kRings = 160, kColumns = 320;  // sags by 0.01 mm
  TriangleMesh ball{Points((kRings + 1) * kColumns, 3), Triangles(2 * kRings * kColumns, 3)};
  for (int ring = 0; ring <= kRings; ++ring)
    for (int column = 0; column < kColumns; ++column) {
      const double down = M_PI * ring / kRings, around = 2.0 * M_PI * column / kColumns;
      ball.vertices.row(ring * kColumns + column) << kRadius * std::sin(down) * std::cos(around),
          kRadius * std::sin(down) * std::sin(around), kRadius * (0.8 + std::cos(down));
    }
  for (int ring = 0; ring < kRings; ++ring)
    for (int column = 0; column < kColumns; ++column) {
      const int a = ring * kColumns + column, b = ring * kColumns + (column + 1) % kColumns;
      ball.triangles.row(2 * a) << a, a + kColumns, b;
      ball.triangles.row(2 * a + 1) << b, a + kColumns, b + kColumns;
    }
  return ball;
}

/// Signed distances of the seen vertices from the ball.
Eigen::ArrayXd distancesOf(const ScannedBody& body) {
  std::vector<double> distances;
  for (Eigen::Index v = 0; v < body.mesh.vertices.rows(); ++v) {
    const Eigen::Vector3d p = body.mesh.vertices.row(v);
    if (body.seen[v] > 0.5f && p.z() > 0.02)
      distances.push_back((p - Eigen::Vector3d(0, 0, 0.8 * kRadius)).norm() - kRadius);
  }
  return Eigen::Map<const Eigen::ArrayXd>(distances.data(), static_cast<Eigen::Index>(distances.size()));
}

TEST(ScannedBody, liesOnTheBall) {
  for (const double noise : {1e-3, 4e-3}) {  // [1/m]; 0.25 and 1 mm at 0.5 m
    const ScannedBody body = scanBody({recordingOf(seen(ballOnTable(), walkAround(60, 0.5), noise, 1))}, {});
    const Eigen::ArrayXd distances = distancesOf(body);
    ASSERT_GT(distances.size(), 1000);
    EXPECT_LT(std::abs(distances.mean()), 1e-4);
    EXPECT_LT(distances.abs().maxCoeff(), 1e-3);
  }
}

/// A wedge-like block without any symmetry, in any pose.
TriangleMesh block() {
  TriangleMesh block = virtual_camera::box({0.08, 0.06, 0.04});
  for (auto p : block.vertices.rowwise())
    if (p.x() > 0.0) p *= p.y() > 0.0 ? 0.75 : 0.9;
  return block;
}

TriangleMesh onTable(TriangleMesh mesh, const Eigen::AngleAxisd& turn, const Eigen::Vector3d& aside) {
  mesh.vertices = virtual_camera::transformed(Eigen::Translation3d(aside) * turn, mesh.vertices);
  mesh.vertices.col(2).array() -= mesh.vertices.col(2).minCoeff();
  return mesh;
}

TEST(ScannedBody, aSecondRecordingClosesTheUnderside) {
  const double noise = 4e-3;
  const TriangleMesh first = onTable(block(), {0.0, Eigen::Vector3d::UnitX()}, {0.004, 0.0, 0.0});
  const TriangleMesh turned =
      onTable(block(), {M_PI, Eigen::Vector3d(1.0, 0.3, 0.0).normalized()}, {0.0, 0.01, 0.0});
  PosedRecording walk = recordingOf(seen(first, walkAround(60, 0.5), noise, 1));
  PosedRecording flip = recordingOf(seen(turned, walkAround(60, 0.5), noise, 2));
  flip.name = "flip";
  const ScannedBody body = scanBody({walk, flip}, {});
  const double volume = enclosedVolume(body.mesh.vertices, body.mesh.triangles);
  const double truth = enclosedVolume(first.vertices, first.triangles);
  const long seen_vertices =
      std::count_if(body.seen.begin(), body.seen.end(), [](float s) { return s > 0.5f; });
  const auto pose = [](const TriangleMesh& mesh) { return fitRigid(block().vertices, mesh.vertices); };
  const Eigen::Isometry3d error =
      (pose(first) * pose(turned).inverse()).inverse() * body.turned[0].registration.T_fixed_moving;
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.005);
  EXPECT_LT(error.translation().norm(), 0.5e-3);
  EXPECT_NEAR(volume / truth, 1.0, 0.01);
  EXPECT_GT(seen_vertices, 0.99 * static_cast<double>(body.seen.size()));
}

/// Two blocks on the table: a large one at its middle, and a small one.
TriangleMesh twoBlocks(const Eigen::Vector3d& small_one) {
  TriangleMesh small_block = virtual_camera::box({0.03, 0.025, 0.02});
  small_block.vertices.rowwise() += small_one.transpose();
  return virtual_camera::merge(
      {onTable(block(), {0.0, Eigen::Vector3d::UnitX()}, {0.0, 0.0, 0.0}), small_block});
}

TEST(ScannedBody, isTheThingAtThePoint) {
  const Eigen::Vector3d small_one(0.07, -0.06, 0.01), on_its_edge(0.056, -0.06, 0.021),
      nowhere(-0.09, 0.09, 0.05);
  PosedRecording recording = recordingOf(seen(twoBlocks(small_one), walkAround(24, 0.5), 2e-3, 1));
  const auto middle = [&]() -> Eigen::Vector3d {
    const Points vertices = scanBody({recording}, {}).mesh.vertices;
    return 0.5 * (vertices.colwise().minCoeff() + vertices.colwise().maxCoeff());
  };
  EXPECT_LT(middle().head<2>().norm(), 0.01);
  for (const Eigen::Vector3d& point : {small_one, on_its_edge}) {
    recording.at = point;
    EXPECT_LT((middle() - small_one).norm(), 1e-3);
  }
  recording.at = nowhere;
  EXPECT_TRUE(says(complaint([&] { middle(); }), "walk: nothing stands at (-0.090, 0.090, 0.050) m"));
}

/// The object is moved or turned after a part of the views.
TEST(ScannedBody, anObjectThatMovedMeanwhileGivesNoModel) {
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.02, 0.0, 0.0)),
      along(Eigen::Translation3d(0.0, 0.01, 0.0));
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  const TriangleMesh before = onTable(block(), {0.0, Eigen::Vector3d::UnitX()}, Eigen::Vector3d::Zero());
  const std::vector<KeyFrame> first = seen(before, walkAround(60, 0.5), 4e-3, 1);
  for (const Eigen::Isometry3d& motion : {aside, along, turned}) {
    TriangleMesh after = before;
    after.vertices = virtual_camera::transformed(motion, after.vertices);
    std::vector<KeyFrame> frames = seen(after, walkAround(60, 0.5), 4e-3, 2);
    for (const int views : {20, 30, 40}) {
      std::copy_n(first.begin(), views, frames.begin());
      EXPECT_TRUE(says(complaint([&] { scanAndCheck({recordingOf(frames)}, {}); }), "moved")) << views;
    }
  }
}

}  // namespace
}  // namespace softbody::scanning

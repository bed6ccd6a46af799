#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <fstream>
#include <random>
#include <set>

#include "bodies/plane_cut.h"
#include "bodies/polygon.h"
#include "fixtures/pieces.h"
#include "fixtures/scene_fixtures.h"
#include "scenes/tool.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

/// Every edge is used once in each direction.
bool isClosed(const Triangles& triangles) {
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) edges.emplace(triangles(f, k), triangles(f, (k + 1) % 3));
  }
  bool closed = static_cast<Eigen::Index>(edges.size()) == 3 * triangles.rows();
  for (const auto& [a, b] : edges) closed = closed && edges.count({b, a}) == 1;
  return closed;
}

MeshTopology whole(const std::string& name) { return topologyOf(shippedBody(name)); }

PlaneCut planeAt(double x, double degrees = 0.0) {
  return {Eigen::Translation3d(x, 0.0, 0.0) *
          Eigen::AngleAxisd(degrees * 3.14159265358979 / 180.0, Eigen::Vector3d::UnitZ())};
}

/// Least height of a triangle, as published in single precision [m].
double leastHeight(const MeshTopology& topology) {
  const Eigen::MatrixX3d rounded = topology.rest_vertices.cast<float>().cast<double>();
  double least = 1e9;
  for (Eigen::Index f = 0; f < topology.triangles.rows(); ++f) {
    const Eigen::Vector3d a = rounded.row(topology.triangles(f, 0)),
                          b = rounded.row(topology.triangles(f, 1)),
                          c = rounded.row(topology.triangles(f, 2));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    least = std::min(least, (b - a).cross(c - a).norm() / longest);
  }
  return least;
}

TEST(PlaneCut, GivesClosedPiecesWithTheExactVolumes) {
  for (const double place : {-0.0833, 0.0049, 0.015}) {
    const MeshTopology cut = cutByPlane(whole("sponge"), planeAt(place)).topology;
    ASSERT_EQ(pieces(cut), 2u);
    EXPECT_TRUE(isClosed(pieceOf(cut, 0)) && isClosed(pieceOf(cut, 1)));
    EXPECT_NEAR(volumeOf(cut, 0) + volumeOf(cut, 1), 800e-6, 1e-12);
    EXPECT_NEAR(std::min(volumeOf(cut, 0), volumeOf(cut, 1)), (0.1 - std::abs(place)) * 0.1 * 0.04, 1e-12);
  }
}

TEST(PlaneCut, KeepsTheVerticesAndMarksWhatIsNew) {
  const MeshTopology sponge = whole("sponge");
  const CutMesh result = cutByPlane(sponge, planeAt(0.015));
  const MeshTopology& cut = result.topology;
  EXPECT_EQ(cut.revision, 1u);
  EXPECT_EQ(cut.rest_vertices.topRows(522), sponge.rest_vertices);
  double area = 0.0;
  for (Eigen::Index f = 0; f < cut.triangles.rows(); ++f) {
    const Eigen::Vector3d a = cut.rest_vertices.row(cut.triangles(f, 0)),
                          b = cut.rest_vertices.row(cut.triangles(f, 1)),
                          c = cut.rest_vertices.row(cut.triangles(f, 2));
    const double twice = (b - a).cross(c - a).norm();
    EXPECT_GT(twice, 1e-7) << "a sliver, triangle " << f;
    if (cut.cut[static_cast<std::size_t>(f)]) area += 0.5 * twice;
    const int parent = result.triangle_parents[static_cast<std::size_t>(f)];
    ASSERT_EQ(parent < 0, cut.cut[static_cast<std::size_t>(f)]);
    if (parent < 0) continue;  // otherwise a part of the triangle before
    const Eigen::Matrix3d before = sponge.rest_vertices(sponge.triangles.row(parent).transpose(), Eigen::all);
    const Eigen::Vector3d normal =
        (before.row(1) - before.row(0)).cross(before.row(2) - before.row(0)).normalized();
    EXPECT_NEAR(normal.dot((b - a).cross(c - a)), twice, 1e-12);
    EXPECT_NEAR(normal.dot(a - before.row(0).transpose()), 0.0, 1e-12);
  }
  EXPECT_NEAR(area, 2.0 * 0.1 * 0.04, 1e-12);
  for (std::size_t i = 0; i < cut.vertex_parents.size(); ++i) {
    const double x = cut.rest_vertices(static_cast<Eigen::Index>(i), 0);
    EXPECT_EQ(cut.vertex_parents[i], i < 522 ? static_cast<int>(i) : -1);
    if (i >= 522) {
      EXPECT_NEAR(x, 0.015, 1e-15);
    } else {
      EXPECT_EQ(result.beyond[i], x > 0.015);
    }
  }
}

TEST(PlaneCut, InPartLeavesOneClosedBodyJoinedAtTheFront) {
  for (const std::string name : {"sponge", "doll"}) {
    const MeshTopology body = whole(name);
    for (const double front : {-0.0123, 0.0031}) {
      PlaneCut cut = clearOfVertices(body.rest_vertices, planeAt(0.015, 17.0), 2e-3);
      cut.T_rest_cut.translation().z() = front;
      cut.through = false;
      const CutMesh result = cutByPlane(body, cut);
      const MeshTopology& slit = result.topology;
      EXPECT_EQ(pieces(slit), 1u) << name;
      EXPECT_TRUE(isClosed(slit.triangles)) << name;
      EXPECT_EQ(slit.rest_vertices.rows() - slit.triangles.rows() / 2, 2)
          << "a sphere's Euler number, " << name;
      EXPECT_NEAR(enclosedVolume(slit.rest_vertices, slit.triangles) /
                      enclosedVolume(body.rest_vertices, body.triangles),
                  1.0, 1e-9);
      double lowest = 1.0;
      for (Eigen::Index f = 0; f < slit.triangles.rows(); ++f) {
        if (result.triangle_parents[static_cast<std::size_t>(f)] >= 0) continue;
        for (const int i : slit.triangles.row(f)) lowest = std::min(lowest, slit.rest_vertices(i, 2));
      }
      EXPECT_NEAR(lowest, front, 1e-12) << name;
      EXPECT_GT(leastHeight(slit), 1e-6) << name;
    }
  }
}

TEST(PlaneCut, CrossingCutsGiveFourClosedPieces) {
  for (const std::string name : {"sponge", "doll"}) {
    const MeshTopology body = whole(name);
    const MeshTopology once =
        cutByPlane(body, clearOfVertices(body.rest_vertices, planeAt(0.015, 28.0), 2e-3)).topology;
    const MeshTopology twice =
        cutByPlane(once, clearOfVertices(once.rest_vertices, planeAt(0.015, -28.0), 2e-3)).topology;
    EXPECT_EQ(twice.revision, 2u);
    ASSERT_EQ(pieces(twice), 4u) << name;
    double sum = 0.0;
    for (std::uint32_t piece = 0; piece < 4; ++piece) {
      EXPECT_TRUE(isClosed(pieceOf(twice, piece))) << name;
      EXPECT_GT(volumeOf(twice, piece), 10e-6) << name;
      sum += volumeOf(twice, piece);
    }
    EXPECT_NEAR(sum / enclosedVolume(body.rest_vertices, body.triangles), 1.0, 1e-9) << name;
    EXPECT_GT(leastHeight(twice), 1e-6) << name;
  }
}

TEST(PlaneCut, InterpolatesTextureCoordinates) {
  // Coordinates that are a linear function of the place stay so.
  Body body = shippedBody("sponge");
  const auto coordinates = [](const Points& vertices, const Triangles& triangles) {
    Points uv(3 * triangles.rows(), 3);
    for (Eigen::Index c = 0; c < uv.rows(); ++c) {
      const Eigen::RowVector3d p = vertices.row(triangles(c / 3, c % 3));
      uv.row(c) << 3.0 * p.x() - p.z(), p.y() + 2.0 * p.z(), 0.0;
    }
    return uv;
  };
  body.skin.coordinates = coordinates(body.rest.vertices, body.rest.triangles);
  PlaneCut cut = planeAt(0.015, 20.0);
  cut.T_rest_cut.translation().z() = 0.004;
  cut.through = false;
  const MeshTopology slit = cutByPlane(topologyOf(body), cut).topology;
  const Points expected = coordinates(slit.rest_vertices, slit.triangles);
  ASSERT_EQ(slit.texture_coordinates.rows(), expected.rows());
  for (Eigen::Index c = 0; c < expected.rows(); ++c) {
    if (slit.cut[static_cast<std::size_t>(c / 3)]) continue;
    EXPECT_LT((slit.texture_coordinates.row(c) - expected.row(c)).norm(), 1e-12);
  }
}

TEST(PlaneCut, RefusesAPlaneThroughVerticesOrBesideTheBody) {
  EXPECT_THROW(cutByPlane(whole("sponge"), planeAt(0.01)), std::invalid_argument);
  EXPECT_THROW(cutByPlane(whole("sponge"), planeAt(0.2)), std::invalid_argument);
  const MeshTopology sponge = whole("sponge");
  EXPECT_NO_THROW(cutByPlane(sponge, clearOfVertices(sponge.rest_vertices, planeAt(0.01), 2e-3)));
}

TEST(TriangulatePolygon, CoversRandomStarsExactly) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  for (int n = 3; n < 60; ++n) {
    std::vector<Eigen::Vector2d> polygon;
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * 3.14159265358979 * i / n;
      polygon.push_back(radius(random) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    double outline = 0.0, area = 0.0;
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    for (int i = 0; i < n; ++i) outline += 0.5 * cross(polygon[i], polygon[(i + 1) % n]);
    const auto triangles = triangulatePolygon(polygon);
    for (const auto& [a, b, c] : triangles) {
      const double own = 0.5 * cross(polygon[b] - polygon[a], polygon[c] - polygon[a]);
      EXPECT_GT(own, 0.0);
      area += own;
    }
    EXPECT_EQ(triangles.size(), static_cast<std::size_t>(n - 2));
    EXPECT_NEAR(area, outline, 1e-12);
  }
}

TEST(TriangulatePolygon, TakesVerticesOnALineAndRefusesAClockwiseOne) {
  std::vector<Eigen::Vector2d> polygon;
  for (int i = 0; i < 7; ++i) polygon.emplace_back(i, 0.1 * 3);
  for (int i = 0; i < 7; ++i) polygon.emplace_back(6 - i, 0.1 * 7);
  for (const auto& [a, b, c] : triangulatePolygon(polygon)) {
    const Eigen::Vector2d ab = polygon[b] - polygon[a], ac = polygon[c] - polygon[a];
    EXPECT_GT(ab.x() * ac.y() - ab.y() * ac.x(), 0.1);
  }
  std::reverse(polygon.begin(), polygon.end());
  EXPECT_THROW(triangulatePolygon(polygon), std::invalid_argument);
}

TEST(ReadTool, SaysWhatIsWrong) {
  const std::string path = testing::TempDir() + "tool.yaml";
  for (const char* text :
       {"tool: {}", "tool: {dictionary: DICT_6X6_50, markers: [], blade: []}",
        "tool: {dictionary: DICT_4X4_50, markers: [{id: 70, size_m: 0.1, pose: [0,0,0,0,0,0,1]}]}",
        "tool: {dictionary: DICT_4X4_50, markers: [], blade: [[0,0,0], [1,0]]}"}) {
    std::ofstream(path) << text;
    EXPECT_THROW(readTool(path), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace softbody::virtual_camera

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <fstream>
#include <random>
#include <set>

#include "fixtures/scene_fixtures.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_virtual_camera/bodies/plane_cut.h"
#include "softbody_virtual_camera/bodies/polygon.h"
#include "softbody_virtual_camera/scenes/tool.h"

namespace softbody::virtual_camera {
namespace {

const std::string kConfig = CONFIG_DIR;

Triangles pieceOf(const MeshTopology& topology, std::uint32_t body) {
  std::vector<int> rows;
  for (std::size_t f = 0; f < topology.triangle_pieces.size(); ++f) {
    if (topology.triangle_pieces[f] == body) rows.push_back(static_cast<int>(f));
  }
  return topology.triangles(rows, Eigen::all);
}

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

double volumeOf(const MeshTopology& topology, std::uint32_t body) {
  return enclosedVolume(topology.rest_vertices, pieceOf(topology, body));
}

std::uint32_t pieces(const MeshTopology& topology) {
  return 1 + *std::max_element(topology.triangle_pieces.begin(), topology.triangle_pieces.end());
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

const std::vector<std::string> kCutScenes = {"cut",      "cut-partial",      "cut-cross",
                                             "doll_cut", "doll_cut-partial", "doll_cut-cross"};

Scene scene(const std::string& name) {
  return makeScene(name, shippedBody(objectOf(name)), 1, kConfig + "/knife.yaml");
}

/// When the truth's revisions begin.
std::vector<double> editTimes(const std::string& name) {
  return name.find("cross") == std::string::npos ? std::vector<double>{2.5} : std::vector<double>{2.5, 6.5};
}

TEST(CutScenes, ChangeTheTopologyWhereTheBodyTouchesAndWithoutAJump) {
  for (const std::string& name : kCutScenes) {
    const Scene scene = virtual_camera::scene(name);
    ASSERT_EQ(scene.edits.size(), editTimes(name).size()) << name;
    for (std::size_t edit = 0; edit < scene.edits.size(); ++edit) {
      const SceneState before = scene.state(editTimes(name)[edit] - 1e-3),
                       after = scene.state(editTimes(name)[edit]);
      EXPECT_EQ(before.revision, edit) << name;
      EXPECT_EQ(after.revision, edit + 1) << name;
      const Eigen::Index common = before.vertices[0].rows();
      EXPECT_LT((after.vertices[0].topRows(common) - before.vertices[0]).rowwise().norm().maxCoeff(), 1e-9)
          << name;
    }
  }
}

TEST(CutScenes, PiecesMoveApartRigidlyAndDoNotMeet) {
  for (const std::string name : {"cut", "cut-cross", "doll_cut", "doll_cut-cross"}) {
    const Scene scene = virtual_camera::scene(name);
    const MeshTopology& cut = scene.edits.back().topology;
    ASSERT_EQ(pieces(cut), scene.edits.size() * 2);
    const Points end = scene.state(scene.duration_s).vertices[0];
    for (std::uint32_t piece = 0; piece < pieces(cut); ++piece) {
      EXPECT_NEAR(enclosedVolume(end, pieceOf(cut, piece)) / volumeOf(cut, piece), 1.0, 1e-9) << name;
    }
    // Vertices that a cut made come in pairs at rest; each of the two walls has moved away from the other.
    for (Eigen::Index i = 0; i + 1 < cut.rest_vertices.rows(); ++i) {
      if (cut.vertex_parents[static_cast<std::size_t>(i)] >= 0) continue;
      if ((cut.rest_vertices.row(i) - cut.rest_vertices.row(i + 1)).norm() > 1e-12) continue;
      EXPECT_GT((end.row(i) - end.row(i + 1)).norm(), 0.01) << name;
    }
  }
}

TEST(TearScene, TearsAtHalfAsLongAgainAndTheEndsStay) {
  constexpr double kTear = 2.5, kAround = 4e-3;  // [s], [m]
  const Scene scene = virtual_camera::scene("tear");
  ASSERT_EQ(scene.edits.size(), 1u);
  const MeshTopology& torn = scene.edits[0].topology;
  EXPECT_EQ(pieces(torn), 2u);
  EXPECT_EQ(scene.state(kTear - 1e-6).revision, 0u);
  const SceneState tears = scene.state(kTear), relaxed = scene.state(scene.duration_s);
  EXPECT_EQ(tears.revision, 1u);
  const auto length = [&](const SceneState& state, Eigen::Index a, Eigen::Index b) {
    return (state.vertices[0].row(a) - state.vertices[0].row(b)).norm();
  };
  Eigen::Index left, right;
  torn.rest_vertices.col(0).minCoeff(&left);
  torn.rest_vertices.col(0).maxCoeff(&right);
  EXPECT_NEAR(length(relaxed, left, right), length(tears, left, right), 1e-3);
  for (std::uint32_t piece = 0; piece < 2; ++piece)
    EXPECT_NEAR(enclosedVolume(relaxed.vertices[0], pieceOf(torn, piece)) / volumeOf(torn, piece), 1.0, 1e-9);
  // Two points on both sides of the section, closer than the stretch changes.
  const double section = torn.rest_vertices(torn.rest_vertices.rows() - 1, 0);
  double stretch = 0.0;
  for (Eigen::Index i = 0; i < torn.rest_vertices.rows(); ++i) {
    const double beyond = torn.rest_vertices(i, 0) - section;
    if (beyond < 1e-6 || beyond > kAround) continue;
    stretch = std::max(
        stretch,
        ((tears.T_camera_body.inverse() * Eigen::Vector3d(tears.vertices[0].row(i))).x() - section) / beyond);
  }
  EXPECT_NEAR(stretch, 1.5, 0.02);
}

TEST(CutScenes, SlitOpensAtItsTopAndStaysJoinedAtItsFront) {
  for (const std::string name : {"cut-partial", "doll_cut-partial"}) {
    const Scene scene = virtual_camera::scene(name);
    const MeshTopology& slit = scene.edits.at(0).topology;
    EXPECT_EQ(pieces(slit), 1u) << name;
    const SceneState end = scene.state(scene.duration_s);
    const Points body = transformed(end.T_camera_body.inverse(), end.vertices[0]);
    double widest = 0.0;
    for (Eigen::Index i = 0; i + 1 < body.rows(); ++i) {
      if (slit.vertex_parents[static_cast<std::size_t>(i)] >= 0) continue;
      if ((slit.rest_vertices.row(i) - slit.rest_vertices.row(i + 1)).norm() > 1e-12) continue;
      widest = std::max(widest, (body.row(i) - body.row(i + 1)).norm());
    }
    EXPECT_NEAR(widest, 0.012, 1e-4) << name;
    const double rest_volume = enclosedVolume(slit.rest_vertices, slit.triangles);
    EXPECT_NEAR(enclosedVolume(body, slit.triangles) / rest_volume, 1.0, 0.05) << name;
    EXPECT_LT(enclosedVolume(body, slit.triangles), rest_volume) << name;
  }
}

TEST(CutScenes, BladeIsOverTheBodyThenInThePatchAllAcrossTheSection) {
  const Points blade = readTool(kConfig + "/knife.yaml").blade;
  for (const std::string& name : kCutScenes) {
    const Scene scene = virtual_camera::scene(name);
    for (std::size_t edit = 0; edit < scene.edits.size(); ++edit) {
      const SceneState through = scene.state(editTimes(name)[edit]),
                       above = scene.state(editTimes(name)[edit] - 2.0);
      const auto inBody = [&](const SceneState& state) {
        return transformed(state.T_camera_body.inverse() * *state.T_camera_tool, blade);
      };
      const TriangleMesh& patch = scene.edits[edit].patch;
      const Eigen::Vector3d corner = patch.vertices.row(0);
      const Eigen::Vector3d u = (patch.vertices.row(1) - patch.vertices.row(0)).transpose(),
                            normal = u.cross(Eigen::Vector3d::UnitZ()).normalized();
      for (const Points& at : {inBody(through), inBody(above)}) {
        EXPECT_LT(((at.rowwise() - corner.transpose()) * normal).cwiseAbs().maxCoeff(), 1e-9) << name;
      }
      EXPECT_NEAR(inBody(through).col(2).minCoeff(), patch.vertices.col(2).minCoeff(), 1e-9) << name;
      EXPECT_NEAR(inBody(above).col(2).minCoeff(), patch.vertices.col(2).maxCoeff(), 1e-9) << name;
      const MeshTopology& topology = scene.edits[edit].topology;
      const Points& before =
          edit == 0 ? scene.actors[0].rest.vertices : scene.edits[edit - 1].topology.rest_vertices;
      for (Eigen::Index i = before.rows(); i < topology.rest_vertices.rows(); ++i) {
        const Eigen::Vector3d p = topology.rest_vertices.row(i).transpose() - corner;
        EXPECT_NEAR(p.dot(normal), 0.0, 1e-9) << name;
        EXPECT_GT(p.dot(u.normalized()), 0.0) << name;
        EXPECT_LT(p.dot(u.normalized()), u.norm()) << name;
        EXPECT_GT(p.z(), -1e-9) << name;
      }
    }
  }
}

TEST(CutScenes, RefuseABodyThatTheBladeIsTooShortFor) {
  Body large = shippedBody("sponge");
  large.rest.vertices *= 1.2;
  EXPECT_NO_THROW(makeScene("cut", large, 1, kConfig + "/knife.yaml"));
  large.rest.vertices *= 1.2;
  EXPECT_THROW(makeScene("cut", large, 1, kConfig + "/knife.yaml"), std::invalid_argument);
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

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <fstream>
#include <opencv2/aruco.hpp>
#include <set>

#include "scene_fixtures.h"
#include "softbody_bringup/virtual_camera/plane_cut.h"
#include "softbody_bringup/virtual_camera/tool.h"
#include "softbody_bringup/virtual_camera/virtual_camera.h"
#include "softbody_common/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

const std::string kConfig = CONFIG_DIR;

Triangles pieceOf(const MeshTopology& topology, std::uint32_t body) {
  std::vector<int> rows;
  for (std::size_t f = 0; f < topology.bodies.size(); ++f) {
    if (topology.bodies[f] == body) rows.push_back(static_cast<int>(f));
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

TEST(PlaneCut, GivesTwoClosedPiecesWithTheExactVolumes) {
  const TriangleMesh sponge = shippedBody("sponge").rest;
  for (const double place : {-0.0833, 0.0049, 0.015}) {
    const MeshTopology cut = cutByPlane(sponge, place).topology;
    const double near = enclosedVolume(cut.rest_vertices, pieceOf(cut, 0)),
                 far = enclosedVolume(cut.rest_vertices, pieceOf(cut, 1));
    EXPECT_TRUE(isClosed(pieceOf(cut, 0)) && isClosed(pieceOf(cut, 1)));
    EXPECT_NEAR(near + far, 800e-6, 1e-12);
    EXPECT_NEAR(std::min(near, far), (0.1 - std::abs(place)) * 0.1 * 0.04, 1e-12);
  }
}

TEST(PlaneCut, KeepsTheVerticesAndMarksWhatIsNew) {
  const TriangleMesh sponge = shippedBody("sponge").rest;
  const PlaneCut result = cutByPlane(sponge, 0.015);
  const MeshTopology& cut = result.topology;
  EXPECT_EQ(cut.revision, 1u);
  EXPECT_EQ(cut.rest_vertices.topRows(522), sponge.vertices);
  double area = 0.0;
  for (Eigen::Index f = 0; f < cut.triangles.rows(); ++f) {
    const Eigen::Vector3d a = cut.rest_vertices.row(cut.triangles(f, 0)),
                          b = cut.rest_vertices.row(cut.triangles(f, 1)),
                          c = cut.rest_vertices.row(cut.triangles(f, 2));
    EXPECT_GT((b - a).cross(c - a).norm(), 1e-6) << "a sliver, triangle " << f;
    if (cut.cut[static_cast<std::size_t>(f)]) area += 0.5 * (b - a).cross(c - a).norm();
  }
  EXPECT_NEAR(area, 2.0 * 0.1 * 0.04, 1e-12);
  for (std::size_t i = 0; i < cut.vertex_parents.size(); ++i) {
    const double x = cut.rest_vertices(static_cast<Eigen::Index>(i), 0);
    EXPECT_EQ(cut.vertex_parents[i], i < 522 ? static_cast<int>(i) : -1);
    if (i >= 522) {
      EXPECT_EQ(x, 0.015);
    } else {
      EXPECT_EQ(result.beyond[i], x > 0.015);
    }
  }
}

TEST(PlaneCut, RefusesAPlaneThroughVerticesOrBesideTheBody) {
  const TriangleMesh sponge = shippedBody("sponge").rest;
  EXPECT_THROW(cutByPlane(sponge, 0.01), std::invalid_argument);
  EXPECT_THROW(cutByPlane(sponge, 0.2), std::invalid_argument);
}

Scene cutScene() { return makeScene("cut", shippedBody("sponge"), 1, kConfig + "/knife.yaml"); }

TEST(CutScene, PiecesTouchWhenTheTopologyChangesThenMoveApartRigidly) {
  const Scene scene = cutScene();
  const SceneState before = scene.state(2.499), after = scene.state(2.5), end = scene.state(8.0);
  EXPECT_EQ(before.revision, 0u);
  ASSERT_EQ(after.revision, 1u);
  EXPECT_LT((after.vertices[0].topRows(522) - before.vertices[0]).rowwise().norm().maxCoeff(), 1e-9);
  const MeshTopology& cut = scene.edits.at(0);
  EXPECT_NEAR(enclosedVolume(end.vertices[0], cut.triangles), 800e-6, 1e-11);
  const Eigen::Index last = cut.rest_vertices.rows() - 1;  // the two middles of the section
  EXPECT_LT((after.vertices[0].row(last) - after.vertices[0].row(last - 1)).norm(), 1e-9);
  EXPECT_GT((end.vertices[0].row(last) - end.vertices[0].row(last - 1)).norm(), 0.03);
}

TEST(CutScene, BladePassesThroughAllOfTheBodyBeforeThePiecesPart) {
  const Scene scene = cutScene();
  const Points blade = readTool(kConfig + "/knife.yaml").blade;
  const SceneState through = scene.state(2.5), start = scene.state(0.0);
  const auto inBody = [&](const SceneState& state) {
    return transformed(state.T_camera_body.inverse() * *state.T_camera_tool, blade);
  };
  EXPECT_GT(inBody(start).col(2).minCoeff(), 0.02);
  EXPECT_LT(inBody(through).col(2).minCoeff(), -0.02);
  EXPECT_LT(inBody(through).col(1).minCoeff(), -0.05);
  EXPECT_GT(inBody(through).col(1).maxCoeff(), 0.05);
  EXPECT_LT((inBody(through).col(0).array() - 0.015).abs().maxCoeff(), 1e-12);
}

/// Between detected corners, from the top left clockwise, and the marker's own [px].
double largestCornerError(const std::vector<cv::Point2f>& corners, const ToolMarker& marker,
                          const Eigen::Isometry3d& T_camera_tool, const Pinhole& camera) {
  const double half = 0.5 * marker.size_m;
  double largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d corner(k == 1 || k == 2 ? half : -half, k < 2 ? half : -half, 0.0);
    const Eigen::Vector2d pixel = camera.project(T_camera_tool * marker.T_tool_marker * corner);
    largest = std::max(largest, (Eigen::Vector2d(corners[k].x, corners[k].y) - pixel).norm());
  }
  return largest;
}

TEST(CutScene, MarkerIsFoundWhereTheTruthSaysAllTheWay) {
  const Tool tool = readTool(kConfig + "/knife.yaml");
  VirtualCamera camera(cutScene(), d435(640, 480), noNoise(), 1);
  const ToolMarker& marker = tool.markers.at(0);
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  parameters->minMarkerDistanceRate = 0.02;
  for (const double t : {0.0, 1.0, 1.5, 2.4, 2.6, 5.0}) {
    const Capture capture = camera.capture(0, t);
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(capture.color, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50),
                             corners, ids, parameters);
    ASSERT_FALSE(ids.empty()) << "at " << t;
    double error = 1e9;  // [px]; the detector may find a marker's outline twice
    for (std::size_t i = 0; i < ids.size(); ++i) {
      EXPECT_EQ(ids[i], marker.id);
      error =
          std::min(error, largestCornerError(corners[i], marker, *capture.T_camera_tool, camera.pinhole()));
    }
    EXPECT_LT(error, 0.7) << "at " << t;
  }
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

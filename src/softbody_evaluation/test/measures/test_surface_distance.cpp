#include "softbody_evaluation/measures/surface_distance.h"

#include <gtest/gtest.h>

#include "fixtures/grid_bodies.h"
#include "fixtures/round_bodies.h"

namespace softbody::evaluation {
namespace {

/// A box with the same surface whatever the cells are.
MeshTopology box(int cells) {
  return gridBox({0.2, 0.1, 0.04}, {2 * cells, cells, cells}, [](double x) { return x; });
}

MeshTopology ballOf(double radius, int rings) {
  MeshTopology mesh;
  const Model model = roundBody([radius](const Eigen::Vector3d&) { return radius; }, rings, 2 * rings);
  mesh.rest_vertices = model.mesh.vertices;
  mesh.triangles = model.mesh.triangles;
  return mesh;
}

/// At rest, and moved; the camera sees what has a large z.
MeshState stateOf(const MeshTopology& mesh, const Eigen::RowVector3d& shift) {
  MeshState state;
  state.vertices = mesh.rest_vertices.rowwise() + shift;
  for (const auto& vertex : mesh.rest_vertices.rowwise())
    state.confidence.push_back(vertex.z() > 1e-6 ? 1.0f : 0.0f);
  return state;
}

SurfaceDistanceReport distances(const MeshTopology& mesh, const MeshTopology& truth,
                                const Eigen::RowVector3d& shift = Eigen::RowVector3d::Zero()) {
  return summarize({surfaceDistance(measuredPlaces(mesh), mesh.triangles, stateOf(mesh, shift), truth,
                                    stateOf(truth, Eigen::RowVector3d::Zero()))});
}

TEST(SurfaceDistance, AnotherMeshOfTheSameSurfaceHasNone) {
  EXPECT_LT(distances(box(7), box(4)).all.max, 1e-9);
  EXPECT_LT(distances(box(2), box(9)).all.max, 1e-9);
}

TEST(SurfaceDistance, OfALargerBallIsTheDifferenceOfTheRadii) {
  const double sag = 0.05 * (1.0 - std::cos(M_PI / 60.0));  // of the chords of 60 rings
  const SurfaceDistanceReport report = distances(ballOf(0.052, 60), ballOf(0.05, 60));
  EXPECT_NEAR(report.all.mean, 0.002, sag);
  EXPECT_NEAR(report.all.max, 0.002, 2.0 * sag);
  EXPECT_NEAR(report.visible.mean, report.hidden.mean, sag);
  EXPECT_NEAR(static_cast<double>(report.visible.count) / static_cast<double>(report.all.count), 0.5, 0.03);
}

TEST(SurfaceDistance, OfAShiftedBoxIsTheShiftOfTheSidesThatDoNotSlide) {
  const double top_and_bottom = 2.0 * 0.2 * 0.1, around = 2.0 * 0.04 * (0.2 + 0.1);
  const SurfaceDistanceReport report = distances(box(6), box(5), {0.0, 0.0, 0.001});
  EXPECT_NEAR(report.all.max, 0.001, 1e-9);
  EXPECT_NEAR(report.all.mean, 0.001 * top_and_bottom / (top_and_bottom + around), 2e-5);
}

TEST(SurfaceDistance, SaysWhatWasVisibleByTheTruth) {
  // The result's own confidence must not count.
  const MeshTopology mesh = box(4);
  MeshState result = stateOf(mesh, {0.0, 0.0, 0.0});
  result.vertices.col(2) *= 1.1;  // top and bottom move by 2 mm
  result.confidence.assign(result.confidence.size(), 0.0f);
  const MeshState truth = stateOf(mesh, {0.0, 0.0, 0.0});
  const FrameSurfaceDistance frame =
      surfaceDistance(measuredPlaces(mesh), mesh.triangles, result, mesh, truth);
  EXPECT_NEAR(static_cast<double>(frame.visible.size()), static_cast<double>(frame.hidden.size()), 200.0);
}

TEST(SurfaceDistance, ASurfaceWithoutAreaIsRefused) {
  MeshTopology flat = box(2);
  flat.rest_vertices.setZero();
  EXPECT_THROW(measuredPlaces(flat), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::evaluation

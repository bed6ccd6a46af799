#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <stdexcept>

#include "shapes.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "tets/tets_model.h"

namespace softbody {
namespace {

TEST(Cutaway, withAllTetsShowsTheSurfaceOfTheBody) {
  const TetTopology cube = cubeOfTets();
  const CutawayFaces faces = cutawayFaces(cube, {});
  EXPECT_EQ(faces.triangles.rows(), cube.surface.rows());
  EXPECT_NEAR(enclosedVolume(cube.rest_vertices, faces.triangles), 1.0, 1e-12);
}

TEST(Cutaway, facesEncloseTheTetsThatStay) {
  const TetTopology cube = cubeOfTets();
  const Eigen::VectorXd volumes = tetVolumes(cube.rest_vertices, cube.tets);
  for (int axis = 0; axis < 3; ++axis) {
    double both_sides = 0.0;
    for (const bool flip : {false, true}) {
      const CutawayFaces faces = cutawayFaces(cube, {axis, 0.5, flip});
      ASSERT_GT(faces.triangles.rows(), 0);
      EXPECT_TRUE(isClosed(faces.triangles));
      const std::set<int> kept(faces.tets.begin(), faces.tets.end());
      double volume = 0.0;
      for (const int tet : kept) volume += volumes[tet];
      EXPECT_NEAR(enclosedVolume(cube.rest_vertices, faces.triangles), volume, 1e-12);
      both_sides += volume;
    }
    EXPECT_NEAR(both_sides, 1.0 + 2.0 / 6.0, 1e-12) << "two tets have their centres in the plane";
  }
}

TEST(Cutaway, everyFaceKnowsItsTet) {
  const TetTopology cube = cubeOfTets();
  const CutawayFaces faces = cutawayFaces(cube, {1, 0.4, false});
  for (std::size_t f = 0; f < faces.tets.size(); ++f) {
    const auto tet = cube.tets.row(faces.tets[f]);
    for (const int vertex : faces.triangles.row(static_cast<int>(f)))
      EXPECT_TRUE((tet.array() == vertex).any());
  }
}

TEST(TetValues, aRegularTetHasQualityOneAndAFlatOneZero) {
  Points vertices(4, 3);
  vertices << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
  Tets tet(1, 4);
  tet << 0, 2, 1, 3;
  if (tetVolumes(vertices, tet)[0] < 0.0) std::swap(tet(0, 0), tet(0, 1));
  EXPECT_NEAR(tetQualities(0.01 * vertices, tet)[0], 1.0f, 1e-6f);
  Points flat = vertices;
  flat.col(2).setZero();
  EXPECT_EQ(tetQualities(flat, tet)[0], 0.0f);
  std::swap(tet(0, 0), tet(0, 1));
  EXPECT_EQ(tetQualities(vertices, tet)[0], 0.0f) << "inverted";
}

TEST(TetValues, strainIsTheLargestChangeOfLength) {
  const TetTopology cube = cubeOfTets();
  const TetStrain strain(cube);
  const Eigen::Isometry3d T(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  for (const Eigen::RowVector3d& stretch :
       {Eigen::RowVector3d(1, 1, 1), Eigen::RowVector3d(1.2, 1, 0.9), Eigen::RowVector3d(0.7, 1.1, 1)}) {
    const Points now = transformed(cube.rest_vertices.array().rowwise() * stretch.array(), T);
    const double expected = (stretch.array() - 1.0).abs().maxCoeff();
    for (const float value : strain.at(now)) EXPECT_NEAR(value, expected, 1e-5);
  }
}

TEST(TetsModel, drawsEachTetInTheColourOfItsValue) {
  TetsModel model(cubeOfTets());
  const Points rest = model.topology().rest_vertices;
  EXPECT_THROW(model.setState(stateAt(rest.topRows(7))), std::invalid_argument);
  model.setState(stateAt(rest));
  std::vector<float> values(6, 0.0f);
  values[2] = 1.0f;
  const auto colors = model.painted(TetColoring::kStrain, {}, ColorMap::kViridis, values, 1.0);
  const auto marked = std::count(colors.begin(), colors.end(), colorOf(ColorMap::kViridis, 1.0));
  EXPECT_EQ(marked, 2 * 3) << "tet 2 has two faces on the surface";
  EXPECT_EQ(colors.size(), static_cast<std::size_t>(model.topology().surface.size()));
}

TEST(TetsModel, leavesOutTargetsInTetsThatDoNotExist) {
  TetsModel model(cubeOfTets());
  model.setState(stateAt(model.topology().rest_vertices));
  TargetSet targets;
  for (const int tet : {0, 5, 6, -1}) {
    Target target;
    target.kind = TargetKind::kDepth;
    target.place = {tet, {0.25, 0.25, 0.25, 0.25}};
    targets.targets.push_back(target);
  }
  EXPECT_EQ(model.arrows(targets, TargetKind::kDepth, 1.0).size(), 2u);
  EXPECT_EQ(model.arrows(targets, TargetKind::kFeature, 1.0).size(), 0u);
}

}  // namespace
}  // namespace softbody

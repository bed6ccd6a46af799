#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "shapes.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "surface/surface_model.h"

namespace softbody {
namespace {

const Eigen::Isometry3d kMotion =
    Eigen::Translation3d(0.3, -1, 2) * Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 1, -2).normalized());

TEST(SurfaceModel, rigidMotionIsNeitherStrainNorDistanceFromRest) {
  SurfaceModel model(boxSurface(3), 1.0);
  model.setState(stateAt(transformed(model.topology().rest_vertices, kMotion)));
  for (const auto coloring : {SurfaceColoring::kStrain, SurfaceColoring::kDistanceFromRest}) {
    for (const float value : model.values(coloring)) EXPECT_NEAR(value, 0.0f, 1e-6f);
  }
}

TEST(SurfaceModel, strainOfAUniformStretchIsKnown) {
  SurfaceModel model(boxSurface(3), 1.0);
  const Points& rest = model.topology().rest_vertices;
  model.setState(stateAt(transformed(1.25 * rest, kMotion)));
  for (const float strain : model.values(SurfaceColoring::kStrain)) EXPECT_NEAR(strain, 0.25f, 1e-6f);
  model.setState(stateAt(transformed(0.6 * rest, kMotion)));
  for (const float strain : model.values(SurfaceColoring::kStrain)) EXPECT_NEAR(strain, 0.4f, 1e-6f);
}

TEST(SurfaceModel, strainIsTheLargestOfAllDirections) {
  SurfaceModel model(boxSurface(3), 1.0);
  Points stretched = model.topology().rest_vertices;
  stretched.col(2) *= 1.5;
  model.setState(stateAt(stretched));
  const std::vector<float> strain = model.values(SurfaceColoring::kStrain);
  for (Eigen::Index v = 0; v < stretched.rows(); ++v) {
    if (std::abs(model.topology().rest_vertices(v, 2) - 0.5) < 0.2) {
      EXPECT_NEAR(strain[v], 0.5f, 1e-6f) << v;  // all its triangles are stretched
    } else {
      EXPECT_LE(strain[v], 0.5f + 1e-6f) << v;
    }
  }
}

TEST(SurfaceModel, everyPieceHasARestPlaceOfItsOwn) {
  const MeshTopology box = boxSurface(2);
  MeshTopology two = box;
  const int count = static_cast<int>(box.rest_vertices.rows());
  two.rest_vertices.resize(2 * count, 3);
  two.rest_vertices << box.rest_vertices, box.rest_vertices.array() + 3.0;
  two.triangles.resize(2 * box.triangles.rows(), 3);
  two.triangles << box.triangles, box.triangles.array() + count;
  two.triangle_pieces.insert(two.triangle_pieces.end(), box.triangle_pieces.size(), 1);
  two.cut.insert(two.cut.end(), box.cut.size(), false);
  SurfaceModel model(two, 1.0);
  Points moved = two.rest_vertices;
  moved.bottomRows(count) = transformed(two.rest_vertices.bottomRows(count), kMotion);
  model.setState(stateAt(moved));
  for (const float distance : model.values(SurfaceColoring::kDistanceFromRest))
    EXPECT_NEAR(distance, 0.0f, 1e-6f);
  EXPECT_EQ(model.vertexPieces().front(), 0u);
  EXPECT_EQ(model.vertexPieces().back(), 1u);
}

TEST(SurfaceModel, aStateOfAnotherTopologyIsRefused) {
  SurfaceModel model(boxSurface(2), 1.0);
  const Points rest = model.topology().rest_vertices;
  model.setState(stateAt(rest));
  EXPECT_THROW(model.setState(stateAt(rest, 1)), std::invalid_argument);
  EXPECT_THROW(model.setState(stateAt(rest.topRows(3))), std::invalid_argument);
  EXPECT_EQ(model.state()->vertices, rest);
}

TEST(SurfaceModel, cutFacesHaveTheirOwnColourUnlessColoursShowValues) {
  MeshTopology box = boxSurface(2);
  box.cut[0] = box.cut[1] = true;
  SurfaceModel model(box, 1.0);
  model.setState(stateAt(box.rest_vertices));
  SurfacePaint paint;
  paint.coloring = SurfaceColoring::kPiece;
  auto colors = model.painted(paint, {});
  for (const std::uint32_t i : model.layout().parts[1]) EXPECT_EQ(colors[i], paint.cut);
  for (const std::uint32_t i : model.layout().parts[0]) EXPECT_EQ(colors[i], pieceColor(0));
  paint.coloring = SurfaceColoring::kConfidence;
  colors = model.painted(paint, model.values(paint.coloring));
  for (const Color& color : colors) EXPECT_EQ(color, colorOf(paint.map, 1.0));
}

TEST(SurfaceModel, theTextureIsWhiteOrTheColoursOfTheMeshFile) {
  MeshTopology box = boxSurface(2);
  box.cut[0] = true;
  SurfaceModel model(box, 1.0);
  model.setState(stateAt(box.rest_vertices));
  SurfacePaint paint;
  paint.coloring = SurfaceColoring::kTexture;
  for (const std::uint32_t i : model.layout().parts[0])
    EXPECT_EQ(model.painted(paint, {})[i], (Color{255, 255, 255, 255}));
  for (Eigen::Index v = 0; v < box.rest_vertices.rows(); ++v)
    paint.own.push_back({static_cast<std::uint8_t>(v), 7, 200});
  const auto colors = model.painted(paint, {});
  for (const std::uint32_t i : model.layout().parts[0])
    EXPECT_EQ(colors[i], (Color{static_cast<std::uint8_t>(model.layout().vertices[i]), 7, 200, 255}));
  for (const std::uint32_t i : model.layout().parts[1]) EXPECT_EQ(colors[i], paint.cut);
}

TEST(SurfaceModel, aDeviationThatIsNotEstimatedIsGrey) {
  SurfaceModel model(boxSurface(2), 1.0);
  MeshState state = stateAt(model.topology().rest_vertices);
  model.setState(state);
  SurfacePaint paint;
  paint.coloring = SurfaceColoring::kStandardDeviation;
  paint.maximum = 0.01;
  EXPECT_TRUE(model.values(paint.coloring).empty());
  const Color grey = model.painted(paint, {}).front();
  EXPECT_EQ(grey.red, grey.green);
  EXPECT_EQ(grey.green, grey.blue);
  state.standard_deviation.assign(state.confidence.size(), 0.005f);
  model.setState(state);
  EXPECT_EQ(model.painted(paint, model.values(paint.coloring)).front(), colorOf(paint.map, 0.5));
}

}  // namespace
}  // namespace softbody

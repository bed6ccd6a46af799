#include <test_support/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "body/state_check.h"
#include "shapes.h"
#include "softbody_common/ros/conversions.h"
#include "surface/surface_model.h"
#include "tets/tets_model.h"

namespace softbody {
namespace {

std::string faultOf(const MeshState& state, const Points& rest) try {
  requireDrawable(state, 0, rest);
  return "";
} catch (const std::invalid_argument& error) {
  return error.what();
}

TEST(StateCheck, aBodyThatMovesAndBendsIsDrawn) {
  const Points rest = 0.1 * boxSurface(4).rest_vertices;
  EXPECT_EQ(faultOf(stateAt(rest), rest), "");
  EXPECT_EQ(faultOf(stateAt(rest.array() + 30.0), rest), "");
  Points pressed = rest;
  pressed.col(1) *= 0.02;
  EXPECT_EQ(faultOf(stateAt(pressed), rest), "");
  Points apart = rest;  // pieces that are carried away
  apart.topRows(apart.rows() / 3).array() += 0.4;
  EXPECT_EQ(faultOf(stateAt(apart), rest), "");
}

TEST(StateCheck, verticesAtOnePlaceAreRefused) {
  const Points rest = 0.1 * boxSurface(3).rest_vertices;
  EXPECT_TRUE(says(faultOf(stateAt(Points::Zero(rest.rows(), 3)), rest), "all vertices are at (0, 0, 0)"));
  EXPECT_NE(faultOf(stateAt(1e-5 * rest), rest), "");
}

TEST(StateCheck, aVertexFarFromTheOthersIsNamed) {
  std::mt19937 random(3);
  const Points rest = 0.1 * boxSurface(3).rest_vertices;
  for (int i = 0; i < 30; ++i) {
    Points vertices = rest.array() + 2.0;
    const auto vertex = static_cast<int>(random() % static_cast<unsigned>(rest.rows()));
    vertices(vertex, i % 3) = i % 2 == 0 ? 9e3 : -1e20;
    const std::string fault = faultOf(stateAt(vertices), rest);
    EXPECT_EQ(fault.rfind("vertex " + std::to_string(vertex) + " is", 0), 0u) << fault;
  }
}

/// Every number of a state is set to what no sender can mean. The displays keep the last good state.
TEST(StateCheck, aBadNumberAnywhereIsRefusedAndTheLastStateIsKept) {
  const MeshTopology box = boxSurface(2);
  SurfaceModel surface(box, 1.0);
  TetsModel tets(cubeOfTets());
  surface.setState(stateAt(box.rest_vertices));
  tets.setState(stateAt(cubeOfTets().rest_vertices));
  const auto count = static_cast<std::size_t>(box.rest_vertices.rows());
  for (const float bad : {NAN, INFINITY, -INFINITY, 1e20f, -3e38f}) {
    for (int field = 0; field < 4; ++field) {
      softbody_msgs::MeshState message = toMessage(stateAt(box.rest_vertices));
      message.standard_deviation.assign(count, 0.001f);
      if (field == 0) message.vertices[5].x = bad;
      if (field == 1) message.vertices[count - 1].z = bad;
      if (field == 2) message.confidence[3] = bad;
      if (field == 3 && bad != 1e20f) message.standard_deviation[0] = bad;
      if (field == 3 && bad == 1e20f) message.vertices.pop_back();
      EXPECT_THROW(surface.setState(fromMessage(message)), std::invalid_argument) << bad << " in " << field;
    }
  }
  for (const int rows : {0, 1, 7, 9}) {
    MeshState state = stateAt(Points::Random(rows, 3));
    EXPECT_THROW(tets.setState(state), std::invalid_argument) << rows;
  }
  EXPECT_TRUE(surface.state()->vertices.isApprox(box.rest_vertices));
  EXPECT_TRUE(tets.state()->vertices.isApprox(cubeOfTets().rest_vertices));
}

TEST(StateCheck, topologiesWithIndicesOutOfRangeAreRefused) {
  softbody_msgs::MeshTopology surface = toMessage(boxSurface(1));
  softbody_msgs::TetTopology tets = toMessage(cubeOfTets());
  EXPECT_NO_THROW(fromMessage(surface));
  EXPECT_NO_THROW(fromMessage(tets));
  for (const std::uint32_t bad : {8u, 1u << 31, ~0u}) {
    auto worse_surface = surface;
    worse_surface.triangles[3].vertex_indices[1] = bad;
    EXPECT_THROW(fromMessage(worse_surface), std::invalid_argument);
    worse_surface = surface;
    worse_surface.triangle_bodies[2] = std::max(bad, 12u);  // it has 12 triangles
    EXPECT_THROW(fromMessage(worse_surface), std::invalid_argument);
    auto worse_tets = tets;
    worse_tets.tets[2].vertex_indices[3] = bad;
    EXPECT_THROW(fromMessage(worse_tets), std::invalid_argument);
    worse_tets = tets;
    worse_tets.surface_triangles[0].vertex_indices[0] = bad;
    EXPECT_THROW(fromMessage(worse_tets), std::invalid_argument);
  }
}

TEST(StateCheck, arrowsOfNoSensibleLengthAreNotDrawn) {
  TetsModel tets(cubeOfTets());
  tets.setState(stateAt(cubeOfTets().rest_vertices));
  TargetSet targets;
  Target target;
  target.kind = TargetKind::kFeature;
  target.place = {0, Eigen::Vector4d(0.25, 0.25, 0.25, 0.25)};
  target.weight = 1.0;
  targets.targets.push_back(target);
  target.place.barycentric << 1e20, -1e20, 1.0, 0.0;
  targets.targets.push_back(target);
  EXPECT_EQ(tets.arrows(targets, TargetKind::kFeature, 1.0).size(), 1u);
}

}  // namespace
}  // namespace softbody

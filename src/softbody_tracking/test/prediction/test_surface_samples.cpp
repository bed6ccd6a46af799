#include <gtest/gtest.h>

#include "prediction/surface_samples.h"

namespace softbody {
namespace {

TEST(ShownVertices, AreThoseOfTetsWithASample) {
  TetTopology volume;
  volume.rest_vertices = Points::Zero(9, 3);
  volume.tets.resize(3, 4);
  volume.tets << 0, 1, 2, 3, 1, 2, 3, 4, 5, 6, 7, 8;
  SurfaceSamples samples;
  EXPECT_EQ(shownVertices(samples, volume), 0);
  for (const int tet : {0, 1, 0}) {
    const MaterialPoint place{tet, Eigen::Vector4d::Constant(0.25)};
    samples.samples.push_back({{}, place, 0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  }
  EXPECT_EQ(shownVertices(samples, volume), 5) << "each counts once";
}

}  // namespace
}  // namespace softbody

#include "tools/held_regions.h"

#include <gtest/gtest.h>

#include <limits>

#include "fixtures/test_meshes.h"
#include "softbody_sim/object/vertex_region.h"

namespace softbody {
namespace {

const Points kRest = testing::boxTopology({4, 2, 2}, {0.4, 0.2, 0.2}).rest_vertices;

TEST(BoxOf, HasTheLimitsOfAllConditions) {
  const Eigen::AlignedBox3d box = boxOf("x<0.3 & x>=0.1 & z<=0.2 & x < 0.4");
  EXPECT_EQ(box.min(), Eigen::Vector3d(0.1, -std::numeric_limits<double>::infinity(),
                                       -std::numeric_limits<double>::infinity()));
  EXPECT_LT(box.max().x(), 0.3);
  EXPECT_GT(box.max().x(), 0.3 - 1e-12);
  EXPECT_EQ(box.max().z(), 0.2);
}

TEST(HeldRegions, MoveAndTurnAboutTheCentreOfTheirBox) {
  const Eigen::Vector3d shift(0.1, 0.0, -0.2), turn(M_PI, 0.0, 0.0);
  const HeldRegions held({{"x<0.01"}, {"x>0.39", shift, turn}}, kRest, 0.0);
  EXPECT_NEAR(held.longestWay(), shift.norm() + M_PI * 0.1 * std::sqrt(2.0), 1e-12);
  for (const double share : {0.0, 0.5, 1.0}) {
    const std::vector<Pin> pins = held.pinsAt(share);
    ASSERT_EQ(pins.size(), 18u);
    for (const Pin& pin : pins) {
      Eigen::Vector3d expected = kRest.row(pin.vertex);
      if (expected.x() > 0.39) {
        const Eigen::Vector3d center(0.4, 0.1, 0.1);
        expected = center + share * shift +
                   Eigen::AngleAxisd(share * M_PI, Eigen::Vector3d::UnitX()) * (expected - center);
      }
      EXPECT_LT((pin.position - expected).norm(), 1e-12);
    }
  }
}

TEST(HeldRegions, SumForcesAndTorquesOfEachRegion) {
  const HeldRegions held(
      {{"x<0.01"}, {"x>0.39 & z<0.01", {0.0, 0.0, 1.0}, Eigen::Vector3d::Zero()}, {"x<0.01 & z<0.01"}}, kRest,
      0.0);
  const std::vector<Pin> pins = held.pinsAt(1.0);
  std::vector<Wrench> forces(pins.size());
  for (std::size_t k = 0; k < pins.size(); ++k)  // a couple about x at each place
    forces[k].force = Eigen::Vector3d(2.0, 0.0, kRest(pins[k].vertex, 1) - 0.1);
  const std::vector<Wrench> wrenches = held.wrenches(forces, 1.0);
  ASSERT_EQ(wrenches.size(), 3u);
  for (const auto& [region, rows] : {std::pair<std::size_t, double>{0, 3.0}, {1, 1.0}, {2, 1.0}}) {
    EXPECT_LT((wrenches[region].force - Eigen::Vector3d(6.0 * rows, 0.0, 0.0)).norm(), 1e-12);
    EXPECT_LT((wrenches[region].torque - Eigen::Vector3d(0.02 * rows, 0.0, 0.0)).norm(), 1e-12);
  }
}

TEST(HeldRegions, AVertexCanMakeOneMotion) {
  const Eigen::Vector3d shift(0.1, 0.0, 0.0);
  EXPECT_NO_THROW(HeldRegions({{"x<0.01", shift}, {"all"}}, kRest, 0.0));
  EXPECT_THROW(HeldRegions({{"x<0.01", shift}, {"x<0.11", shift}}, kRest, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace softbody

#include <test_support/gtest.h>

#include <numeric>
#include <random>
#include <stdexcept>

#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/surroundings/surroundings_follower.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::sponge;

const Eigen::Isometry3d kAtRest = Eigen::Isometry3d::Identity();
const Eigen::Vector3d kSize(0.19, 0.09, 0.024),
    kMargin(0.005, 0.005, 0.003);  // of the visual mesh in the tets [m]

/// A fine visual mesh inside the coarse tets of the sponge.
MeshTopology visualMesh() {
  const TetTopology fine = boxTopology({60, 30, 1}, kSize);
  MeshTopology visual;
  visual.rest_vertices = fine.rest_vertices.rowwise() + kMargin.transpose();
  visual.triangles = fine.surface;
  visual.vertex_parents.resize(static_cast<std::size_t>(fine.rest_vertices.rows()));
  std::iota(visual.vertex_parents.begin(), visual.vertex_parents.end(), 0);
  visual.triangle_pieces.resize(static_cast<std::size_t>(fine.surface.rows()));
  visual.cut.resize(static_cast<std::size_t>(fine.surface.rows()));
  return visual;
}

/// A small box about a point of the surface.
Eigen::AlignedBox3d boxAt(const Eigen::Vector3d& point, double size_m) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * size_m);
  return {point - half, point + half};
}

/// The visual vertices in a box that move when all vertices move but the held ones.
double largestMotionIn(const Eigen::AlignedBox3d& box, const std::vector<int>& held,
                       const TetTopology& volume, std::mt19937* random) {
  const MeshTopology visual = visualMesh();
  Points moved = volume.rest_vertices + testing::randomPoints(volume.rest_vertices.rows(), 0.01, random);
  for (const int v : held) moved.row(v) = volume.rest_vertices.row(v);
  const Points places =
      applyBinding(bindPoints(visual.rest_vertices, volume.rest_vertices, volume.tets), moved, volume.tets);
  double largest = 0.0;
  for (Eigen::Index v = 0; v < places.rows(); ++v)
    if (box.contains(Eigen::Vector3d(visual.rest_vertices.row(v))))
      largest = std::max(largest, (places.row(v) - visual.rest_vertices.row(v)).norm());
  return largest;
}

TEST(BodySurface, ABoxThatIsSmallerThanATetHoldsWhatIsSeenInIt) {
  const TetTopology volume = sponge();
  const BodySurface surface = BodySurface(visualMesh(), volume).in(volume);
  std::mt19937 random(3);
  const Points places = visualMesh().rest_vertices;
  for (int k = 0; k < 100; ++k) {
    const auto v = std::uniform_int_distribution<Eigen::Index>(0, places.rows() - 1)(random);
    const Eigen::AlignedBox3d box = boxAt(places.row(v), 0.004);
    const std::vector<int> held = surface.verticesToHold(box, kAtRest, volume.rest_vertices);
    EXPECT_TRUE(BodySurface().verticesToHold(box, kAtRest, volume.rest_vertices).empty());
    ASSERT_FALSE(held.empty());
    EXPECT_TRUE(std::is_sorted(held.begin(), held.end()));
    EXPECT_LT(largestMotionIn(box, held, volume, &random), 1e-12);
  }
}

TEST(BodySurface, AHalfIsHeldUpToTheVerticesNearestToItsSide) {
  const TetTopology volume = sponge();  // its tets are 20 mm long
  const BodySurface surface = BodySurface(visualMesh(), volume).in(volume);
  constexpr double kTet = 0.02, kSpacing = 0.19 / 60.0;  // of the tets, of the visual vertices [m]
  for (int k = 0; k < 200; ++k) {
    const double limit = 0.02 + 0.15 * k / 200.0;
    const Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d(limit, 1.0, 1.0));
    double end = 0.0;
    for (const int v : surface.verticesToHold(box, kAtRest, volume.rest_vertices))
      end = std::max(end, volume.rest_vertices(v, 0));
    EXPECT_LE(end, limit + 0.5 * kTet);
    EXPECT_GE(end, limit - 0.5 * kTet - kSpacing);
    for (Eigen::Index v = 0; v < volume.rest_vertices.rows(); ++v)
      EXPECT_TRUE(volume.rest_vertices(v, 0) >= limit || volume.rest_vertices(v, 0) <= end);
  }
}

TEST(BodySurface, ABoxBesideTheBodyNamesWhatIsNearest) {
  const TetTopology volume = sponge();
  const BodySurface surface = BodySurface(visualMesh(), volume).in(volume);
  const Eigen::Vector3d corner = kMargin + kSize;
  const Eigen::AlignedBox3d box(corner + Eigen::Vector3d(0.012, -0.001, -0.001),
                                corner + Eigen::Vector3d(0.05, 0.05, 0.05));
  EXPECT_TRUE(surface.verticesToHold(box, kAtRest, volume.rest_vertices).empty());
  const std::string words = surface.nearestTo(box, kAtRest, volume.rest_vertices);
  EXPECT_TRUE(says(words, "12 mm outside at [0.195, 0.095, 0.027] m"));
  EXPECT_TRUE(says(words, "of the visual mesh"));
  EXPECT_TRUE(says(complaint([&] { surface.verticesAtRest("the box", box, volume.rest_vertices); }), words));
}

TEST(BodySurface, FollowsAnEditOfTheTets) {
  const TetTopology volume = sponge(), edited = boxTopology({7, 3, 2}, {0.2, 0.1, 0.03});
  const BodySurface surface = BodySurface(visualMesh(), volume).in(edited);
  std::mt19937 random(5);
  const Points places = visualMesh().rest_vertices;
  for (Eigen::Index v = 0; v < places.rows(); v += 97) {
    const Eigen::AlignedBox3d box = boxAt(places.row(v), 0.002);
    const std::vector<int> held = surface.verticesToHold(box, kAtRest, edited.rest_vertices);
    ASSERT_FALSE(held.empty());
    EXPECT_LT(largestMotionIn(box, held, edited, &random), 1e-9);
  }
}

TEST(BodySurface, IsOneForAllThatAskUntilTheTetsChange) {
  const TetTopology volume = sponge(), edited = boxTopology({7, 3, 2}, {0.2, 0.1, 0.03});
  SurroundingsFollower follower({}, BodySurface(visualMesh(), volume));
  const auto surface = follower.surfaceIn(volume);
  follower.addPin({"all", "", Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(1.0)}, volume);
  EXPECT_EQ(follower.surfaceIn(volume), surface);
  EXPECT_NE(follower.surfaceIn(edited), surface);
}

TEST(BodySurface, ABoxInAFrameHoldsTheDeformedSurface) {
  const TetTopology volume = sponge();
  const BodySurface surface = BodySurface(visualMesh(), volume).in(volume);
  const Eigen::Isometry3d pose = testing::somePose();
  const Eigen::AlignedBox3d box = boxAt(visualMesh().rest_vertices.row(40), 0.004);
  const Points placed = transformed(volume.rest_vertices, pose);
  EXPECT_EQ(surface.verticesToHold(box, pose.inverse(), placed),
            surface.verticesToHold(box, kAtRest, volume.rest_vertices));
}

/// A pin on a patch of the visual mesh that no vertex of the tets lies in carries the whole weight.
TEST(BodySurface, APinnedPatchStaysAndCarriesTheWeight) {
  const TetTopology volume = sponge();
  Material material;
  material.youngs_modulus_pa = 1e6;
  SimulatorConfig config;
  config.gravity = {0.0, 0.0, -9.81};
  Simulator simulator(volume, material, config);
  simulator.step(testing::placing(kAtRest), testing::kFrame);
  constexpr double kExact = 0.0;
  SurroundingsFollower follower(kExact, BodySurface(visualMesh(), volume));
  const Eigen::Vector3d corner = kMargin + kSize;
  const Eigen::AlignedBox3d box = boxAt(corner, 0.005);
  EXPECT_GT(follower.addPin({"patch", "", box.min(), box.max()}, volume), 0U);
  const FrameLookup none = [](const std::string&, Nanoseconds) { return std::nullopt; };
  const Surroundings around =
      follower.surroundingsAt(2 * testing::kFrame, none, simulator.state().vertices, testing::kFrame);
  simulator.settle({}, around);
  const auto places = bindPoints(visualMesh().rest_vertices, volume.rest_vertices, volume.tets);
  const Points before = applyBinding(places, volume.rest_vertices, volume.tets);
  const Points after = applyBinding(places, simulator.state().vertices, volume.tets);
  double largest = 0.0;
  for (Eigen::Index v = 0; v < before.rows(); ++v)
    if (box.contains(Eigen::Vector3d(before.row(v))))
      largest = std::max(largest, (after.row(v) - before.row(v)).norm());
  const double free_end = (after.row(0) - before.row(0)).norm();
  EXPECT_GT(free_end, 1e-4);
  EXPECT_LT(largest, 1e-3 * free_end);
  double carried = 0.0;
  for (const Wrench& pin : simulator.reactions().pins) carried -= pin.force.z();
  const double weight = 9.81 * material.density_kg_m3 * tetVolumes(volume.rest_vertices, volume.tets).sum();
  EXPECT_NEAR(carried, weight, 1e-3 * weight);
}

}  // namespace
}  // namespace softbody

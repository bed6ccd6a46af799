#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>

#include "cage/volume_maker.h"
#include "cutting/fixtures/cut_bodies.h"
#include "cutting/volume/manifold.h"
#include "fixtures/model_files.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"

namespace softbody {
namespace {

using testing::RandomCuts;

/// Total number of planes, sweeps and repeated cuts of each body: few in `make test`, all in `make cuts`.
int cutsPerBody() {
  const char* wanted = std::getenv("SOFTBODY_CUTS_PER_BODY");
  return wanted != nullptr ? std::atoi(wanted) : 60;
}

struct Tally {
  int made = 0, missed = 0, refused = 0;
  double worst_quality = 1.0;  ///< of tets that are parts of cut tets
  double worst_volume = 0.0;   ///< relative change
};

/// Checks the published topology, in single precision, after any cut.
void expectSound(const TetEdit& edit, const TetTopology& before, Tally* tally) {
  const TetTopology& after = edit.topology;
  EXPECT_EQ(after.rest_vertices, inSinglePrecision(after.rest_vertices));
  EXPECT_EQ(nonManifoldVertices(after.surface), std::vector<int>());
  const double volume = tetVolumes(before.rest_vertices, before.tets).sum();
  const Eigen::VectorXd volumes = tetVolumes(after.rest_vertices, after.tets);
  EXPECT_GT(volumes.minCoeff(), 0.0);
  const double change = std::abs(volumes.sum() / volume - 1.0);
  EXPECT_LT(change, 1e-6);
  EXPECT_NEAR(enclosedVolume(after.rest_vertices, after.surface) / volume, 1.0, 1e-6);
  tally->worst_volume = std::max(tally->worst_volume, change);
  for (const std::vector<int>& parts : edit.successors) {
    if (parts.size() == 1) continue;
    for (const int part : parts) {
      const double quality = tetQuality(after.rest_vertices, after.tets.row(part));
      EXPECT_GE(quality, SubdivisionSettings().worst_quality);
      tally->worst_quality = std::min(tally->worst_quality, quality);
    }
  }
}

/// Whether no piece extends to both sides of the plane by more than its longest edge.
bool isParted(const TetTopology& after, const RandomCuts::Plane& plane) {
  struct Reach {
    double below = 0.0, above = 0.0, longest_edge = 0.0;
  };
  std::map<std::uint32_t, Reach> pieces;
  for (Eigen::Index t = 0; t < after.tets.rows(); ++t) {
    Reach& reach = pieces[after.tet_pieces[static_cast<std::size_t>(t)]];
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d corner = after.rest_vertices.row(after.tets(t, k));
      const double height = plane.normal.dot(corner - plane.point);
      reach.above = std::max(reach.above, height);
      reach.below = std::max(reach.below, -height);
      const Eigen::Vector3d next = after.rest_vertices.row(after.tets(t, (k + 1) % 4));
      reach.longest_edge = std::max(reach.longest_edge, (next - corner).norm());
    }
  }
  return std::all_of(pieces.begin(), pieces.end(), [](const auto& piece) {
    return std::min(piece.second.above, piece.second.below) <= piece.second.longest_edge;
  });
}

void cutByPlane(const TetTopology& body, RandomCuts* cuts, Tally* tally) {
  const RandomCuts::Plane plane = cuts->plane();
  testing::CutTets history(body);
  const auto edit = history.cut(testing::planePatch(plane.point, plane.normal, 2.0 * cuts->size()), 1);
  if (!edit) {
    ++tally->missed;
    return;
  }
  expectSound(*edit, body, tally);
  ++(isParted(edit->topology, plane) ? tally->made : tally->refused);
}

void cutBySweep(const TetTopology& body, RandomCuts* cuts, Tally* tally) {
  testing::CutTets history(body);
  bool any = false;
  for (const CutPatch& patch : cuts->sweep(5)) {
    const TetTopology before = history.topology();
    const auto edit = history.cut(patch, 1);
    if (!edit) continue;
    expectSound(*edit, before, tally);
    any = true;
  }
  ++(any ? tally->made : tally->missed);
}

void cutRepeatedly(const TetTopology& body, RandomCuts* cuts, Tally* tally) {
  testing::CutTets history(body);
  for (std::uint32_t stroke = 0; stroke < 5; ++stroke) {
    const TetTopology before = history.topology();
    const auto edit = history.cut(cuts->planeCut(), stroke);
    if (edit) expectSound(*edit, before, tally);
    ++(edit ? tally->made : tally->missed);
  }
}

/// Ten rounds of five planes and one sweep, and one round of five cuts in sequence.
void cutAtRandom(const TetTopology& body, const std::string& name) {
  RandomCuts cuts(body, 20221121);
  Tally tally;
  const auto total = [&tally] { return tally.made + tally.missed + tally.refused; };
  for (int turn = 0; total() < cutsPerBody(); ++turn) {
    if (turn % 15 == 14) {
      cutRepeatedly(body, &cuts, &tally);
    } else if (turn % 3 == 2) {
      cutBySweep(body, &cuts, &tally);
    } else {
      cutByPlane(body, &cuts, &tally);
    }
    ASSERT_FALSE(::testing::Test::HasFailure()) << name << ", turn " << turn;
  }
  std::cout << name << ": " << body.tets.rows() << " tets, " << total() << " cuts, " << tally.missed
            << " missed or only grazed the body, " << tally.refused
            << " planes did not part it, worst quality " << tally.worst_quality << ", worst change of volume "
            << tally.worst_volume << '\n';
  EXPECT_LE(tally.refused, 0.01 * total() + 0.5);
  EXPECT_GT(tally.made, total() / 2);
}

TEST(RandomCuts, Sponge) { cutAtRandom(testing::sponge(), "sponge"); }

TEST(RandomCuts, Torus) { cutAtRandom(testing::torusVolume(), "torus"); }

TEST(RandomCuts, DISABLED_Toy) {
  Warnings warnings;
  const TetMesh mesh = readTetFile(test::sharedData("toys/toy_tets.vtu"), &warnings);
  cutAtRandom(testing::topologyOf(mesh), "toy");
}

TEST(RandomCuts, Spot) {
  Warnings warnings;
  const TriangleMesh spot = readSurfaceFile(test::testData("spot.obj"), &warnings).mesh;
  const TriangleMesh sized{0.1 * spot.vertices, spot.triangles};
  cutAtRandom(testing::topologyOf(volumeAround(sized, 400)), "spot");
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cage/volume_maker.h"
#include "cutting/fixtures/cut_visual_body.h"
#include "cutting/fixtures/surface_meshes.h"
#include "fixtures/model_files.h"
#include "softbody_sim/io/tet_files.h"

namespace softbody {
namespace {

using testing::CutBody;

std::uint32_t pieceCountOf(const std::vector<std::uint32_t>& pieces) {
  return *std::max_element(pieces.begin(), pieces.end()) + 1;
}

/// Per piece of the mesh, the pieces of tets that its vertices are bound to.
std::map<std::uint32_t, std::set<std::uint32_t>> followed(const CutBody& body) {
  const VisualSurface& surface = body.surface();
  const MeshTopology& mesh = surface.topology();
  std::map<std::uint32_t, std::set<std::uint32_t>> pieces;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (const int v : mesh.triangles.row(t)) {
      const int tet = surface.binding().places()[static_cast<std::size_t>(v)].tet;
      pieces[mesh.triangle_pieces[static_cast<std::size_t>(t)]].insert(
          body.tets().tet_pieces[static_cast<std::size_t>(tet)]);
    }
  }
  return pieces;
}

Eigen::Vector3d middleOf(const MeshTopology& mesh, std::uint32_t piece) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (mesh.triangle_pieces[static_cast<std::size_t>(t)] != piece) continue;
    for (const int v : mesh.triangles.row(t)) sum += mesh.rest_vertices.row(v).transpose();
    count += 3.0;
  }
  return sum / count;
}

bool isBetween(const CutPatch& plane, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d p = plane.vertices.row(0), q = plane.vertices.row(1), r = plane.vertices.row(2);
  const Eigen::Vector3d normal = (q - p).cross(r - p);
  return normal.dot(a - p) * normal.dot(b - p) < 0.0;
}

/// Pairs of pieces of the mesh, each larger than 1 % of the body, that are bound to the same piece of tets.
struct Tied {
  int side_by_side = 0;  ///< on the same side of every cut: limbs connected by the cage
  int across = 0;        ///< separated by a cut that did not separate the tets
};

Tied tiedPieces(const CutBody& body, const std::vector<CutPatch>& planes) {
  const MeshTopology& mesh = body.surface().topology();
  std::map<std::uint32_t, double> volumes = testing::pieceVolumes(mesh);
  const double least = 0.01 * testing::volumeOf(mesh);
  std::map<std::uint32_t, std::vector<Eigen::Vector3d>>
      middles;  // centres of the large pieces, by their piece of tets
  for (const auto& [piece, tet_pieces] : followed(body)) {
    if (volumes[piece] > least) middles[*tet_pieces.begin()].push_back(middleOf(mesh, piece));
  }
  Tied tied;
  for (const auto& [tet_piece, places] : middles) {
    for (auto a = places.begin(); a != places.end(); ++a) {
      for (auto b = std::next(a); b != places.end(); ++b) {
        const bool across = std::any_of(planes.begin(), planes.end(),
                                        [&](const CutPatch& plane) { return isBetween(plane, *a, *b); });
        ++(across ? tied.across : tied.side_by_side);
      }
    }
  }
  return tied;
}

struct Tally {
  int made = 0, missed = 0, differ = 0, tied = 0;
};

/// @param planes of the cuts made so far; this one is added.
void cutBoth(const CutPatch& patch, std::uint32_t stroke, CutBody* body, std::vector<CutPatch>* planes,
             Tally* tally) {
  const Points shown = body->shown();
  const MeshTopology before = body->surface().topology();
  if (!body->cut(patch, stroke)) {
    if (body->surface().topology().revision > before.revision) body->apply(CutKind::kUndo);
    ++tally->missed;
    return;
  }
  ++tally->made;
  const MeshTopology& mesh = body->surface().topology();
  EXPECT_EQ(testing::faultOf(mesh, testing::volumeOf(before)), "");
  EXPECT_LT(testing::worstJump(shown, before, body->shown(), mesh), 1e-9);
  EXPECT_LT((body->atRest() - mesh.rest_vertices).cwiseAbs().maxCoeff(), 1e-7);
  for (const auto& [piece, tet_pieces] : followed(*body)) EXPECT_EQ(tet_pieces.size(), 1u);
  tally->differ += pieceCountOf(body->tets().tet_pieces) != pieceCountOf(mesh.triangle_pieces);
  planes->push_back(patch);
  const Tied tied = tiedPieces(*body, *planes);
  EXPECT_EQ(tied.across, 0);
  tally->tied += tied.side_by_side > 0;
}

/// Cuts tets and mesh together, by one to three planes through the body in sequence.
void cutBothAtRandom(const TetTopology& tets, const MeshTopology& mesh, unsigned seed) {
  const char* many = std::getenv("SOFTBODY_CUTS_PER_BODY");
  const int count = many != nullptr ? std::atoi(many) / 5 : 20;
  testing::RandomCuts cuts(tets, seed);
  CutBody body(tets, mesh);
  Tally tally;
  for (int k = 0; k < count; ++k) {
    std::vector<CutPatch> planes;
    for (int repeat = 0; repeat <= k % 3; ++repeat) {
      SCOPED_TRACE("cut " + std::to_string(k) + ", " + std::to_string(repeat));
      cutBoth(cuts.planeCut(), static_cast<std::uint32_t>(repeat), &body, &planes, &tally);
    }
    body.apply(CutKind::kReset);
    body.vertices = testing::deformed(tets.rest_vertices);
  }
  std::cout << tally.made << " cuts of tets and mesh, " << tally.missed << " missed or refused; after "
            << tally.differ << " different numbers of pieces, after " << tally.tied
            << " large pieces side by side that the cage ties together\n";
  EXPECT_GT(tally.made, count / 2);
  EXPECT_LE(tally.tied, tally.made / 10);
}

TEST(RandomSurfaceCuts, Sponge) { cutBothAtRandom(testing::sponge(), testing::visualSponge(), 1); }

TEST(RandomSurfaceCuts, Torus) {
  const MeshTopology mesh = testing::torusSurface(48);
  cutBothAtRandom(testing::topologyOf(volumeAround({mesh.rest_vertices, mesh.triangles}, 300)), mesh, 2);
}

TEST(RandomSurfaceCuts, DISABLED_Toy) {
  Warnings warnings;
  const TetMesh tets = readTetFile(test::sharedData("toys/toy_tets.vtu"), &warnings);
  cutBothAtRandom(testing::topologyOf(tets), testing::loadMesh(test::sharedData("toys/toy_surface.obj")), 3);
}

TEST(RandomSurfaceCuts, Spot) {
  MeshTopology mesh = testing::loadMesh(test::testData("spot.obj"));
  mesh.rest_vertices *= 0.1;
  cutBothAtRandom(testing::topologyOf(volumeAround({mesh.rest_vertices, mesh.triangles}, 400)), mesh, 4);
}

}  // namespace
}  // namespace softbody

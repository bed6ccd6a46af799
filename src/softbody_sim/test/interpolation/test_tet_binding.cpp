#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"
#include "softbody_sim/interpolation/tet_binding.h"

namespace softbody {
namespace {

constexpr double kMissing = 1e-3;  // distance of the points from their uncorrected positions [m]

/// A point in the middle of every tet, corrected by a random millimetre in a deformed state.
struct Bound {
  explicit Bound(const Points& met, const TetTopology& of = testing::sponge())
      : volume(of), plain(volume, middles(volume)), corrected(plain), vertices(met) {
    std::mt19937 random(3);
    positions = applyBinding(plain.places(), met, volume.tets);
    positions += testing::randomPoints(positions.rows(), kMissing, &random);
    corrected.correctTo(met, positions);
  }

  static std::vector<MaterialPoint> middles(const TetTopology& volume) {
    std::vector<MaterialPoint> places;
    for (int t = 0; t < static_cast<int>(volume.tets.rows()); ++t)
      places.push_back({t, Eigen::Vector4d::Constant(0.25)});
    return places;
  }

  Points shown(const TetBinding& binding, const Points& x) const {
    MeshState state{0, {}, x, std::vector<float>(static_cast<std::size_t>(x.rows()), 1.0f)}, result;
    std::vector<int> all(binding.places().size());
    std::iota(all.begin(), all.end(), 0);
    result.vertices.resize(static_cast<Eigen::Index>(all.size()), 3);
    result.confidence.resize(all.size());
    binding.apply(state, all, &result);
    return result.vertices;
  }
  double worstCorrection(const Points& x) const {
    return (shown(corrected, x) - shown(plain, x)).rowwise().norm().maxCoeff();
  }

  TetTopology volume;
  TetBinding plain, corrected;
  Points vertices, positions;
};

/// The bent sponge, with one tet flattened to `height` times its height.
Points withFlatTet(int tet, double height) {
  const TetTopology sponge = testing::sponge();
  Points x = sponge.rest_vertices;
  x.col(2) += 2.0 * x.col(0).cwiseAbs2();
  const Eigen::RowVector4i corners = sponge.tets.row(tet);
  const Eigen::RowVector3d foot = (x.row(corners[1]) + x.row(corners[2]) + x.row(corners[3])) / 3.0;
  x.row(corners[0]) = foot + height * (x.row(corners[0]) - foot);
  return x;
}

TEST(TetBinding, MeetsPositionsAndIsExactAtRest) {
  const Bound bound(withFlatTet(7, 1.0));
  EXPECT_LT((bound.shown(bound.corrected, bound.vertices) - bound.positions).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(bound.worstCorrection(bound.volume.rest_vertices), 1e-12);
}

TEST(TetBinding, AFlatTetDoesNotMagnifyItsCorrection) {
  for (const int tet : {7, 100, 151, 299}) {
    for (const double height : {1e-2, 1e-5, 1e-9, 0.0}) {
      const Bound bound(withFlatTet(tet, height));
      EXPECT_LT((bound.shown(bound.corrected, bound.vertices) - bound.positions).cwiseAbs().maxCoeff(), 1e-9)
          << tet << ", " << height;
      for (const double later : {0.5, 1.0, -0.3}) {
        EXPECT_LT(bound.worstCorrection(withFlatTet(tet, later)), 20.0 * kMissing) << tet << ", " << height;
      }
    }
  }
}

/// As after a cut while another part of the body, now another piece, was deformed.
TEST(TetBinding, AnOffsetWithoutAStrainDoesNotStay) {
  Points almost_rest = testing::sponge().rest_vertices;
  almost_rest(5, 2) += 1e-8;
  const Bound bound(almost_rest);
  EXPECT_LT(bound.worstCorrection(almost_rest), 0.01 * kMissing);
}

/// The sponge, with one more tet of almost no height on a vertex of its own, as cuts leave them.
TetTopology withSliver(double height) {
  TetTopology volume = testing::sponge();
  const int tip = static_cast<int>(volume.rest_vertices.rows());
  const Eigen::RowVector4i tet = volume.tets.row(7);
  const Eigen::RowVector3d a = volume.rest_vertices.row(tet[1]), b = volume.rest_vertices.row(tet[2]),
                           c = volume.rest_vertices.row(tet[3]);
  volume.rest_vertices.conservativeResize(tip + 1, 3);
  volume.rest_vertices.row(tip) = (a + b + c) / 3.0 + height * (b - a).cross(c - a).normalized();
  volume.tets.conservativeResize(volume.tets.rows() + 1, 4);
  volume.tets.bottomRows(1) << tip, tet[1], tet[2], tet[3];
  volume.vertex_parents.push_back(tip);
  volume.tet_pieces.push_back(volume.tet_pieces[7]);
  return volume;
}

TEST(TetBinding, ASliverDoesNotKeepTheCorrectionAtRest) {
  for (const double height : {1e-9, 1e-12, 0.0}) {
    const TetTopology volume = withSliver(height);
    Points bent = volume.rest_vertices;
    bent.col(2) += 2.0 * bent.col(0).cwiseAbs2();
    const Bound bound(bent, volume);
    const Points rounded = volume.rest_vertices.cast<float>().cast<double>();
    EXPECT_LT(bound.worstCorrection(rounded), 0.01 * kMissing) << height;
  }
}

}  // namespace
}  // namespace softbody

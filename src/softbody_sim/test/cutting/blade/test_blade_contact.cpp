#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "cutting/fixtures/surface_meshes.h"
#include "cutting/fixtures/visual_sponge.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"

namespace softbody {
namespace {

constexpr double kLength = 0.2;  // of a prism [m]

/// A prism along x around the origin. Its section is a regular polygon with an even number of sides.
MeshTopology prism(int sides, double half_width) {
  constexpr int kRings = 11;
  const double radius = half_width / std::cos(M_PI / sides);
  const int ends = kRings * sides;  // the centres of both ends come after the rings
  TriangleMesh mesh{Points(ends + 2, 3), Triangles(2 * ends, 3)};
  mesh.vertices.row(ends) << -0.5 * kLength, 0.0, 0.0;
  mesh.vertices.row(ends + 1) << 0.5 * kLength, 0.0, 0.0;
  Eigen::Index t = 0;
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    const double angle = (2 * k + 1) * M_PI / sides;
    for (int i = 0; i < kRings; ++i) {
      const int ring = i * sides;
      mesh.vertices.row(ring + k) << (i / (kRings - 1.0) - 0.5) * kLength, radius * std::cos(angle),
          radius * std::sin(angle);
      if (i + 1 == kRings) continue;
      mesh.triangles.row(t++) << ring + k, ring + next, ring + sides + k;
      mesh.triangles.row(t++) << ring + next, ring + sides + next, ring + sides + k;
    }
    mesh.triangles.row(t++) << ends, next, k;
    mesh.triangles.row(t++) << ends + 1, ends - sides + k, ends - sides + next;
  }
  return testing::meshTopology({inSinglePrecision(mesh.vertices), mesh.triangles});
}

/// The tets of a prism: a slightly larger box.
TetTopology boxRound(double half_width) {
  const int cells = std::max(1, static_cast<int>(half_width / 0.01));
  const double width = 2.04 * half_width, length = 1.02 * kLength;
  TetTopology box = testing::boxTopology({8, cells, cells}, {length, width, width});
  box.rest_vertices.rowwise() -= 0.5 * Eigen::RowVector3d(length, width, width);
  return box;
}

/// A body at rest under a blade 150 mm long and 40 mm high, in the plane x = 0, its edge at z = 0 along y.
struct Body {
  Body(const MeshTopology& mesh, const TetTopology& tets) : surface(mesh, tets) {}

  std::size_t move(const Eigen::Isometry3d& T_rest_blade) {
    Points blade(4, 3);
    blade << 0.0, -0.075, 0.0, 0.0, 0.075, 0.0, 0.0, 0.075, 0.04, 0.0, -0.075, 0.04;
    return move(blade, T_rest_blade);
  }
  std::size_t move(const Points& blade, const Eigen::Isometry3d& T_rest_blade) {
    if (surface.follow(transformed(blade, T_rest_blade), state(), stamp += 33'000'000)) ++cuts;
    return cuts;
  }
  MeshState state() const {
    MeshState rest;
    rest.revision = surface.volume().revision;
    rest.vertices = surface.volume().rest_vertices;
    rest.confidence.assign(static_cast<std::size_t>(rest.vertices.rows()), 1.0f);
    return rest;
  }
  /// In steps of a millimetre.
  void go(Eigen::Isometry3d* pose, const Eigen::Vector3d& way, double step = 0.001) {
    const int steps = static_cast<int>(std::ceil(way.norm() / step));
    for (int k = 0; k < steps; ++k) move(*pose = Eigen::Translation3d(way / steps) * *pose);
  }
  /// Largest distance of the cut from the plane x = 0.
  double aside() const {
    const MeshTopology& mesh = surface.surface().topology();
    double most = 0.0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      if (!mesh.cut[static_cast<std::size_t>(t)]) continue;
      for (const int v : mesh.triangles.row(t)) most = std::max(most, std::abs(mesh.rest_vertices(v, 0)));
    }
    return most;
  }
  /// Extent of the cut along y.
  std::pair<double, double> span() const {
    const MeshTopology& mesh = surface.surface().topology();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      if (!mesh.cut[static_cast<std::size_t>(t)]) continue;
      for (const int v : mesh.triangles.row(t)) {
        low = std::min(low, mesh.rest_vertices(v, 1));
        high = std::max(high, mesh.rest_vertices(v, 1));
      }
    }
    return {low, high};
  }
  std::size_t pieces() const { return testing::pieceVolumes(surface.surface().topology()).size(); }

  CuttableBody surface;
  Nanoseconds stamp = 0;
  std::size_t cuts = 0;
};

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

Body limb() { return {prism(4, 0.006), boxRound(0.006)}; }
Body sponge() { return {testing::visualSponge(), testing::sponge()}; }

/// A cylinder whose upper side rises along x: a straight edge touches it between two samples.
Body risingBack(double slope) {
  MeshTopology mesh = prism(48, 0.04);
  TetTopology tets = boxRound(0.04);
  for (Points* points : {&mesh.rest_vertices, &tets.rest_vertices})
    *points = inSinglePrecision(
        *points * Eigen::AngleAxisd(-slope, Eigen::Vector3d::UnitY()).toRotationMatrix().transpose());
  return {mesh, tets};
}
/// Pose of a straight edge that rests on it at x, turned about the vertical.
double backHeight(double slope, double x, double turn = 0.0) {
  return x * std::tan(slope) + 0.04 * std::hypot(std::tan(slope) * std::tan(turn), 1.0 / std::cos(slope));
}

TEST(BladeContact, ABladeThatSlidesUpARoundBackCutsFromItsTop) {
  constexpr double kSlope = 0.5, kTouch = 0.0008;
  for (const double y : {-0.006, 0.0, 0.01}) {
    Body body = risingBack(kSlope);
    Eigen::Isometry3d pose = at(-0.01, y, backHeight(kSlope, -0.01) + 0.02 - kTouch);
    body.go(&pose, {0.0, 0.0, -0.02});
    body.go(&pose, {0.02, 0.0, 0.02 * std::tan(kSlope)});
    EXPECT_EQ(body.cuts, 0u);
    body.go(&pose, {0.0, 0.0, -0.11});
    EXPECT_EQ(body.pieces(), 2u) << "y " << y;
  }
}

TEST(BladeContact, ABladeTurnedOnABackCutsWhereItIsThen) {
  for (const double y : {-0.006, 0.0, 0.01}) {
    for (const double depth : {0.0008, 0.004}) {
      Body body = risingBack(0.0);
      const Eigen::Isometry3d touching = at(0.0, 0.0, backHeight(0.0, 0.0) - depth);
      for (int k = 20; k > 0; --k)
        body.move(at(0.0, 0.0, 0.001 * k) * touching * Eigen::AngleAxisd(-1.5, Eigen::Vector3d::UnitZ()) *
                  at(0.0, y, 0.0));
      for (int k = 30; k > 0; --k)
        body.move(touching * Eigen::AngleAxisd(-0.05 * k, Eigen::Vector3d::UnitZ()) * at(0.0, y, 0.0));
      Eigen::Isometry3d pose = touching * at(0.0, y, 0.0);
      body.go(&pose, {0.0, 0.0, -0.1});
      EXPECT_EQ(body.pieces(), 2u) << "y " << y << ", depth " << depth;
      EXPECT_LT(body.aside(), 1e-3) << "y " << y << ", depth " << depth;
    }
  }
}

/// Motion before the blade enters does not leave uncut material.
TEST(BladeContact, ABladeThatFumblesOnABackCutsThroughIt) {
  for (unsigned seed = 1; seed <= 26; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double most) {
      return std::uniform_real_distribution<double>(-most, most)(random);
    };
    constexpr double kSlope = 0.3;
    Body body = risingBack(kSlope);
    double x = uniform(0.02), y = uniform(0.02), turn = uniform(0.5);
    const auto touching = [&](double depth) -> Eigen::Isometry3d {
      return at(x, 0.0, backHeight(kSlope, x, turn) - depth) *
             Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * at(0.0, y, 0.0);
    };
    for (double height = 0.02; height > 0.0; height -= 0.001) body.move(touching(-height));
    for (int k = 0; k < 60; ++k) {
      x = std::clamp(x + uniform(0.003), -0.03, 0.03);
      y = std::clamp(y + uniform(0.003), -0.02, 0.02);
      turn = std::clamp(turn + uniform(0.1), -0.5, 0.5);
      body.move(touching(uniform(0.0015)));
    }
    for (double depth = 0.0; depth < 0.14; depth += 0.001) body.move(touching(depth));
    EXPECT_EQ(body.pieces(), 2u) << "seed " << seed;
  }
}

TEST(BladeContact, ABladeThatGoesInTipFirstCutsWithItsEdge) {
  for (const double end : {-0.075, 0.075}) {
    for (const double tilt : {0.1, 0.3, 0.5}) {
      Body body(prism(4, 0.04), boxRound(0.04));
      Eigen::Isometry3d pose = at(0.0, 0.0, 0.06) *
                               Eigen::AngleAxisd(std::copysign(tilt, -end), Eigen::Vector3d::UnitX()) *
                               at(0.0, -end, 0.0);
      body.go(&pose, {0.0, 0.0, -0.028});  // only the tip is in the body, 8 mm deep
      EXPECT_GT(body.cuts, 0u) << "end " << end << ", tilt " << tilt;
    }
  }
}

TEST(BladeContact, ALimbBetweenTwoSamplesIsCut) {
  for (const double y : {-0.03, -0.022, -0.014, -0.006, 0.0, 0.008, 0.016}) {
    for (const double step : {0.001, 0.005, 0.01}) {
      Body chopped = limb();
      Eigen::Isometry3d pose = at(0.0, y, 0.0205);
      chopped.go(&pose, {0.0, 0.0, -0.04}, step);
      EXPECT_EQ(chopped.pieces(), 2u) << "y " << y << ", steps of " << step;
    }
    for (const double depth : {0.003, 0.008}) {
      Body sawn = limb();
      Eigen::Isometry3d pose = at(0.0, y, 0.02);
      sawn.go(&pose, {0.0, 0.0, -0.014 - depth});
      for (const double way : {0.03, -0.03}) sawn.go(&pose, {0.0, way, 0.0});
      sawn.go(&pose, {0.0, 0.0, -0.02});
      EXPECT_EQ(sawn.pieces(), 2u) << "y " << y << ", sawn at " << depth;
    }
  }
}

TEST(BladeContact, ABladeThatRubsAlongAFlankCutsWhenItGoesIn) {
  const auto rub = [](double depth, double start, std::vector<double> ways) {
    Body body = sponge();  // its side is at y = 0.098
    Eigen::Isometry3d pose = at(0.083, 0.193 - depth, start);
    body.go(&pose, {0.0, -0.02, 0.0});
    for (const double way : ways) body.go(&pose, {0.0, 0.0, way});
    EXPECT_EQ(body.cuts, 0u) << "depth " << depth;
    body.go(&pose, {0.0, -0.12, 0.0});
    EXPECT_EQ(body.pieces(), 2u) << "depth " << depth;
  };
  rub(0.001, -0.02, {0.015});  // with a corner inside
  rub(0.003, -0.005, {0.015, -0.015});
}

TEST(BladeContact, ABladeInALimbDuringAnUndoHasToComeOutFirst) {
  for (const double y : {-0.03, -0.022, -0.014, -0.006, 0.0}) {
    Body body = limb();
    Eigen::Isometry3d pose = at(0.0, y, 0.02);
    body.go(&pose, {0.0, 0.0, -0.022});
    ASSERT_GT(body.cuts, 0u);
    std::string reason;
    ASSERT_TRUE(body.surface.apply(body.surface.edit(CutKind::kUndo), body.state(), &reason)) << reason;
    const std::size_t cuts = body.cuts;
    body.go(&pose, {0.0, 0.0, -0.005});
    EXPECT_EQ(body.cuts, cuts) << "y " << y;
    body.go(&pose, {0.0, 0.0, 0.03});
    body.go(&pose, {0.0, 0.0, -0.04});
    EXPECT_EQ(body.pieces(), 2u) << "y " << y;
  }
}

TEST(BladeContact, ABladeLiftedWhileItOnlyTouchesCutsOn) {
  for (const double tilt : {-0.4, -0.2, 0.2, 0.4}) {
    for (const double y : {-0.02, -0.01, -0.004, 0.0, 0.006, 0.012, 0.018}) {
      Body body = sponge();  // its upper edges are at y = 0.002 and 0.098, z = 0.0294
      const double corner = 0.0294 + (0.048 + std::copysign(y, tilt * y)) * std::tan(std::abs(tilt)) - 0.001;
      Eigen::Isometry3d pose = at(0.083, 0.05 + y, corner + 0.02) *
                               Eigen::Isometry3d(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()));
      body.go(&pose, {0.0, 0.0, -0.02});
      body.stamp += 1'000'000'000;  // lifted
      body.move(pose);
      body.go(&pose, {0.0, 0.0, -0.09});
      EXPECT_EQ(body.pieces(), 2u) << "tilt " << tilt << ", y " << y;
    }
  }
}

/// A triangle with its tip at the origin, 80 mm high, in the plane x = 0. @param slope half width over
/// height.
Points pointedBlade(double slope) {
  constexpr double kHeight = 0.08;
  const double half_width = kHeight * slope;
  Points blade(3, 3);
  blade << 0.0, 0.0, 0.0, 0.0, half_width, kHeight, 0.0, -half_width, kHeight;
  return blade;
}

TEST(BladeContact, APointedBladeCutsAsWideAsItIs) {
  constexpr double kTop = 0.0294, kLow = 0.002, kHigh = 0.098;  // the sponge's faces
  constexpr double kDeepest = 0.05, kBehind = 0.0051;  // the cut is less than an advance behind the blade
  for (double degrees = 30.0; degrees <= 120.0; degrees += 15.0) {
    for (const double y : {0.05, 0.053}) {
      Body body = sponge();
      const double slope = std::tan(0.5 * degrees * M_PI / 180.0);
      double first = 0.0;
      for (int step = -20; step <= 50; ++step) {
        const double depth = 0.001 * step;
        if (body.move(pointedBlade(slope), at(0.103, y, kTop - depth)) == 1 && first == 0.0) first = depth;
      }
      const auto [low, high] = body.span();
      const double widest = kDeepest * slope, narrowest = (kDeepest - kBehind) * slope;
      EXPECT_GT(low, std::max(kLow, y - widest) - 1e-4) << degrees << " degrees, y " << y;
      EXPECT_LT(low, std::max(kLow, y - narrowest) + 1e-4) << degrees << " degrees, y " << y;
      EXPECT_GT(high, std::min(kHigh, y + narrowest) - 1e-4) << degrees << " degrees, y " << y;
      EXPECT_LT(high, std::min(kHigh, y + widest) + 1e-4) << degrees << " degrees, y " << y;
      EXPECT_LT(first, 0.0085) << degrees << " degrees, y " << y;
    }
  }
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

#include <cmath>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/statistics/random.h"
#include "softbody_scanning/registration/surface_registration.h"
#include "softbody_scanning/surface/remeshing.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::scanning {
namespace {

const Eigen::Isometry3d kTurn(Eigen::Translation3d(0.02, -0.01, 0.03) *
                              Eigen::AngleAxisd(2.5, Eigen::Vector3d(1.0, 0.4, -0.3).normalized()));

/// A block that looks the same after half a turn about each axis.
TriangleMesh brick() { return remeshed(virtual_camera::box({0.08, 0.06, 0.03}), 4e-3); }

/// Waves of 15 mm, about 0..255. Each seed is another pattern.
Points pattern(const Points& places, std::uint64_t seed) {
  Points colors(places.rows(), 3);
  for (Eigen::Index v = 0; v < places.rows(); ++v)
    for (int k = 0; k < 3; ++k) {
      double sum = 0.0;
      for (int wave = 0; wave < 4; ++wave) {
        const auto any = [&](int i) { return unit(hash(seed, 100 * k + 10 * wave + i)); };
        const Eigen::RowVector3d direction(any(0) - 0.5, any(1) - 0.5, any(2) - 0.5);
        sum += std::sin(2.0 * M_PI * (places.row(v).dot(direction.normalized()) / 0.015 + any(3)));
      }
      colors(v, k) = 128.0 + 30.0 * sum;
    }
  return colors;
}

/// The brick, laid on itself after a turn, up to 0.3 mm wrong. @param before,after its colours.
Registration lie(const TriangleMesh& mesh, const Points& before, const Points& after) {
  TriangleMesh turned = mesh;
  turned.vertices = transformed(mesh.vertices, kTurn);
  for (Eigen::Index i = 0; i < turned.vertices.size(); ++i)
    turned.vertices(i) += 0.6e-3 * (unit(hash(3, static_cast<std::uint64_t>(i))) - 0.5);
  return registerSurfaces({turned, {}, after}, {mesh, {}, before});
}

TEST(AmbiguousTurn, colorsDecideWhereTheShapeDoesNot) {
  const TriangleMesh mesh = brick();
  const Points colors = pattern(mesh.vertices, 1);
  const Points later = colors + 1.5 * pattern(mesh.vertices, 2);  // shadows, highlights, noise
  const Registration found = lie(mesh, colors, later);
  EXPECT_LT(Eigen::AngleAxisd((found.T_fixed_moving * kTurn).linear()).angle(), 0.01);
  ASSERT_LT(found.runner_up, 2.0 * found.misfit);  // the misfit alone does not decide
  EXPECT_FALSE(found.ambiguous) << found.misfit << " " << found.runner_up;
}

TEST(AmbiguousTurn, nothingDecidesWithoutColorsOrWithOthers) {
  const TriangleMesh mesh = brick();
  EXPECT_TRUE(lie(mesh, {}, {}).ambiguous);
  EXPECT_TRUE(lie(mesh, pattern(mesh.vertices, 1), pattern(mesh.vertices, 2)).ambiguous);
}

}  // namespace
}  // namespace softbody::scanning

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "elasticity/elastic_blocks.h"
#include "fixtures/test_meshes.h"
#include "linear_solvers/global_step_solver.h"
#include "linear_solvers/positive_definite_solver.h"
#include "tets/tet_matrix.h"
#include "tets/tet_shape.h"
#include "time_step/packed_potential.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::randomPoints;

const Lame kLame{8000.0, 5000.0};

/// All vector instructions of this processor.
std::vector<Simd> widths() {
  std::vector<Simd> found;
  for (Simd simd : {Simd::kSse4, Simd::kAvx2, Simd::kAvx512}) {
    try {
      found.push_back(supportedSimd(simd));
    } catch (const std::invalid_argument&) {
    }
  }
  return found;
}

template <typename T>
class VectorKernels : public ::testing::Test {
 protected:
  static constexpr double kRounding = sizeof(T) == 4 ? 1e-5 : 1e-13;
  TetTopology topology_ = boxTopology({5, 3, 2}, {0.1, 0.06, 0.05});
  Eigen::Index count_ = topology_.rest_vertices.rows();
  std::mt19937 random_{11};

  Rows<T> toRows(const Points& points) const {
    Rows<T> rows = Rows<T>::Zero(paddedRows(points.rows()), 4);
    rows.topLeftCorner(points.rows(), 3) = points.cast<T>();
    return rows;
  }
  /// The points as rounded in the rows.
  Points toPoints(const Rows<T>& rows) const { return rows.topLeftCorner(count_, 3).template cast<double>(); }

  void expectElasticityMatches(const Points& x, const std::string& what) {
    for (double smoothing : {0.0, 0.7}) expectElasticityMatches(x, smoothing, what);
  }
  void expectElasticityMatches(const Points& x, double smoothing, const std::string& what) {
    const CorotatedElasticity reference(topology_.rest_vertices, topology_.tets, kLame, smoothing);
    const Rows<T> rows = toRows(x);
    Points expected = Points::Zero(count_, 3);
    const double energy = reference.addTo(toPoints(rows), &expected);
    // Forces at a strain of 1 give the scale of rounding errors.
    const double scale = kLame.mu * 0.02 * 0.02 + expected.cwiseAbs().maxCoeff();
    for (Simd simd : widths()) {
      ElasticBlocks<T> blocks(topology_.rest_vertices, reference, simd);
      Rows<T> gradient = Rows<T>::Zero(rows.rows(), 4);
      const double found = blocks.addTo(rows, &gradient);
      EXPECT_NEAR(found, energy, kRounding * (energy + kLame.mu * 1e-6))
          << what << ", smoothing " << smoothing << ", " << nameOf(simd);
      EXPECT_LT((toPoints(gradient) - expected).cwiseAbs().maxCoeff(), kRounding * scale)
          << what << ", smoothing " << smoothing << ", " << nameOf(simd);
      EXPECT_EQ(gradient.col(3).cwiseAbs().maxCoeff(), T{0});
      EXPECT_EQ(gradient.bottomRows(gradient.rows() - count_).cwiseAbs().sum(), T{0}) << "may be no rows";
    }
  }
};

using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(VectorKernels, Precisions);

TYPED_TEST(VectorKernels, ElasticityIsThatOfTheScalarCodeOnEveryWidth) {
  const Points& rest = this->topology_.rest_vertices;
  for (double disorder : {0.0, 1e-4, 2e-3, 8e-3}) {
    const Points x = rest + randomPoints(this->count_, disorder, &this->random_);
    this->expectElasticityMatches(x, fmt::format("disorder {}", disorder));
    this->expectElasticityMatches(transformed(x, testing::somePose()), fmt::format("turned, {}", disorder));
  }
  this->expectElasticityMatches(rest * Eigen::Vector3d(1.7, 0.5, 0.8).asDiagonal(), "stretched");
}

TYPED_TEST(VectorKernels, ElasticityIsThatOfTheScalarCodeForAnyNumberOfUnusedLanes) {
  for (int cells : {1, 3, 6, 9, 11}) {  // one to five blocks
    this->topology_ = boxTopology({cells, 1, 1}, {0.02 * cells, 0.02, 0.02});
    this->count_ = this->topology_.rest_vertices.rows();
    this->expectElasticityMatches(
        this->topology_.rest_vertices + randomPoints(this->count_, 2e-3, &this->random_),
        fmt::format("{} cells", cells));
  }
}

/// If the rotation is not unique, only the energy can be compared.
TYPED_TEST(VectorKernels, ElasticityOfDegenerateAndInvertedTetsHasTheScalarCodesEnergy) {
  constexpr double kSmoothing = 0.7;
  const CorotatedElasticity reference(this->topology_.rest_vertices, this->topology_.tets, kLame, kSmoothing);
  const Points& rest = this->topology_.rest_vertices;
  for (const Eigen::Vector3d& scale :
       {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 0),
        Eigen::Vector3d(1, 1, -1), Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, -0.3)}) {
    const auto rows = this->toRows(rest * scale.asDiagonal());
    Points unused = Points::Zero(this->count_, 3);
    const double energy = reference.addTo(this->toPoints(rows), &unused);
    for (Simd simd : widths()) {
      ElasticBlocks<TypeParam> blocks(rest, reference, simd);
      Rows<TypeParam> gradient = Rows<TypeParam>::Zero(rows.rows(), 4);
      EXPECT_NEAR(blocks.addTo(rows, &gradient), energy, 10.0 * this->kRounding * energy)
          << scale.transpose() << ", " << nameOf(simd);
      EXPECT_TRUE(gradient.allFinite());
    }
  }
}

/// Standard errors of the energy [J] and of the whole gradient [N] if every number has a relative rounding
/// error `unit`: to first order, for independent errors.
struct Rounding {
  double unit;
  double energy = 0.0, gradient = 0.0;

  /// Adds the errors of one F, a sum of products with the total magnitude `products`. Forces are stress times
  /// `lever`. Energy and stress follow from F by a closed form of about ten numbers near 1.
  void add(double volume, const Eigen::Matrix3d& F, double products, double lever) {
    constexpr double kClosedForm = 10.0;
    Eigen::Matrix3d stress;
    corotatedEnergy(F, kLame, &stress);
    const double error = unit * (products + kClosedForm), stiffness = 2.0 * kLame.mu + 3.0 * kLame.lambda;
    energy = std::hypot(energy, volume * stress.norm() * error);
    gradient = std::hypot(gradient, volume * stiffness * error * lever);
  }
};

void addTets(const CorotatedElasticity& elasticity, const Points& rest, const Points& x, Rounding* rounding) {
  for (Eigen::Index t = 0; t < elasticity.tets().rows(); ++t) {
    const Eigen::RowVector4i tet = elasticity.tets().row(t);
    const Eigen::Matrix3d edges = edgesOf(x, tet), inverse = edgesOf(rest, tet).inverse();
    rounding->add(elasticity.tetLame(t).mu / kLame.mu * elasticity.volumes()[t], edges * inverse,
                  edges.colwise().norm() * inverse.rowwise().norm(), shapeGradients(inverse).norm());
  }
}

void addPatches(const CorotatedElasticity& elasticity, const Points& x, Rounding* rounding) {
  const SmoothedGradients& smoothed = elasticity.smoothed();
  for (Eigen::Index v = 0; v < smoothed.volumes.size(); ++v) {
    const int first = smoothed.first[v], count = smoothed.first[v + 1] - first;
    const Eigen::MatrixX3d gradients = smoothed.gradients.middleRows(first, count);
    Eigen::MatrixX3d points(count, 3);
    for (int e = 0; e < count; ++e) points.row(e) = x.row(smoothed.vertices[first + e]);
    rounding->add(elasticity.patchLame(v).mu / kLame.mu * smoothed.volumes[v], points.transpose() * gradients,
                  points.rowwise().norm().dot(gradients.rowwise().norm()), gradients.norm());
  }
}

/// A bent box with irregular vertices, so that rounding errors do not repeat.
struct LargeBody {
  TetTopology topology;
  Points x;
};

LargeBody largeBody(const Eigen::Vector3i& cells, std::mt19937* random) {
  LargeBody body{boxTopology(cells, {0.2, 0.1, 0.1}), {}};
  Points& rest = body.topology.rest_vertices;
  rest += randomPoints(rest.rows(), 1e-3, random);
  body.x = rest + randomPoints(rest.rows(), 5e-4, random);
  for (auto v : body.x.rowwise()) v.z() += 3.0 * (v.x() - 0.1) * (v.x() - 0.1);
  return body;
}

/// 1,080 and 10,368 tets: long sums, and positions many edge lengths away from the origin.
TYPED_TEST(VectorKernels, ElasticityOfLargeBodiesIsThatOfTheScalarCodeWithinRounding) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  for (const Eigen::Vector3i& cells : {Eigen::Vector3i(6, 6, 5), Eigen::Vector3i(12, 12, 12)}) {
    const LargeBody body = largeBody(cells, &this->random_);
    const Points& rest = body.topology.rest_vertices;
    const auto rows = this->toRows(body.x);
    this->count_ = rest.rows();
    for (double smoothing : {0.0, 0.7}) {
      const CorotatedElasticity reference(rest, body.topology.tets, kLame, smoothing);
      Points expected = Points::Zero(rest.rows(), 3);
      const double energy = reference.addTo(this->toPoints(rows), &expected);
      Rounding rounding{0.5 * std::numeric_limits<TypeParam>::epsilon()};
      addTets(reference, rest, body.x, &rounding);
      addPatches(reference, body.x, &rounding);
      const double sum = kEpsilon * energy * std::sqrt(static_cast<double>(body.topology.tets.rows()));
      for (Simd simd : widths()) {
        SCOPED_TRACE(
            fmt::format("{} tets, smoothing {}, {}", body.topology.tets.rows(), smoothing, nameOf(simd)));
        ElasticBlocks<TypeParam> blocks(rest, reference, simd);
        auto gradient = this->toRows(Points::Zero(rest.rows(), 3));
        EXPECT_NEAR(blocks.addTo(rows, &gradient), energy, std::hypot(rounding.energy, sum));
        EXPECT_LT((this->toPoints(gradient) - expected).norm(), rounding.gradient);
      }
    }
  }
}

TYPED_TEST(VectorKernels, IncrementalPotentialIsThatOfTheScalarCodeOnEveryWidth) {
  IncrementalPotential potential;
  potential.inertia = Eigen::VectorXd::LinSpaced(this->count_, 1.0, 9.0);
  potential.prediction = this->topology_.rest_vertices + randomPoints(this->count_, 0.01, &this->random_);
  potential.loads = randomPoints(this->count_, 0.1, &this->random_);
  std::vector<Target> targets =
      testing::vertexTargets(this->topology_, randomPoints(this->count_, 0.1, &this->random_));
  for (std::size_t i = 0; i < targets.size(); ++i) {
    targets[i].place.barycentric = Eigen::Vector4d(0.7, 0.4, -0.3, 0.2);
    if (i % 2 == 0) targets[i].normal = randomPoints(1, 1.0, &this->random_).transpose().normalized();
  }
  potential.targets.set(targets, this->topology_.tets, 300.0);
  const Eigen::RowVector3d origin(0.1, -0.2, 0.5);
  const Points x = this->topology_.rest_vertices + randomPoints(this->count_, 0.01, &this->random_);
  Points expected(this->count_, 3);
  const double energy = potential.evaluate(x, &expected);
  for (Simd simd : widths()) {
    PackedPotential<TypeParam> step(this->count_, simd);
    step.set(potential, origin);
    Rows<TypeParam> rows = this->toRows(Points::Zero(this->count_, 3)), gradient = rows;
    step.toRows(x, &rows);
    EXPECT_NEAR(step.evaluate(rows, &gradient), energy, this->kRounding * energy) << nameOf(simd);
    EXPECT_LT((this->toPoints(gradient) - expected).norm(), this->kRounding * expected.norm())
        << nameOf(simd);
    Points back(this->count_, 3);
    step.fromRows(rows, &back);
    EXPECT_LT((back - x).cwiseAbs().maxCoeff(), this->kRounding);
  }
}

TYPED_TEST(VectorKernels, GlobalStepInvertsItsMatrixBeforeAndAfterItIsMadeDense) {
  TetMatrix matrix(this->topology_.tets, this->count_);
  CorotatedElasticity(this->topology_.rest_vertices, this->topology_.tets, kLame).addMetric(&matrix);
  matrix.addToDiagonal(Eigen::VectorXd::Constant(this->count_, 50.0));
  for (Simd simd : widths()) {
    GlobalStepSolver<TypeParam> solver(matrix.lower(), simd);
    for (int factorization = 0; factorization < 2; ++factorization) {
      solver.factorize(matrix.lower());
      for (Eigen::Index solve = 0; solve < this->count_; ++solve) {
        const Rows<TypeParam> B = this->toRows(randomPoints(this->count_, 1.0, &this->random_));
        Rows<TypeParam> X = B;
        solver.solve(B, &X);
        const Points product = matrix.lower().template selfadjointView<Eigen::Lower>() * this->toPoints(X);
        EXPECT_LT((product - this->toPoints(B)).norm(), 10.0 * this->kRounding * this->toPoints(B).norm())
            << nameOf(simd) << ", solve " << solve;
      }
    }
  }
}

TEST(SimdWidth, HasNamesThatAreReadBack) {
  for (Simd simd : {Simd::kAuto, Simd::kSse4, Simd::kAvx2, Simd::kAvx512})
    EXPECT_EQ(simdFromName(nameOf(simd)), simd);
  EXPECT_THROW(simdFromName("avx"), std::invalid_argument);
}

}  // namespace
}  // namespace softbody

#include "estimation/standard_deviation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimation/load_estimator.h"
#include "fem/fem_elasticity.h"
#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

/// A body whose loads are estimated from one frame.
class EstimatedBody {
 public:
  explicit EstimatedBody(const TetTopology& topology)
      : topology_(topology), masses_(Eigen::VectorXd::Constant(topology.rest_vertices.rows(), 1e-4)) {}

  std::vector<float> deviations(const std::vector<Target>& targets, const Points& vertices,
                                const std::vector<Pin>& pins = {}) {
    LoadEstimate loads{Points::Zero(vertices.rows(), 3)};
    Points balancing = Points::Zero(vertices.rows(), 3);
    elasticity_.addTo(vertices, &balancing);
    const auto posterior = estimator_.update(targets, pins, vertices, balancing, 1.0 / 30.0, &loads);
    std::vector<float> result;
    standardDeviations(targets, topology_.tets, vertices, posterior.value(), &result);
    return result;
  }

 private:
  const TetTopology topology_;
  const Eigen::VectorXd masses_;
  const TetMaterials materials_ = tetMaterials(topology_, Material(), 0.7, std::nullopt);
  const FemElasticity elasticity_{topology_, Elasticity::kCorotated, materials_.elastic};
  LoadEstimator estimator_{topology_, materials_, masses_, {0.1, 4000.0}};
};

class StandardDeviationTest : public ::testing::Test {
 protected:
  /// Targets on the vertices at one end of the sponge (x below 30 mm), where they are.
  std::vector<Target> targetsAtOneEnd(const Points& vertices) const {
    std::vector<Target> targets;
    const std::vector<Target> all = testing::vertexTargets(topology_, vertices);
    for (const Target& target : all) {
      if (positionOf(target.place, topology_.rest_vertices, topology_.tets).x() < 0.03)
        targets.push_back(target);
    }
    return targets;
  }
  std::vector<float> deviations(const std::vector<Target>& targets, const Points& vertices) {
    return body_.deviations(targets, vertices);
  }
  static double meanOf(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  /// The sponge, stretched along x.
  Points stretched(double factor) const {
    return topology_.rest_vertices * Eigen::Vector3d(factor, 1.0, 1.0).asDiagonal();
  }

  const TetTopology topology_ = testing::sponge();
  const Points& rest_ = topology_.rest_vertices;
  EstimatedBody body_{topology_};
};

TEST_F(StandardDeviationTest, IsLargestWithoutTargets) {
  const float unmeasured = deviations({}, rest_).front();
  for (const float value : deviations({}, rest_)) EXPECT_EQ(value, unmeasured);
  for (const float value : deviations(targetsAtOneEnd(rest_), rest_)) EXPECT_LT(value, unmeasured);
  for (const float value : deviations(testing::vertexTargets(topology_, rest_), rest_))
    EXPECT_LT(value, 0.2f * unmeasured);
}

TEST_F(StandardDeviationTest, GrowsWithTheDistanceFromTheMeasuredEnd) {
  const std::vector<float> found = deviations(targetsAtOneEnd(rest_), rest_);
  // Along x the vertices lie in planes, 20 mm apart.
  std::vector<float> smallest(11, 1.0f), largest(11, 0.0f);
  for (Eigen::Index v = 0; v < rest_.rows(); ++v) {
    const auto plane = static_cast<std::size_t>(std::lround(rest_(v, 0) / 0.02));
    smallest[plane] = std::min(smallest[plane], found[static_cast<std::size_t>(v)]);
    largest[plane] = std::max(largest[plane], found[static_cast<std::size_t>(v)]);
  }
  EXPECT_LT(largest[1], 0.2f * smallest[10]) << "measured";
  for (std::size_t plane = 2; plane < 11; ++plane) {
    EXPECT_GT(smallest[plane], smallest[plane - 1]);
    EXPECT_GT(largest[plane], largest[plane - 1]);
  }
}

TEST_F(StandardDeviationTest, GrowsWithTheStrainNotWithTheMotion) {
  const std::vector<float> still = deviations(targetsAtOneEnd(rest_), rest_);
  const Points moved = transformed(rest_, testing::somePose());
  const std::vector<float> after = deviations(targetsAtOneEnd(moved), moved);
  for (std::size_t v = 0; v < still.size(); ++v) EXPECT_NEAR(after[v], still[v], 1e-6f);
  double last = meanOf(still);
  for (const double factor : {1.05, 1.1, 1.2}) {
    const double mean = meanOf(deviations(targetsAtOneEnd(stretched(factor)), stretched(factor)));
    EXPECT_GT(mean, 1.1 * last);
    last = mean;
  }
}

/// What targets say of a vertex is wrong by at least their distance from it.
TEST_F(StandardDeviationTest, CoversTheResidualsOfTheTargets) {
  Points beside = rest_;
  beside.col(2).array() += 0.003;
  for (const float value : deviations(testing::vertexTargets(topology_, beside), rest_))
    EXPECT_GE(value, 0.003f);
}

TEST_F(StandardDeviationTest, ADirectionIsLessThanAPlace) {
  std::vector<Target> planes = targetsAtOneEnd(rest_);
  for (Target& target : planes) target.normal = Eigen::Vector3d::UnitZ();
  const std::vector<float> in_plane = deviations(planes, rest_),
                           all = deviations(targetsAtOneEnd(rest_), rest_), none = deviations({}, rest_);
  for (std::size_t v = 0; v < all.size(); ++v) {
    EXPECT_GT(in_plane[v], all[v]);
    EXPECT_LE(in_plane[v], none[v]);
  }
  // Three directions together are a place.
  std::vector<Target> three;
  for (int axis = 0; axis < 3; ++axis) {
    for (Target target : planes) {
      target.normal = Eigen::Vector3d::Unit(axis);
      three.push_back(target);
    }
  }
  const std::vector<float> together = deviations(three, rest_);
  for (std::size_t v = 0; v < all.size(); ++v) EXPECT_NEAR(together[v], all[v], 1e-9f);
}

TEST_F(StandardDeviationTest, PriorsMeasureNothing) {
  std::vector<Target> priors = testing::vertexTargets(topology_, rest_);
  for (Target& target : priors) target.kind = TargetKind::kPrior;
  EXPECT_EQ(deviations(priors, rest_), deviations({}, rest_));
}

/// Targets tell where a pinned piece is, though not which loads act on it.
TEST_F(StandardDeviationTest, APinnedPieceIsMeasuredToo) {
  const std::vector<Target> targets = testing::vertexTargets(topology_, rest_);
  const std::vector<float> none = body_.deviations({}, rest_, {Pin{0}}),
                           free = body_.deviations(targets, rest_),
                           pinned = body_.deviations(targets, rest_, {Pin{0}});
  for (std::size_t v = 0; v < none.size(); ++v) {
    EXPECT_LT(pinned[v], 0.2f * none[v]);
    EXPECT_GE(pinned[v], free[v]) << "of its loads nothing is known";
  }
}

TEST_F(StandardDeviationTest, PiecesAreMeasuredOnTheirOwn) {
  const TetTopology both = testing::twoBoxes({2, 1, 1}, {0.1, 0.05, 0.05});
  EstimatedBody body(both);
  std::vector<Target> targets = testing::vertexTargets(both, both.rest_vertices);
  const auto count = static_cast<std::size_t>(both.rest_vertices.rows());
  targets.erase(std::remove_if(targets.begin(), targets.end(),
                               [](const Target& target) { return target.position.x() > 0.2; }),
                targets.end());
  const std::vector<float> none = body.deviations({}, both.rest_vertices),
                           found = body.deviations(targets, both.rest_vertices);
  for (std::size_t v = 0; v < count; ++v) {
    if (v < count / 2)
      EXPECT_LT(found[v], none[v]);
    else
      EXPECT_EQ(found[v], none[v]);
  }
}

}  // namespace
}  // namespace softbody

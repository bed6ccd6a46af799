#include "alignment/rigid_alignment.h"

#include <gtest/gtest.h>

namespace softbody {
namespace {

const Eigen::Vector3d kShift(0.02, 0.0, 0.0);  // [m]

/// Associations of a small part of a piece, all shifted.
std::vector<Association> shifted(double weight = 1.0) {
  std::vector<Association> associations;
  for (int i = 0; i < 27; ++i) {
    Association a;
    a.predicted = 0.01 * Eigen::Vector3d(i % 3, i / 3 % 3, i / 9) + Eigen::Vector3d(0.0, 0.0, 0.5);
    a.measured = a.predicted + kShift;
    a.weight = weight;
    associations.push_back(a);
  }
  return associations;
}

/// The whole piece. @param copies of each of its corners.
Points piece(int copies) {
  Points points(8 * copies, 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points.row(i) = 0.05 * Eigen::RowVector3d(i & 1, i >> 1 & 1, i >> 2 & 1) + Eigen::RowVector3d(0, 0, 0.5);
  return points;
}

double shiftHeldBy(int copies, double weight) {
  const std::vector<Association> measured = shifted(weight);
  const auto held = heldBack(piece(copies), Eigen::Isometry3d::Identity(), refsTo(measured));
  const Eigen::Vector3d center = measured[13].predicted;
  return (rigidStep(refsTo(measured), held) * center - center).x();
}

TEST(HeldBack, CountsByWhatTheMeasurementsWeighHoweverFineThePiece) {
  const double one = shiftHeldBy(1, 1.0);
  EXPECT_GT(one, 0.5 * kShift.x()) << "what is measured leads";
  EXPECT_LT(one, kShift.x());
  EXPECT_NEAR(shiftHeldBy(50, 1.0), one, 1e-6);
  EXPECT_NEAR(shiftHeldBy(1, 0.01), one, 1e-6);
}

/// Rows without residual do not turn measurements into outliers, however many they are.
TEST(HeldBack, DoesNotSayWhatAnOutlierIs) {
  std::vector<Association> held = heldBack(piece(200), Eigen::Isometry3d::Identity(), refsTo(shifted()));
  for (Association& a : held) a.weight *= 1e-6;
  std::vector<Association> measured = shifted();
  for (std::size_t i = 0; i < measured.size(); ++i)
    measured[i].measured.x() += 0.001 * static_cast<double>(i);
  EXPECT_TRUE(rigidStep(refsTo(measured), held).isApprox(rigidStep(refsTo(measured)), 1e-5));
}

TEST(HeldBack, DrawsBackToWhereThePieceWasPredicted) {
  Eigen::Isometry3d motion(Eigen::Translation3d(0.003, 0.0, 0.0));
  const std::vector<Association> seen = shifted();
  for (const Association& a : heldBack(piece(1), motion, refsTo(seen)))
    EXPECT_LT((a.predicted - a.measured - motion.translation()).norm(), 1e-12);
}

}  // namespace
}  // namespace softbody

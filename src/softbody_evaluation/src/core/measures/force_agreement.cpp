#include "softbody_evaluation/measures/force_agreement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <iterator>

namespace softbody::evaluation {
namespace {

constexpr double kNear_n = 0.1;      // a force that is off by less is right
constexpr double kNearShare = 0.1;   // or by this share of it
constexpr double k90Percent = 6.25;  // of the squared lengths of three standard normal numbers

/// For each true force the sum of what was found near it, at its mean place. Nothing found: no covariance.
std::vector<ForcePatch> gathered(const std::vector<ForcePatch>& truth, const std::vector<ForcePatch>& found) {
  std::vector<ForcePatch> sums(truth.size());
  std::vector<double> sizes(truth.size(), 0.0);
  for (const ForcePatch& patch : found) {
    const auto nearer = [&](const ForcePatch& a, const ForcePatch& b) {
      return (a.place - patch.place).norm() < (b.place - patch.place).norm();
    };
    const auto k =
        static_cast<std::size_t>(std::min_element(truth.begin(), truth.end(), nearer) - truth.begin());
    const double size = patch.force.norm();
    sizes[k] += size;
    sums[k].force += patch.force;
    sums[k].covariance += patch.covariance;
    sums[k].place += size * patch.place;
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k].place /= std::max(sizes[k], 1e-12);
  return sums;
}

bool isFound(const ForcePatch& patch) { return patch.covariance.trace() > 0.0; }

bool isWithin(const ForcePatch& truth, const ForcePatch& found) {
  const Eigen::Vector3d error = found.force - truth.force;
  return isFound(found) && error.dot(found.covariance.ldlt().solve(error)) < k90Percent;
}

}  // namespace

void ForceAgreement::add(const std::vector<ForcePatch>& all, const std::vector<ForcePatch>& found) {
  std::vector<ForcePatch> truth;
  std::copy_if(all.begin(), all.end(), std::back_inserter(truth),
               [](const ForcePatch& patch) { return patch.force.norm() >= kNear_n; });
  if (truth.empty()) return;
  const std::vector<ForcePatch> sums = gathered(truth, found);
  for (std::size_t k = 0; k < truth.size(); ++k) within_ += isWithin(truth[k], sums[k]) ? 1 : 0;
  forces_ += truth.size();
  const auto largest =
      static_cast<std::size_t>(std::max_element(truth.begin(), truth.end(),
                                                [](const ForcePatch& a, const ForcePatch& b) {
                                                  return a.force.norm() < b.force.norm();
                                                }) -
                               truth.begin());
  const ForcePatch &expected = truth[largest], &sum = sums[largest];
  const double error = (sum.force - expected.force).norm();
  errors_n_.push_back(static_cast<float>(error));
  right_ += error <= std::max(kNear_n, kNearShare * expected.force.norm()) ? 1 : 0;
  if (isFound(sum)) places_m_.push_back(static_cast<float>((sum.place - expected.place).norm()));
}

std::optional<ForceReport> ForceAgreement::report() const {
  if (errors_n_.empty()) return std::nullopt;
  const auto share = [](std::size_t part, std::size_t all) {
    return static_cast<double>(part) / static_cast<double>(all);
  };
  return ForceReport{errors_n_.size(), summarize(errors_n_), share(right_, errors_n_.size()),
                     summarize(places_m_), share(within_, forces_)};
}

}  // namespace softbody::evaluation

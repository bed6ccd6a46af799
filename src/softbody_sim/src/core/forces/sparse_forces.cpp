#include "forces/sparse_forces.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace softbody {
namespace {

// A place whose variance is this share of the largest has no force.
constexpr double kNothing = 1e-4;

// 99.9 % of the squared lengths of three standard normal numbers are below it.
constexpr double kNotNoise = 16.27;

std::vector<int> rowsOf(const std::vector<int>& places) {
  std::vector<int> rows;
  for (int place : places) {
    for (int c = 0; c < 3; ++c) rows.push_back(3 * place + c);
  }
  return rows;
}

/// The forces on some places, for normal priors.
struct Posterior {
  Eigen::MatrixXd covariance() const { return root.transpose() * root; }
  Eigen::Matrix3d covarianceOf(Eigen::Index force) const {
    return root.middleCols<3>(3 * force).transpose() * root.middleCols<3>(3 * force);
  }

  Eigen::VectorXd mean;
  Eigen::MatrixXd root;  ///< root^T root is the covariance
  double log_evidence = 0.0;
};

Posterior posteriorOf(const ForceEvidence& evidence, const std::vector<int>& places,
                      const Eigen::VectorXd& deviations, double excess) {
  const std::vector<int> rows = rowsOf(places);
  const auto D = deviations.asDiagonal();
  Eigen::MatrixXd precision = D * evidence.G(rows, rows) * D;
  precision /= excess;
  precision.diagonal().array() += 1.0;
  const Eigen::VectorXd pull = D * Eigen::VectorXd(evidence.h(rows)) / excess;
  const Eigen::LLT<Eigen::MatrixXd> factor(precision);
  Eigen::MatrixXd root = deviations.asDiagonal();
  factor.matrixL().solveInPlace(root);
  const Eigen::VectorXd mean = factor.solve(pull);
  return {D * mean, std::move(root),
          0.5 * pull.dot(mean) - Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum()};
}

/// The search for places with forces.
class Search {
 public:
  Search(const ForceEvidence& evidence, double scale_n)
      : evidence_(evidence), deviations_(Eigen::VectorXd::Constant(evidence.h.size(), scale_n)) {
    for (int place = 0; place < evidence.h.size() / 3; ++place) places_.push_back(place);
    update();
  }

  /// Fixed-point iteration: each round lowers the variance of a place without a force.
  void findVariances(int rounds) {
    for (int round = 0; round < rounds && !places_.empty(); ++round) {
      improveVariances();
      const double least = std::sqrt(kNothing) * deviations_.maxCoeff();
      for (std::size_t k = places_.size(); k-- > 0;) {
        if (deviations_[3 * static_cast<Eigen::Index>(k)] <= least) remove(k);
      }
      update();
    }
  }

  /// Removes forces that may be noise, the least certain first.
  void removeNoise() {
    while (!places_.empty()) {
      Eigen::VectorXd certainty(places_.size());
      for (Eigen::Index k = 0; k < certainty.size(); ++k) {
        const Eigen::Vector3d force = posterior_.mean.segment<3>(3 * k);
        certainty[k] = force.dot(posterior_.covarianceOf(k).ldlt().solve(force));
      }
      Eigen::Index least = 0;
      if (certainty.minCoeff(&least) > kNotNoise) return;
      remove(static_cast<std::size_t>(least));
      update();
      if (places_.empty()) return;
      improveVariances();
      update();
    }
  }

  /// The mean, three a place.
  Eigen::VectorXd onPlaces() const {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(evidence_.h.size());
    for (std::size_t k = 0; k < places_.size(); ++k)
      forces.segment<3>(3 * places_[k]) = posterior_.mean.segment<3>(3 * static_cast<Eigen::Index>(k));
    return forces;
  }

  SparseForces result() const {
    SparseForces forces{places_, posterior_.mean, posterior_.covariance(), {}};
    for (std::size_t k = 0; k < places_.size(); ++k) addOtherPlaces(k, &forces);
    return forces;
  }

 private:
  void remove(std::size_t k) {
    const auto at = 3 * static_cast<Eigen::Index>(k), rest = deviations_.size() - at - 3;
    const Eigen::VectorXd after = deviations_.tail(rest);
    places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(k));
    deviations_.segment(at, rest) = after;
    deviations_.conservativeResize(at + rest);
  }

  void improveVariances() {
    for (Eigen::Index k = 0; k < deviations_.size(); k += 3) {
      const double prior = deviations_[k] * deviations_[k],
                   known = 3.0 - posterior_.root.middleCols<3>(k).squaredNorm() / prior;
      const double variance = posterior_.mean.segment<3>(k).squaredNorm() / std::max(known, 1e-12);
      deviations_.segment<3>(k).setConstant(std::sqrt(variance));
    }
  }

  void update() {
    posterior_ = posteriorOf(evidence_, places_, deviations_, excess_);
    const std::vector<int> rows = rowsOf(places_);
    const Eigen::VectorXd& f = posterior_.mean;
    const double chi_square = evidence_.chi_square - 2.0 * f.dot(Eigen::VectorXd(evidence_.h(rows))) +
                              f.dot(evidence_.G(rows, rows) * f);
    const Eigen::ArrayXd priors = deviations_.array().square();
    const double known = static_cast<double>(f.size()) -
                         (posterior_.root.colwise().squaredNorm().transpose().array() / priors).sum();
    excess_ = std::max(1.0, chi_square / std::max(1.0, evidence_.count - known));
  }

  /// The mean over all places that a force may have (Bayesian model averaging).
  void addOtherPlaces(std::size_t k, SparseForces* forces) const {
    const Eigen::Index count = evidence_.h.size() / 3;
    std::vector<Posterior> others(static_cast<std::size_t>(count));
    Eigen::VectorXd log_evidence = Eigen::VectorXd::Constant(count, -std::numeric_limits<double>::infinity());
    for (int place = 0; place < count; ++place) {
      std::vector<int> places = places_;
      places[k] = place;
      if (std::count(places.begin(), places.end(), place) > 1) continue;
      Posterior& other = others[static_cast<std::size_t>(place)];
      other = posteriorOf(evidence_, places, deviations_, excess_);
      log_evidence[place] = other.log_evidence;
    }
    Eigen::VectorXd weights(count);
    for (Eigen::Index place = 0; place < count; ++place)
      weights[place] = std::exp(log_evidence[place] - log_evidence.maxCoeff());
    weights /= weights.sum();
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(posterior_.mean.size());
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(mean.size(), mean.size());
    for (Eigen::Index place = 0; place < count; ++place) {
      const Posterior& other = others[static_cast<std::size_t>(place)];
      if (weights[place] == 0.0) continue;
      mean += weights[place] * other.mean;
      square += weights[place] * (other.covariance() + other.mean * other.mean.transpose());
    }
    forces->mean += mean - posterior_.mean;
    forces->covariance += square - mean * mean.transpose() - posterior_.covariance();
    forces->where.push_back(weights);
  }

  const ForceEvidence& evidence_;
  std::vector<int> places_;
  Eigen::VectorXd deviations_;  ///< of the priors, three a place [N]
  double excess_ = 1.0;         ///< of the measurements' variances
  Posterior posterior_;
};

}  // namespace

Eigen::VectorXd SparseForces::onPlaces(std::size_t place_count) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(place_count));
  for (std::size_t k = 0; k < where.size(); ++k) {
    for (Eigen::Index place = 0; place < where[k].size(); ++place)
      forces.segment<3>(3 * place) += where[k][place] * mean.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
  return forces;
}

SparseForces sparseForces(const ForceEvidence& evidence, double scale_n) {
  Search search(evidence, scale_n);
  search.findVariances(12);
  search.removeNoise();
  return search.result();
}

Eigen::VectorXd smoothForces(const ForceEvidence& evidence, double scale_n) {
  Search search(evidence, scale_n);
  search.findVariances(3);
  return search.onPlaces();
}

}  // namespace softbody

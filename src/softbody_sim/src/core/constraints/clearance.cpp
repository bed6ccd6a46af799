#include "constraints/clearance.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/rigid_fit.h"

namespace softbody {

void Clearance::set(const Points& reference, double distance_m) {
  reference_ = reference;
  distance_m_ = distance_m;
  deviation_m_ = 0.0;
}

void Clearance::start(const Points& before) {
  const Eigen::Isometry3d T = fitRigid(reference_, before);
  double largest = 0.0;  // squared
  for (Eigen::Index v = 0; v < before.rows(); ++v) {
    const Eigen::Vector3d place = reference_.row(v), now = before.row(v);
    largest = std::max(largest, (T * place - now).squaredNorm());
  }
  deviation_m_ = std::sqrt(largest);
}

double Clearance::until(const Points& before, const Points& now) const {
  const Eigen::RowVector3d shift = (now - before).colwise().mean();
  double largest = 0.0;  // squared
  for (Eigen::Index v = 0; v < before.rows(); ++v)
    largest = std::max(largest, (now.row(v) - before.row(v) - shift).squaredNorm());
  return atStart() - 2.0 * std::sqrt(largest);
}

}  // namespace softbody

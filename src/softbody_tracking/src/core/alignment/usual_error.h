#pragma once

#include "prediction/memory.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// How far predictions were off in the last frames. The labels beside the predicted outline
/// expect such errors.
class UsualError {
 public:
  /// Largest error of a vertex [m]; 0 before learn().
  double meters() const { return error_m_; }

  /// @param predicted vertices of the volume. @param found where the frame then showed them.
  /// @param elapsed_s since the frame before.
  void learn(const Points& predicted, const Points& found, double elapsed_s) {
    const double error_m = (found - predicted).rowwise().norm().maxCoeff();
    error_m_ += newestShare(elapsed_s, kErrorMemory_s) * (error_m - error_m_);
  }

 private:
  double error_m_ = 0.0;
};

}  // namespace softbody

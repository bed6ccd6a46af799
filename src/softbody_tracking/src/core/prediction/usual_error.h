#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// How far predictions were off in the last frames. The next alignment expects such motions.
class UsualError {
 public:
  /// Largest error of a vertex [m]; 0 before learn().
  double meters() const { return error_m_; }

  /// @param predicted vertices of the volume. @param found where the frame then showed them.
  void learn(const Points& predicted, const Points& found) {
    error_m_ += kNewestShare * ((found - predicted).rowwise().norm().maxCoeff() - error_m_);
  }

 private:
  // Share of the last frame: motion changes within some frames.
  static constexpr double kNewestShare = 0.5;

  double error_m_ = 0.0;
};

}  // namespace softbody

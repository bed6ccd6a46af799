#pragma once

#include <vector>

#include "prediction/color_model.h"
#include "registration/registration.h"

namespace softbody {

/// A coarser mesh of the same outline for rendering small: vertices clustered in cells of the given side, or
/// smaller ones where those leave hardly anything of a thin mesh.
TriangleMesh clustered(const TriangleMesh& mesh, double cell_m);

/// Finds a body anywhere in a frame, in any orientation: turned starts on every piece of the depth image of
/// about its size, short projective ICP each, the best refined on poseCost.
class BodyFinder {
 public:
  BodyFinder(const TriangleMesh& rest_surface, const RegistrationConfig& config);

  /// Poses that differ by more than 20 degrees or a fifth of the body's size, at least one for every place
  /// where the body may be, those first that most of the depth speaks for: in the same place those of a
  /// symmetric body follow each other, another place may hold something that resembles it. Empty if nothing
  /// is there.
  /// @param colors learned: only pixels of the body's colours count. @param guesses further starts.
  std::vector<RegistrationResult> find(const RgbdFrame& frame, const ColorModel& colors,
                                       const std::vector<Eigen::Isometry3d>& guesses) const;

 private:
  std::vector<std::vector<Eigen::Isometry3d>> places(const RgbdFrame& frame, const ColorModel& colors,
                                                     const std::vector<Eigen::Isometry3d>& guesses) const;
  std::vector<Eigen::Isometry3d> startsAt(const Eigen::Vector3d& center) const;
  std::vector<RegistrationResult> distinct(const std::vector<RegistrationResult>& poses,
                                           std::size_t most) const;

  RegistrationConfig config_;
  TriangleMesh mesh_, coarse_;
  double diameter_;
};

}  // namespace softbody

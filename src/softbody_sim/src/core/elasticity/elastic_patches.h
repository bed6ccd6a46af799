#pragma once

#include <vector>

#include "elasticity/lame_parameters.h"
#include "elasticity/smoothing_kernel.h"
#include "elasticity/strain_smoothing.h"
#include "simd/rows.h"

namespace softbody {

/// The part of CorotatedElasticity with smoothed strains, for the vector kernels, in the precision T.
template <typename T>
class ElasticPatches {
 public:
  ElasticPatches(const SmoothedGradients& smoothed, const EnergyShare& share, Simd simd);

  /// Energy [J]; adds its gradient [N].
  double addTo(const Rows<T>& x, Rows<T>* gradient);

 private:
  std::vector<int> first_, rows_, columns_;
  std::vector<T> gradients_, gradients_there_, volumes_;
  std::vector<T> deformations_, stresses_;  ///< buffers of the kernel
  T mu_, lambda_;
  SmoothingKernel<T> kernel_;
};

}  // namespace softbody

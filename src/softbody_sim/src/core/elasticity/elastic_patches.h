#pragma once

#include <vector>

#include "elasticity/corotated_elasticity.h"
#include "elasticity/smoothing_kernel.h"
#include "simd/rows.h"

namespace softbody {

/// The part of CorotatedElasticity with smoothed strains, for the vector kernels, in the precision T.
template <typename T>
class ElasticPatches {
 public:
  ElasticPatches(const CorotatedElasticity& elasticity, Eigen::Index vertex_count, Simd simd);

  /// Energy [J]; adds its gradient [N].
  double addTo(const Rows<T>& x, Rows<T>* gradient);

 private:
  void transpose(const SmoothedGradients& smoothed, Eigen::Index vertex_count);

  std::vector<int> first_, rows_, columns_;
  std::vector<int> vertex_first_, vertex_rows_;  ///< empty if the same: then the pattern is symmetric
  std::vector<T> gradients_, vertex_gradients_, shear_, bulk_;
  std::vector<T> deformations_, stresses_;  ///< buffers of the kernel
  SmoothingKernel<T> kernel_;
};

}  // namespace softbody

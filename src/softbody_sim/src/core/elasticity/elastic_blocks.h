#pragma once

#include <optional>
#include <vector>

#include "elasticity/corotated_elasticity.h"
#include "elasticity/elastic_patches.h"
#include "elasticity/elasticity_kernel.h"
#include "simd/rows.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// CorotatedElasticity in blocks of tets for the vector kernels, in the precision T.
template <typename T>
class ElasticBlocks {
 public:
  /// @param rest_vertices of the elasticity.
  ElasticBlocks(const Points& rest_vertices, const CorotatedElasticity& elasticity, Simd simd);

  /// Energy [J]; adds its gradient [N].
  double addTo(const Rows<T>& x, Rows<T>* gradient) {
    const double energy = kernel_(blocks_.data(), blocks_.size(), x.data(), gradient->data());
    return patches_ ? energy + patches_->addTo(x, gradient) : energy;
  }

 private:
  std::vector<TetBlock<T>> blocks_;
  ElasticityKernel<T> kernel_;
  std::optional<ElasticPatches<T>> patches_;
};

}  // namespace softbody

#include "elasticity/elastic_patches.h"

#include <algorithm>

namespace softbody {
namespace {

/// The entry of vertex `neighbour` in the patch of `vertex`.
std::ptrdiff_t entryOf(const SmoothedGradients& smoothed, int vertex, int neighbour) {
  const auto begin = smoothed.vertices.begin();
  return std::lower_bound(begin + smoothed.first[vertex], begin + smoothed.first[vertex + 1], neighbour) -
         begin;
}

}  // namespace

template <typename T>
ElasticPatches<T>::ElasticPatches(const SmoothedGradients& smoothed, const EnergyShare& share, Simd simd)
    : first_(smoothed.first),
      mu_(static_cast<T>(share.lame.mu)),
      lambda_(static_cast<T>(share.lame.lambda)),
      kernel_(smoothingKernel<T>(simd)) {
  const auto count = static_cast<int>(smoothed.volumes.size());
  for (int v = 0; v < count; ++v) {
    for (int e = first_[v]; e < first_[v + 1]; ++e) {
      const int i = smoothed.vertices[e];
      rows_.push_back(4 * i);
      const std::ptrdiff_t there = entryOf(smoothed, i, v);
      for (int k = 0; k < 3; ++k) {
        gradients_.push_back(static_cast<T>(smoothed.gradients(e, k)));
        gradients_there_.push_back(static_cast<T>(smoothed.gradients(there, k)));
      }
    }
    volumes_.push_back(static_cast<T>(share.volume * smoothed.volumes[v]));
  }
  volumes_.resize(static_cast<std::size_t>(paddedRows(count)), T{0});
  for (std::size_t v = 0; v < volumes_.size(); ++v) columns_.push_back(12 * static_cast<int>(v));
  deformations_.resize(12 * volumes_.size());
  stresses_.resize(12 * volumes_.size());
}

template <typename T>
double ElasticPatches<T>::addTo(const Rows<T>& x, Rows<T>* gradient) {
  const PatchView<T> view{first_.size() - 1,       first_.data(),   rows_.data(),    gradients_.data(),
                          gradients_there_.data(), volumes_.size(), columns_.data(), volumes_.data()};
  return kernel_(view, mu_, lambda_, x.data(), deformations_.data(), stresses_.data(), gradient->data());
}

template class ElasticPatches<float>;
template class ElasticPatches<double>;

}  // namespace softbody

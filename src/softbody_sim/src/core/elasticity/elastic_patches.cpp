#include "elasticity/elastic_patches.h"

namespace softbody {

template <typename T>
ElasticPatches<T>::ElasticPatches(const CorotatedElasticity& elasticity, Eigen::Index vertex_count, Simd simd)
    : first_(elasticity.smoothed().first), kernel_(smoothingKernel<T>(simd)) {
  const SmoothedGradients& smoothed = elasticity.smoothed();
  const auto count = smoothed.volumes.size();
  for (std::size_t e = 0; e < smoothed.vertices.size(); ++e) {
    rows_.push_back(4 * smoothed.vertices[e]);
    for (int k = 0; k < 3; ++k)
      gradients_.push_back(static_cast<T>(smoothed.gradients(static_cast<Eigen::Index>(e), k)));
  }
  const auto padded = static_cast<std::size_t>(paddedRows(count));
  shear_.assign(padded, T{0});
  bulk_ = shear_;
  for (Eigen::Index p = 0; p < count; ++p) {
    const Lame lame = elasticity.patchLame(p);
    shear_[static_cast<std::size_t>(p)] = static_cast<T>(2.0 * lame.mu * smoothed.volumes[p]);
    bulk_[static_cast<std::size_t>(p)] = static_cast<T>(lame.lambda * smoothed.volumes[p]);
  }
  for (std::size_t p = 0; p < padded; ++p) columns_.push_back(12 * static_cast<int>(p));
  transpose(smoothed, vertex_count);
  deformations_.resize(12 * padded);
  stresses_.resize(12 * padded);
}

/// Lists the patches of each vertex, so that its forces are summed in one place.
template <typename T>
void ElasticPatches<T>::transpose(const SmoothedGradients& smoothed, Eigen::Index vertex_count) {
  vertex_first_.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const int i : smoothed.vertices) ++vertex_first_[static_cast<std::size_t>(i) + 1];
  for (std::size_t v = 1; v < vertex_first_.size(); ++v) vertex_first_[v] += vertex_first_[v - 1];
  std::vector<int> next = vertex_first_;
  vertex_rows_.resize(rows_.size());
  vertex_gradients_.resize(gradients_.size());
  for (int p = 0; p + 1 < static_cast<int>(first_.size()); ++p) {
    for (int e = first_[p]; e < first_[p + 1]; ++e) {
      const int there = next[smoothed.vertices[e]]++;
      vertex_rows_[there] = 4 * p;
      for (int k = 0; k < 3; ++k) vertex_gradients_[3 * there + k] = gradients_[3 * e + k];
    }
  }
  if (vertex_first_ != first_ || vertex_rows_ != rows_) return;
  vertex_first_ = {};
  vertex_rows_ = {};
}

template <typename T>
double ElasticPatches<T>::addTo(const Rows<T>& x, Rows<T>* gradient) {
  const bool symmetric = vertex_first_.empty();
  const std::vector<int>&vertex_first = symmetric ? first_ : vertex_first_,
        &vertex_rows = symmetric ? rows_ : vertex_rows_;
  const PatchView<T> view{first_.size() - 1,   first_.data(),      rows_.data(),
                          gradients_.data(),   shear_.size(),      columns_.data(),
                          shear_.data(),       bulk_.data(),       vertex_first.size() - 1,
                          vertex_first.data(), vertex_rows.data(), vertex_gradients_.data()};
  return kernel_(view, x.data(), deformations_.data(), stresses_.data(), gradient->data());
}

template class ElasticPatches<float>;
template class ElasticPatches<double>;

}  // namespace softbody

#include "softbody_sim/interpolation/tet_binding.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"
#include "tets/tet_shape.h"

namespace softbody {

TetBinding::TetBinding(const TetTopology& volume, std::vector<MaterialPoint> places)
    : volume_(volume), places_(std::move(places)) {}

namespace {

/// In a tet that a cut has left almost flat, the rounding of coordinates is an enormous strain.
constexpr double kLargestStrain = 10.0;  // |F^T F - I|; twice as long in all directions is 5.2

double strainOf(const Eigen::Matrix3d& rest, const Eigen::Matrix3d& edges) {
  const Eigen::Matrix3d F = edges * rest.inverse();
  const double strain = (F.transpose() * F - Eigen::Matrix3d::Identity()).norm();
  return strain < kLargestStrain ? strain : kLargestStrain;  // also where it is not a number
}

}  // namespace

/// Per piece the integral of |F^T F - I|^2, up to a constant factor.
std::vector<double> TetBinding::squaredStrains(const Points& vertices) const {
  std::vector<double> strains;
  for (Eigen::Index t = 0; t < volume_.tets.rows(); ++t) {
    const std::size_t piece = volume_.tet_pieces[static_cast<std::size_t>(t)];
    if (piece >= strains.size()) strains.resize(piece + 1, 0.0);
    const Eigen::RowVector4i tet = volume_.tets.row(t);
    const Eigen::Matrix3d rest = edgesOf(volume_.rest_vertices, tet);
    const double strain = strainOf(rest, edgesOf(vertices, tet));
    strains[piece] += std::abs(rest.determinant()) * strain * strain;
  }
  return strains;
}

std::vector<double> TetBinding::correctionScales(const Points& vertices) const {
  std::vector<double> scales = squaredStrains(vertices);
  for (std::size_t b = 0; b < scales.size(); ++b) {
    scales[b] = scales[b] >= strains_[b] ? 1.0 : std::sqrt(scales[b] / strains_[b]);
  }
  return scales;
}

/// Computes corrections in one state of the volume.
class TetBinding::Corrector {
 public:
  Corrector(const TetTopology& volume, const Points& vertices)
      : volume_(volume), vertices_(vertices), frames_(static_cast<std::size_t>(volume.tets.rows())) {}

  /// The correction that moves a point of `tet` by `offset`.
  Correction correction(int tet, const Eigen::Vector3d& offset) {
    Candidate best = candidate(tet, offset);
    if (best.reach <= kLongestReach * offset.norm()) return best.correction;
    for (const int neighbour : neighboursOf(tet)) {
      const Candidate other = candidate(neighbour, offset);
      if (other.reach < best.reach || !std::isfinite(best.reach)) best = other;
    }
    return std::isfinite(best.reach) ? best.correction : Correction{tet, Eigen::Vector4d::Zero()};
  }

 private:
  static constexpr double kLongestReach = 6.0;  // over the offset; about 1 in a well-shaped tet

  struct Frame {
    Eigen::PartialPivLU<Eigen::Matrix3d> edges;
    double longest_edge;  ///< at rest [m]
  };
  struct Candidate {
    Correction correction;
    double reach;  ///< how far the correction can move its point when the tet deforms [m]
  };

  Frame frameOf(int tet) const {
    const Eigen::RowVector4i corners = volume_.tets.row(tet);
    double longest = 0.0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        const Eigen::RowVector3d edge =
            volume_.rest_vertices.row(corners[i]) - volume_.rest_vertices.row(corners[j]);
        longest = std::max(longest, edge.norm());
      }
    }
    return {Eigen::PartialPivLU<Eigen::Matrix3d>(edgesOf(vertices_, corners)), longest};
  }

  Candidate candidate(int tet, const Eigen::Vector3d& offset) {
    std::optional<Frame>& frame = frames_[static_cast<std::size_t>(tet)];
    if (!frame) frame = frameOf(tet);
    const Eigen::Vector3d weights = frame->edges.solve(offset);
    Candidate candidate{{tet, {}}, 0.0};
    candidate.correction.barycentric << -weights.sum(), weights;
    candidate.reach =
        candidate.correction.barycentric.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() * frame->longest_edge;
    return candidate;
  }

  /// The tets that share a vertex with a tet; they belong to the same piece.
  const std::vector<int>& neighboursOf(int tet) {
    if (tets_at_.empty()) {
      tets_at_.resize(static_cast<std::size_t>(volume_.rest_vertices.rows()));
      for (int t = 0; t < static_cast<int>(volume_.tets.rows()); ++t) {
        for (const int v : volume_.tets.row(t)) tets_at_[static_cast<std::size_t>(v)].push_back(t);
      }
    }
    const auto [entry, is_new] = neighbours_.try_emplace(tet);
    for (const int v : volume_.tets.row(tet)) {
      if (!is_new) break;
      const std::vector<int>& tets = tets_at_[static_cast<std::size_t>(v)];
      entry->second.insert(entry->second.end(), tets.begin(), tets.end());
    }
    return entry->second;
  }

  const TetTopology& volume_;
  const Points& vertices_;
  std::vector<std::optional<Frame>> frames_;    ///< per tet, computed at first use
  std::vector<std::vector<int>> tets_at_;       ///< per vertex, computed for the first flat tet
  std::map<int, std::vector<int>> neighbours_;  ///< of flat tets
};

std::size_t TetBinding::bytes() const {
  const std::size_t indices = static_cast<std::size_t>(volume_.tets.size() + volume_.surface.size()) +
                              volume_.vertex_parents.size() + volume_.tet_pieces.size();
  const std::size_t doubles = static_cast<std::size_t>(volume_.rest_vertices.size()) + strains_.size();
  return indices * sizeof(int) + doubles * sizeof(double) + places_.size() * sizeof(MaterialPoint) +
         corrections_.size() * sizeof(Correction);
}

/// Squared strains, per piece, that explain offsets of its points. An offset without a strain is left from
/// another state, in which other parts of the body were deformed: it would stay for ever.
std::vector<double> TetBinding::strainsOf(const Points& offsets) const {
  constexpr double kLargestOffset = 4.0;  // over the piece's size and its strain
  struct Sum {
    double volume = 0.0, squares = 0.0;
    int points = 0;
  };
  std::vector<Sum> sums;
  const auto of = [&sums](std::size_t piece) -> Sum& {
    if (piece >= sums.size()) sums.resize(piece + 1);
    return sums[piece];
  };
  for (Eigen::Index t = 0; t < volume_.tets.rows(); ++t)
    of(volume_.tet_pieces[static_cast<std::size_t>(t)]).volume +=
        std::abs(edgesOf(volume_.rest_vertices, volume_.tets.row(t)).determinant());
  for (std::size_t p = 0; p < places_.size(); ++p) {
    Sum& sum = of(volume_.tet_pieces[static_cast<std::size_t>(places_[p].tet)]);
    sum.squares += offsets.row(static_cast<Eigen::Index>(p)).squaredNorm();
    ++sum.points;
  }
  std::vector<double> strains;
  for (const Sum& sum : sums)
    strains.push_back(std::cbrt(sum.volume) * sum.squares /
                      (kLargestOffset * kLargestOffset * std::max(sum.points, 1)));
  return strains;
}

void TetBinding::correctTo(const Points& vertices, const Points& positions) {
  const Points offsets = positions - applyBinding(places_, vertices, volume_.tets);
  strains_ = squaredStrains(vertices);
  const std::vector<double> needed = strainsOf(offsets);
  for (std::size_t b = 0; b < strains_.size(); ++b) strains_[b] = std::max(strains_[b], needed[b]);
  corrections_.resize(places_.size());
  Corrector corrector(volume_, vertices);
  for (std::size_t p = 0; p < places_.size(); ++p) {
    const Eigen::Vector3d offset = offsets.row(static_cast<Eigen::Index>(p));
    corrections_[p] = corrector.correction(places_[p].tet, offset);
  }
}

void TetBinding::apply(const MeshState& volume, const std::vector<int>& which, MeshState* state) const {
  std::vector<double> scales;
  if (!corrections_.empty()) scales = correctionScales(volume.vertices);
  for (const int p : which) {
    const MaterialPoint& place = places_[static_cast<std::size_t>(p)];
    float confidence = 0.0f;
    for (int c = 0; c < 4; ++c) {
      confidence += static_cast<float>(place.barycentric[c]) *
                    volume.confidence[static_cast<std::size_t>(volume_.tets(place.tet, c))];
    }
    Eigen::Vector3d position = positionOf(place, volume.vertices, volume_.tets);
    if (!scales.empty()) {
      const Correction& correction = corrections_[static_cast<std::size_t>(p)];
      const double scale = scales[volume_.tet_pieces[static_cast<std::size_t>(place.tet)]];
      position += scale * positionOf({correction.tet, correction.barycentric}, volume.vertices, volume_.tets);
    }
    state->vertices.row(p) = position;
    state->confidence[static_cast<std::size_t>(p)] = std::clamp(confidence, 0.0f, 1.0f);
  }
}

}  // namespace softbody

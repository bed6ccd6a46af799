#include "features/feature_outliers.h"

#include <Eigen/Dense>
#include <algorithm>

#include "features/pixel_grid.h"
#include "softbody_common/statistics/median.h"
#include "softbody_common/statistics/robust.h"

namespace softbody {
namespace {

// Largest motion of a feature between prediction and frame [m]: 3 m/s at 30 Hz. More is a wrong match.
constexpr double kLargestMotion = 0.1;
// The same, in any direction, from its neighbours, or from the prediction where there are few [m].
constexpr double kMaxDisagreement_m = 0.006;
// Cells [px] for the search of neighbours: a few patches wide.
constexpr int kNeighborhoodPx = 40;
// Matches of a piece, below which its motion cannot be estimated.
constexpr std::size_t kFewest = 4;
// Matches used for the motion of a piece, and of a neighbourhood; more would only cost time.
constexpr std::size_t kEnoughOfPiece = 128, kEnoughNeighbors = 48;
// Refits with Cauchy weights; the medians are a good start.
constexpr int kOutlierFits = 2;
// Number of matches that the piece's motion counts for in a neighbourhood, ...
constexpr double kPieceMatches = 10.0;
// ... as if they were spread over this radius [px].
constexpr double kPieceReachPx = 40.0;
// Added to the spread [m]: matches that agree exactly would make an outlier of every other one.
constexpr double kSmallestSpread = 1e-4;
// A match may disagree by this many times the neighbours' median disagreement, ...
constexpr double kLargestSpread = 3.0;
// ... but across the ray always by the first [px], the precision of a match. A limb moves by less than the
// second.
constexpr double kPrecisePx = 1.5, kWrongPx = 4.0;
// Matches that move alike, from which they count as a limb; wrong matches in one place are fewer.
constexpr int kFewestTogether = 20;
// Nearest matches of a limb's match. At least half of them must move with the limb.
constexpr std::size_t kBeside = 8;
// Number of matches that the surroundings' turn and stretch count for in the fit of a limb.
constexpr double kLimbMatches = 4.0;

/// Motion of matches relative to the prediction, linear in the image: a part of a body that turns and
/// stretches.
struct LinearMotion {
  cv::Point2f center;
  Eigen::Matrix3d motion = Eigen::Matrix3d::Zero();  ///< [m], of (1, right, down) from the centre [px]
  double spread = 0.0;                               ///< median of the disagreements across the ray [m]

  Eigen::Vector3d offset(const cv::Point2f& pixel) const {
    return {1.0, pixel.x - center.x, pixel.y - center.y};
  }
  Eigen::Vector3d at(const cv::Point2f& pixel) const { return motion * offset(pixel); }
  LinearMotion about(const cv::Point2f& other) const {
    LinearMotion same = *this;
    same.center = other;
    same.motion.col(0) = at(other);
    return same;
  }
};

/// Motions of the matches, and linear motions fitted to them.
class Motions {
 public:
  explicit Motions(const std::vector<FeatureMatch>& matches) : matches_(matches) {
    motions_.reserve(matches.size());
    rays_.reserve(matches.size());
    for (const FeatureMatch& match : matches) {
      motions_.push_back(match.association.measured - match.association.predicted);
      rays_.push_back(match.association.measured.normalized());
    }
  }

  const Eigen::Vector3d& of(int match) const { return motions_[match]; }
  /// Distance between a match's motion and the linear one, across the ray [m]. Along the ray depth is less
  /// precise.
  double disagreement(int match, const LinearMotion& around) const {
    return (motions_[match] - around.at(matches_[match].pixel)).cross(rays_[match]).norm();
  }

  /// Motion of a whole piece. The fit starts from the medians.
  LinearMotion ofPiece(const std::vector<int>& piece) {
    take(piece, kEnoughOfPiece);
    LinearMotion result;
    result.center = matches_[piece.front()].pixel;
    for (int k = 0; k < 3; ++k) result.motion(k, 0) = medianOf([&](int other) { return motions_[other][k]; });
    return fitted(result, 1.0);
  }

  /// Motion of a neighbourhood. The fit starts from the piece's motion and stays close to it if the
  /// neighbours are few or disagree.
  LinearMotion around(const PixelGrid& grid, const cv::Point2f& pixel, const LinearMotion& piece) {
    std::size_t count = 0;
    grid.around(pixel.x, pixel.y, [&](int) { ++count; });
    const std::size_t step = 1 + count / kEnoughNeighbors;
    neighbors_.clear();
    grid.around(pixel.x, pixel.y, [&](int other) {
      if (count++ % step == 0) neighbors_.push_back(other);
    });
    return fitted(piece.about(pixel), kPieceMatches);
  }

  /// A neighbourhood's motion, shifted by the median difference of a limb's matches from it.
  LinearMotion shifted(const std::vector<int>& limb, const LinearMotion& around) {
    take(limb, kEnoughNeighbors);
    LinearMotion result = around;
    for (int k = 0; k < 3; ++k) {
      result.motion(k, 0) +=
          medianOf([&](int other) { return (motions_[other] - around.at(matches_[other].pixel))[k]; });
    }
    return result;
  }

  /// Motion of a limb. The fit starts from the shifted motion.
  LinearMotion ofLimb(const std::vector<int>& limb, const LinearMotion& shifted) {
    take(limb, kEnoughNeighbors);
    return fitted(shifted, kLimbMatches);
  }

  /// Distance of two motions at a match, across the ray [m].
  double apart(int match, const LinearMotion& a, const LinearMotion& b) const {
    const cv::Point2f& pixel = matches_[match].pixel;
    return (a.at(pixel) - b.at(pixel)).cross(rays_[match]).norm();
  }

 private:
  /// Makes these matches the neighbours; every second, third, ... if they are more than enough.
  void take(const std::vector<int>& from, std::size_t enough) {
    neighbors_.clear();
    for (std::size_t i = 0; i < from.size(); i += 1 + from.size() / enough) neighbors_.push_back(from[i]);
  }

  /// Least squares with Cauchy weights. @param prior_matches number of matches that the prior counts for.
  LinearMotion fitted(const LinearMotion& prior, double prior_matches) {
    constexpr double kReach2 = kPieceReachPx * kPieceReachPx;
    const Eigen::Matrix3d prior_weight =
        (prior_matches * Eigen::Vector3d(1.0, kReach2, kReach2)).asDiagonal();
    LinearMotion result = prior;
    result.spread = updateSpread(result);
    for (int i = 0; i < kOutlierFits; ++i) {
      Eigen::Matrix3d A = prior_weight, B = prior_weight * prior.motion.transpose();
      for (std::size_t n = 0; n < neighbors_.size(); ++n) {
        const int other = neighbors_[n];
        const double ratio = disagreements_[n] / (result.spread + kSmallestSpread);
        const Eigen::Vector3d offset = result.offset(matches_[other].pixel);
        const Eigen::Vector3d weighted = cauchyWeighted(offset, ratio * ratio);
        A += weighted * offset.transpose();
        B += weighted * motions_[other].transpose();
      }
      result.motion = A.ldlt().solve(B).transpose();
      result.spread = updateSpread(result);
    }
    return result;
  }

  /// Median disagreement of the neighbours [m]. Also fills disagreements_, which fitted() needs.
  double updateSpread(const LinearMotion& motion) {
    disagreements_.clear();
    for (int other : neighbors_) disagreements_.push_back(disagreement(other, motion));
    values_ = disagreements_;
    return median(&values_);
  }

  template <typename Value>
  double medianOf(const Value& value) {
    values_.clear();
    for (int other : neighbors_) values_.push_back(value(other));
    return median(&values_);
  }

  const std::vector<FeatureMatch>& matches_;
  std::vector<Eigen::Vector3d> motions_, rays_;
  std::vector<int> neighbors_;
  std::vector<double> disagreements_, values_;
};

/// Finds the outliers of one piece: matches that move otherwise than their neighbourhood.
class PieceOutliers {
 public:
  /// @param piece its matches, at least kFewest.
  PieceOutliers(const Pinhole& camera, const std::vector<int>& piece, Motions* motions,
                std::vector<FeatureMatch>* matches)
      : fx_(camera.fx),
        motions_(*motions),
        matches_(*matches),
        grid_(camera, kNeighborhoodPx),
        whole_(motions->ofPiece(piece)) {
    for (int m : piece) grid_.insert(matches_[m].pixel, m);
  }

  void mark() {
    std::vector<int> kept;
    for (const std::vector<int>& cell : grid_.cells()) {
      if (cell.empty()) continue;
      // A cell's matches have the same neighbours.
      const cv::Point2f& pixel = matches_[cell.front()].pixel;
      const LinearMotion around = motions_.around(grid_, pixel, whole_);
      bool all = true;
      for (int m : cell) {
        const double across = std::max(kLargestSpread * around.spread, kPrecisePx * pixelSize(m));
        if (agrees(m, around, across))
          kept.push_back(m);
        else
          all = false;
      }
      if (!all) keepLimb(pixel, around, cell, &kept);
    }
    for (const std::vector<int>& cell : grid_.cells())
      for (int m : cell) matches_[m].inlier = false;
    for (int m : kept) matches_[m].inlier = true;
  }

 private:
  double pixelSize(int m) const { return matches_[m].association.measured.z() / fx_; }

  bool agrees(int m, const LinearMotion& around, double across) const {
    const FeatureMatch& match = matches_[m];
    return match.inlier && motions_.disagreement(m, around) < across &&
           (motions_.of(m) - around.at(match.pixel)).norm() < kMaxDisagreement_m;
  }

  /// Keeps the matches of a limb. A limb that bends moves otherwise than the many features of the body, but
  /// as one.
  void keepLimb(const cv::Point2f& pixel, const LinearMotion& around, const std::vector<int>& cell,
                std::vector<int>* kept) {
    std::vector<int> limb;
    grid_.around(pixel.x, pixel.y, [&](int m) {
      const double off = motions_.disagreement(m, around) / pixelSize(m);
      if (matches_[m].inlier && off >= kPrecisePx && off < kWrongPx) limb.push_back(m);
    });
    if (limb.size() < std::size_t{kFewestTogether}) return;
    const LinearMotion shifted = motions_.shifted(limb, around);
    // Differences in all directions are noise.
    if (motions_.apart(cell.front(), shifted, around) < kPrecisePx * pixelSize(cell.front())) return;
    const LinearMotion its = motions_.ofLimb(limb, shifted);
    const auto belongs = [&](int m) { return agrees(m, its, kPrecisePx * pixelSize(m)); };
    if (std::count_if(limb.begin(), limb.end(), belongs) < kFewestTogether) return;
    for (int m : cell)
      if (belongs(m) && isAmongLimb(m, its, around)) kept->push_back(m);
  }

  /// Whether the matches beside this one move with the limb. A reflection or a shadow lies among the body's
  /// matches.
  bool isAmongLimb(int match, const LinearMotion& limb, const LinearMotion& body) const {
    const cv::Point2f& pixel = matches_[match].pixel;
    std::vector<std::pair<float, int>> beside;  // square of the distance [px^2], match
    grid_.around(pixel.x, pixel.y, [&](int m) {
      const cv::Point2f off = matches_[m].pixel - pixel;
      if (m != match && matches_[m].inlier) beside.emplace_back(off.dot(off), m);
    });
    const std::size_t count = std::min(kBeside, beside.size());
    const auto last = beside.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(beside.begin(), last, beside.end());
    const auto with_limb = std::count_if(beside.begin(), last, [&](const auto& other) {
      return motions_.disagreement(other.second, limb) < motions_.disagreement(other.second, body);
    });
    return 2 * static_cast<std::size_t>(with_limb) >= count;
  }

  double fx_;
  Motions& motions_;
  std::vector<FeatureMatch>& matches_;
  PixelGrid grid_;
  LinearMotion whole_;
};

}  // namespace

void markOutliers(const Pinhole& camera, std::vector<FeatureMatch>* matches) {
  Motions motions(*matches);
  std::vector<std::vector<int>> pieces;
  for (std::size_t m = 0; m < matches->size(); ++m) {
    FeatureMatch& match = (*matches)[m];
    match.inlier = motions.of(static_cast<int>(m)).norm() < kLargestMotion;
    if (match.association.piece >= pieces.size()) pieces.resize(match.association.piece + 1);
    pieces[match.association.piece].push_back(static_cast<int>(m));
  }
  for (const std::vector<int>& piece : pieces) {
    if (piece.size() >= kFewest) {
      PieceOutliers(camera, piece, &motions, matches).mark();
      continue;
    }
    for (int m : piece) {
      FeatureMatch& match = (*matches)[m];
      match.inlier = match.inlier && motions.of(m).norm() < kMaxDisagreement_m;
    }
  }
}

}  // namespace softbody

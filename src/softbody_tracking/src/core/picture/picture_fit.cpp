#include "picture/picture_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "agreement/pose_cost.h"

namespace softbody {
namespace {

// Standard deviation of the logarithm of each channel's gain after white balance: what gray-world leaves on
// the Gehler-Shi set, 6.3 degrees on the mean.
constexpr double kCastDeviation = 0.135;
// Standard deviation of a patch's colour, of 255: noise, compression and vignetting, 2 % of a middle grey.
constexpr double kColorNoise = 2.5;
// Share of the texture's variance that a picture explains at least where the body is: the rest is error of
// its place, light and wear.
constexpr double kExplained = 0.5;
// Contrast, in standard deviations of the noise, below which a picture has no texture for a camera.
constexpr double kWeakest = 0.1;
// Patches within this distance may have the same texture [patches].
constexpr int kTextureReach = 4;
// With fewer patches a correlation has no meaning.
constexpr double kFewestPatches = 8.0;

/// One value of each patch, without its mean and without what light explains.
using Values = Eigen::VectorXd;

/// Orthonormal channels: brightness, and two of hue.
Eigen::Matrix3d opponent() {
  Eigen::Matrix3d axes;
  axes.row(0) = Eigen::RowVector3d(1.0, 1.0, 1.0).normalized();
  axes.row(1) = Eigen::RowVector3d(1.0, 0.0, -1.0).normalized();
  axes.row(2) = Eigen::RowVector3d(1.0, -2.0, 1.0).normalized();
  return axes;
}

/// What is left after a least-squares fit of the columns.
Values without(const Eigen::MatrixXd& columns, const Values& values) {
  return values - columns * columns.colPivHouseholderQr().solve(values);
}

/// Light on a matt surface is about linear in the normal.
Eigen::MatrixXd lightColumns(const std::vector<ColorPatch>& patches) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(patches.size()), 4);
  for (std::size_t i = 0; i < patches.size(); ++i)
    columns.row(static_cast<Eigen::Index>(i)) << 1.0, patches[i].normal.transpose();
  return columns;
}

/// By how much neighbours with the same texture reduce the number of independent patches (Clifford,
/// Richardson and Hemon 1989).
double dependence(const std::vector<ColorPatch>& patches, const Values& a, const Values& b) {
  std::map<std::pair<int, int>, Eigen::Index> at;
  for (std::size_t i = 0; i < patches.size(); ++i)
    at[{patches[i].cell.x, patches[i].cell.y}] = static_cast<Eigen::Index>(i);
  double sum = 1.0;
  for (int dx = 0; dx <= kTextureReach; ++dx) {
    for (int dy = dx == 0 ? 1 : -kTextureReach; dy <= kTextureReach; ++dy) {
      double of_a = 0.0, of_b = 0.0;
      for (const auto& [cell, i] : at) {
        const auto other = at.find({cell.first + dx, cell.second + dy});
        if (other == at.end()) continue;
        of_a += a[i] * a[other->second];
        of_b += b[i] * b[other->second];
      }
      // A lag and its opposite.
      sum += 2.0 * std::max(0.0, of_a / a.squaredNorm()) * std::max(0.0, of_b / b.squaredNorm());
    }
  }
  return sum;
}

/// Sums over the channels.
struct Texture {
  double pictured = 0.0, seen = 0.0;  ///< squares
  double common = 0.0;                ///< products
  double chance = 0.0;  ///< variance of the products if picture and image have nothing in common
};

Texture textureOf(const std::vector<ColorPatch>& patches, const Eigen::MatrixX3d& pictured,
                  const Eigen::MatrixX3d& seen) {
  const Eigen::MatrixXd light = lightColumns(patches);
  Texture texture;
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::MatrixXd columns = light.leftCols(channel == 0 ? 4 : 1);
    const Values a = without(columns, pictured.col(channel)), b = without(columns, seen.col(channel));
    const double aa = a.squaredNorm(), bb = b.squaredNorm();
    texture.pictured += aa;
    texture.seen += bb;
    texture.common += a.dot(b);
    if (aa > 0.0 && bb > 0.0)
      texture.chance += aa * bb * dependence(patches, a, b) / static_cast<double>(patches.size());
  }
  return texture;
}

/// Fisher's transform: its standard deviation is 1 / sqrt(n - 3), whatever the correlation.
double fisher(double correlation) { return std::atanh(std::clamp(correlation, -0.999, 0.999)); }

}  // namespace

PictureFit pictureFit(const std::vector<ColorPatch>& patches) {
  PictureFit fit;
  const auto count = static_cast<Eigen::Index>(patches.size());
  if (static_cast<double>(count) < kFewestPatches) return fit;
  const Eigen::Matrix3d axes = opponent();
  Eigen::MatrixX3d pictured(count, 3), seen(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    pictured.row(i) = (axes * patches[static_cast<std::size_t>(i)].pictured).transpose();
    seen.row(i) = (axes * patches[static_cast<std::size_t>(i)].seen).transpose();
  }
  const Eigen::RowVector3d difference = (seen - pictured).colwise().mean();
  const double noise = kColorNoise / std::exp(seen.col(0).mean() / std::sqrt(3.0));
  fit.cast = difference.tail<2>().norm() / std::hypot(kCastDeviation, noise);
  const Texture texture = textureOf(patches, pictured, seen);
  const double contrast = texture.pictured / (3.0 * static_cast<double>(count));  // variance of a channel
  const double expected = kExplained * contrast / (contrast + noise * noise);
  if (std::sqrt(contrast) < kWeakest * noise || texture.chance <= 0.0) return fit;
  fit.patches = texture.pictured * texture.seen / texture.chance;
  fit.correlation = texture.common / std::sqrt(texture.pictured * texture.seen);
  if (fit.patches < kFewestPatches) return fit;
  const double root = std::sqrt(fit.patches - 3.0);
  fit.shortfall = (fisher(std::sqrt(expected)) - fisher(fit.correlation)) * root;
  const double unexplained = std::max(1e-6, 1.0 - fit.correlation * fit.correlation);
  if (fit.correlation > 0.0) fit.evidence = -fit.patches * std::log(unexplained);
  return fit;
}

double doubtSquared(int poses) { return kDoubt * kDoubt + 2.0 * std::log(std::max(1, poses)); }

bool pictureDisagrees(const PictureFit& fit, int poses) {
  const double limit = doubtSquared(poses);
  const double missing = std::max(0.0, fit.shortfall);
  return fit.cast * fit.cast > limit || missing * missing > limit;
}

bool pictureFits(const PictureFit& fit, int poses) {
  return fit.evidence > doubtSquared(poses) && !pictureDisagrees(fit, poses);
}

}  // namespace softbody

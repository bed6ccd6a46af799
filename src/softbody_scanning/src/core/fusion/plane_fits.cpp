#include "fusion/plane_fits.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace softbody::scanning {
namespace {

constexpr int kRadius_px = 3;
constexpr double kFewestShare = 0.6;  // of a window's pixels, so that a fit is not one-sided

/// Sums over windows. Depth at integer pixels; u and v are relative to the image's middle, against
/// cancellation.
struct WindowSums {
  cv::Mat1d n, u, v, uu, uv, vv, q, uq, vq, qq;
};

cv::Mat1d windowSum(const cv::Mat1d& values) {
  cv::Mat1d sum;
  cv::boxFilter(values, sum, CV_64F, cv::Size(2 * kRadius_px + 1, 2 * kRadius_px + 1), cv::Point(-1, -1),
                false, cv::BORDER_CONSTANT);
  return sum;
}

WindowSums sumWindows(const cv::Mat1f& depth) {
  cv::Mat1d n(depth.size(), 0.0), u(depth.size(), 0.0), v(depth.size(), 0.0), q(depth.size(), 0.0);
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      if (!(depth(row, column) > 0.0f)) continue;
      n(row, column) = 1.0;
      u(row, column) = column - 0.5 * depth.cols;
      v(row, column) = row - 0.5 * depth.rows;
      q(row, column) = 1.0 / depth(row, column);
    }
  }
  return {windowSum(n),        windowSum(u), windowSum(v),        windowSum(u.mul(u)), windowSum(u.mul(v)),
          windowSum(v.mul(v)), windowSum(q), windowSum(u.mul(q)), windowSum(v.mul(q)), windowSum(q.mul(q))};
}

}  // namespace

PlaneFits fitPlanes(const cv::Mat1f& depth) {
  const WindowSums s = sumWindows(depth);
  PlaneFits fits{cv::Mat3f(depth.size(), cv::Vec3f::all(0)), cv::Mat1f(depth.size(), 0.0f)};
  const double fewest = kFewestShare * (2 * kRadius_px + 1) * (2 * kRadius_px + 1);
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      const double n = s.n(row, column);
      if (!(depth(row, column) > 0.0f) || n < fewest) continue;
      const double u = s.u(row, column) / n, v = s.v(row, column) / n, q = s.q(row, column) / n;
      const double uu = s.uu(row, column) / n - u * u, vv = s.vv(row, column) / n - v * v;
      const double uv = s.uv(row, column) / n - u * v, uq = s.uq(row, column) / n - u * q;
      const double vq = s.vq(row, column) / n - v * q, qq = s.qq(row, column) / n - q * q;
      const double determinant = uu * vv - uv * uv;
      if (!(determinant > 0.0)) continue;
      const double a = (vv * uq - uv * vq) / determinant, b = (uu * vq - uv * uq) / determinant;
      const double c = q + a * (column - 0.5 * depth.cols - u) + b * (row - 0.5 * depth.rows - v);
      fits.coefficients(row, column) =
          cv::Vec3f(static_cast<float>(a), static_cast<float>(b), static_cast<float>(c));
      fits.scatter(row, column) = static_cast<float>(std::sqrt(std::max(0.0, qq - a * uq - b * vq)));
    }
  }
  return fits;
}

}  // namespace softbody::scanning

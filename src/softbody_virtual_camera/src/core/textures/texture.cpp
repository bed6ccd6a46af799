#include "softbody_virtual_camera/textures/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "softbody_common/statistics/random.h"

namespace softbody::virtual_camera {
namespace {

using Cell = std::array<std::int64_t, 3>;

std::uint64_t cellHash(const Cell& cell, std::uint64_t seed) {
  std::uint64_t h = seed;
  for (const std::int64_t c : cell) h = hash(h, static_cast<std::uint64_t>(c));
  return h;
}

Cell cellOf(const Eigen::Vector3d& p) {
  return {static_cast<std::int64_t>(std::floor(p.x())), static_cast<std::int64_t>(std::floor(p.y())),
          static_cast<std::int64_t>(std::floor(p.z()))};
}

struct Nearest {
  std::uint64_t id = 0;
  double distance = 1e9;  ///< in cells
};

/// Distance from a point in a unit cell (0..1) to the neighbouring cell on one side, along one axis.
double gap(double within, int side) { return side == 0 ? 0.0 : side < 0 ? within : 1.0 - within; }

/// The nearest random point; each cell of a unit lattice has one.
Nearest nearestPoint(const Eigen::Vector3d& p, std::uint64_t seed) {
  const Cell home = cellOf(p);
  const Eigen::Vector3d within = p - Eigen::Vector3d(home[0], home[1], home[2]);
  Nearest nearest;
  for (const int dx : {0, -1, 1}) {
    for (const int dy : {0, -1, 1}) {
      for (const int dz : {0, -1, 1}) {
        const Eigen::Vector3d gaps(gap(within.x(), dx), gap(within.y(), dy), gap(within.z(), dz));
        if (gaps.squaredNorm() >= nearest.distance * nearest.distance) continue;
        const Cell cell = {home[0] + dx, home[1] + dy, home[2] + dz};
        const std::uint64_t h = cellHash(cell, seed);
        const Eigen::Vector3d point(cell[0] + unit(h), cell[1] + unit(hash(h, 1)),
                                    cell[2] + unit(hash(h, 2)));
        const double distance = (p - point).norm();
        if (distance < nearest.distance) nearest = {h, distance};
      }
    }
  }
  return nearest;
}

/// Smooth value noise in 0..1 with a lattice of unit cells.
double valueNoise(const Eigen::Vector3d& p, std::uint64_t seed) {
  const Cell home = cellOf(p);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    Cell cell = home;
    double weight = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double s = p[k] - static_cast<double>(home[k]), eased = s * s * (3.0 - 2.0 * s);
      const bool upper = (corner >> k) & 1;
      if (upper) ++cell[k];
      weight *= upper ? eased : 1.0 - eased;
    }
    sum += weight * unit(cellHash(cell, seed));
  }
  return sum;
}

/// How deep a point is in a round pore: 0 outside, 1 in its middle.
/// @param p in units of the spacing of pores. @param largest radius, in the same units.
double poreDepth(const Eigen::Vector3d& p, double largest, std::uint64_t seed) {
  constexpr double kSoftRim = 0.06;
  const Nearest pore = nearestPoint(p, seed);
  const double radius = largest * (0.35 + 0.65 * unit(hash(pore.id, 8)));
  return std::clamp((radius - pore.distance) / kSoftRim, 0.0, 1.0);
}

Eigen::Vector3f randomColor(std::uint64_t h) {
  return {static_cast<float>(0.15 + 0.8 * unit(hash(h, 3))),
          static_cast<float>(0.15 + 0.8 * unit(hash(h, 4))),
          static_cast<float>(0.1 + 0.8 * unit(hash(h, 5)))};
}

Eigen::Vector3f clamped(const Eigen::Vector3f& color) { return color.cwiseMax(0.0f).cwiseMin(1.0f); }

}  // namespace

Texture cellTexture(std::uint64_t seed) {
  return [seed](const Eigen::Vector3d& p) -> Eigen::Vector3f {
    const Nearest coarse = nearestPoint(p / 0.018, hash(seed, 1));
    const Nearest middle = nearestPoint(p / 0.008, hash(seed, 2));
    const Nearest fine = nearestPoint(p / 0.004, hash(seed, 3));
    Eigen::Vector3f color = 0.6f * randomColor(coarse.id) + 0.4f * randomColor(middle.id);
    color *= static_cast<float>(0.8 + 0.4 * unit(hash(fine.id, 6)));
    const bool pore = unit(hash(middle.id, 7)) < 0.35 && middle.distance < 0.28;
    return clamped(pore ? Eigen::Vector3f(0.2f * color) : color);
  };
}

Texture spongeTexture(std::uint64_t seed) {
  return [seed](const Eigen::Vector3d& p) -> Eigen::Vector3f {
    const double patches = valueNoise(p / 0.03, hash(seed, 41)),
                 grain = valueNoise(p / 0.0015, hash(seed, 42));
    const double depth =
        std::max(poreDepth(p / 0.012, 0.26, hash(seed, 43)), poreDepth(p / 0.005, 0.24, hash(seed, 44)));
    const double level = (0.9 + 0.16 * (patches - 0.5) + 0.14 * (grain - 0.5)) * (1.0 - 0.72 * depth);
    return clamped(static_cast<float>(level) *
                   Eigen::Vector3f(0.98f, 0.80f, 0.36f - 0.12f * static_cast<float>(depth)));
  };
}

Texture woodTexture(std::uint64_t seed) {
  return [seed](const Eigen::Vector3d& p) -> Eigen::Vector3f {
    const double streaks = valueNoise({p.x() / 0.25, p.y() / 0.012, p.z() / 0.012}, hash(seed, 11));
    const double fine = valueNoise({p.x() / 0.06, p.y() / 0.003, p.z() / 0.003}, hash(seed, 12));
    const float level = static_cast<float>(0.88 + 0.16 * (streaks - 0.5) + 0.06 * (fine - 0.5));
    return clamped(level * Eigen::Vector3f(0.78f, 0.66f, 0.52f));
  };
}

Texture plasterTexture(std::uint64_t seed) {
  return [seed](const Eigen::Vector3d& p) -> Eigen::Vector3f {
    const float level = static_cast<float>(0.97 + 0.06 * (valueNoise(p / 0.05, hash(seed, 21)) - 0.5));
    return clamped(level * Eigen::Vector3f(0.70f, 0.74f, 0.78f));
  };
}

Texture skinTexture() {
  return [](const Eigen::Vector3d& p) -> Eigen::Vector3f {
    const float level = static_cast<float>(0.95 + 0.10 * (valueNoise(p / 0.02, 31) - 0.5));
    return clamped(level * Eigen::Vector3f(0.87f, 0.65f, 0.54f));
  };
}

}  // namespace softbody::virtual_camera

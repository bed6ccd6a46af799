#include "bench/doll_size.h"

#include <cmath>
#include <random>
#include <vector>

namespace softbody::bench {
namespace {

constexpr int kRings = 14, kRingVertices = 9;  // of the cage
constexpr int kPointRings = 50, kRingPoints = 373;
constexpr double kRadius_m = 0.1;

/// On the bumpy ball, at a polar angle and an azimuth.
Eigen::RowVector3d bumpyBall(double polar, double azimuth) {
  const double radius = kRadius_m * (1.0 + 0.25 * std::sin(3.0 * azimuth) * std::pow(std::sin(polar), 3));
  return radius * Eigen::RowVector3d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                     std::cos(polar));
}

TriangleMesh makeCage() {
  const int last = kRings * kRingVertices + 1;
  const auto index = [](int ring, int k) { return 1 + ring * kRingVertices + k % kRingVertices; };
  TriangleMesh cage{Points(last + 1, 3), Triangles()};
  cage.vertices.row(0) = bumpyBall(0.0, 0.0);
  cage.vertices.row(last) = bumpyBall(M_PI, 0.0);
  std::vector<Eigen::RowVector3i> faces;
  for (int k = 0; k < kRingVertices; ++k) {
    for (int ring = 0; ring < kRings; ++ring) {
      cage.vertices.row(index(ring, k)) =
          bumpyBall(M_PI * (ring + 1) / (kRings + 1), 2.0 * M_PI * k / kRingVertices);
      if (ring + 1 == kRings) continue;
      faces.emplace_back(index(ring, k), index(ring + 1, k), index(ring + 1, k + 1));
      faces.emplace_back(index(ring, k), index(ring + 1, k + 1), index(ring, k + 1));
    }
    faces.emplace_back(0, index(0, k), index(0, k + 1));
    faces.emplace_back(last, index(kRings - 1, k + 1), index(kRings - 1, k));
  }
  cage.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f) cage.triangles.row(static_cast<Eigen::Index>(f)) = faces[f];
  return cage;
}

}  // namespace

DollSize makeDollSize() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  DollSize doll{makeCage(), Points(kPointRings * kRingPoints, 3)};
  // Ring by ring, because neighbours mostly follow each other in a mesh file. Depths stay below the cage's
  // facets.
  for (Eigen::Index p = 0; p < doll.points.rows(); ++p) {
    const Eigen::Index ring = p / kRingPoints, k = p % kRingPoints;
    const double depth = 0.78 + 0.12 * uniform(random);
    doll.points.row(p) = depth * bumpyBall(M_PI * (static_cast<double>(ring) + 0.5) / kPointRings,
                                           2.0 * M_PI * static_cast<double>(k) / kRingPoints);
  }
  return doll;
}

}  // namespace softbody::bench

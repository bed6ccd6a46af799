#pragma once

#include <cmath>
#include <cstdint>
#include <map>

#include "softbody_common/rasterizer.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// A box of tets, 200 x 100 x 40 mm, centred at the origin, and its boundary as the visual mesh.
struct BoxBody {
  TetTopology volume;
  MeshTopology surface;
};

inline BoxBody makeBox(int nx = 10, int ny = 5, int nz = 2) {
  static constexpr int kKuhn[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                      {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  const Eigen::Vector3d size(0.2, 0.1, 0.04);
  BoxBody body;
  const auto index = [&](int x, int y, int z) { return (z * (ny + 1) + y) * (nx + 1) + x; };
  body.volume.rest_vertices.resize((nx + 1) * (ny + 1) * (nz + 1), 3);
  for (int z = 0; z <= nz; ++z) {
    for (int y = 0; y <= ny; ++y) {
      for (int x = 0; x <= nx; ++x) {
        const Eigen::Vector3d unit(static_cast<double>(x) / nx, static_cast<double>(y) / ny,
                                   static_cast<double>(z) / nz);
        body.volume.rest_vertices.row(index(x, y, z)) = (unit.array() - 0.5) * size.array();
      }
    }
  }
  body.volume.tets.resize(6 * nx * ny * nz, 4);
  int t = 0;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        for (const auto& tet : kKuhn) {
          for (int k = 0; k < 4; ++k) {
            body.volume.tets(t, k) =
                index(x + (tet[k] & 1), y + ((tet[k] >> 1) & 1), z + ((tet[k] >> 2) & 1));
          }
          if (tetVolumes(body.volume.rest_vertices, body.volume.tets.row(t))[0] < 0.0) {
            std::swap(body.volume.tets(t, 2), body.volume.tets(t, 3));
          }
          ++t;
        }
      }
    }
  }
  body.volume.surface = boundaryTriangles(body.volume.tets);
  body.surface.rest_vertices = body.volume.rest_vertices;
  body.surface.triangles = body.volume.surface;
  body.surface.bodies.assign(static_cast<std::size_t>(body.surface.triangles.rows()), 0);
  return body;
}

/// The box in two pieces, parted at x = 0. Vertices of the plane have copies behind the others, for the
/// right.
inline BoxBody cutBox(const BoxBody& whole) {
  BoxBody body = whole;
  Points& vertices = body.volume.rest_vertices;
  std::map<int, int> copies;
  for (Eigen::Index t = 0; t < whole.volume.tets.rows(); ++t) {
    const Eigen::RowVector4i tet = whole.volume.tets.row(t);
    if (vertices(tet, 0).mean() < 0.0) continue;
    for (int k = 0; k < 4; ++k) {
      if (std::abs(vertices(tet[k], 0)) > 1e-9) continue;
      const int next = static_cast<int>(whole.volume.rest_vertices.rows() + copies.size());
      body.volume.tets(t, k) = copies.emplace(tet[k], next).first->second;
    }
  }
  vertices.conservativeResize(vertices.rows() + static_cast<Eigen::Index>(copies.size()), 3);
  for (const auto& [from, to] : copies) vertices.row(to) = vertices.row(from);
  body.volume.surface = boundaryTriangles(body.volume.tets);
  body.surface.rest_vertices = vertices;
  body.surface.triangles = body.volume.surface;
  body.surface.bodies = triangleBodies(body.surface.triangles, static_cast<int>(vertices.rows()));
  body.surface.cut.clear();
  for (const auto& triangle : body.surface.triangles.rowwise())
    body.surface.cut.push_back(vertices(triangle, 0).cwiseAbs().maxCoeff() < 1e-9);
  body.volume.revision = body.surface.revision = whole.volume.revision + 1;
  return body;
}

/// Pixels of a value-noise texture over the rest surface, rich in corners.
inline std::uint8_t textureAt(const Eigen::Vector3d& rest, std::uint32_t channel) {
  const Eigen::Vector3i cell = (rest / 0.004).array().floor().cast<int>();
  std::uint32_t h = static_cast<std::uint32_t>(cell.x()) * 73856093u ^
                    static_cast<std::uint32_t>(cell.y()) * 19349663u ^
                    static_cast<std::uint32_t>(cell.z()) * 83492791u ^ channel * 2654435761u;
  h ^= h >> 13;
  h *= 0x5bd1e995u;
  h ^= h >> 15;
  return static_cast<std::uint8_t>(60 + h % 180);
}

/// A frame that shows the body's surface at the given vertices before a wall 1.2 m away.
inline RgbdFrame renderFrame(const BoxBody& body, const Points& vertices, Nanoseconds stamp) {
  RgbdFrame frame;
  frame.stamp = stamp;
  frame.camera = {640, 480, 615.0, 615.0, 320.0, 240.0};
  frame.color = cv::Mat3b(480, 640, cv::Vec3b(200, 190, 60));
  frame.depth = cv::Mat1f(480, 640, 1.2f);
  RasterImage image;
  rasterize(frame.camera, vertices, body.surface.triangles, &image);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const int f = image.triangle(v, u);
      if (f < 0) continue;
      const Eigen::Vector3d b = rayWeights(frame.camera, vertices, body.surface.triangles, f, u, v);
      const Eigen::Vector3d rest = b[0] * body.surface.rest_vertices.row(body.surface.triangles(f, 0)) +
                                   b[1] * body.surface.rest_vertices.row(body.surface.triangles(f, 1)) +
                                   b[2] * body.surface.rest_vertices.row(body.surface.triangles(f, 2));
      const std::uint8_t gray = textureAt(rest, 0);
      frame.color(v, u) = cv::Vec3b(gray / 4, gray / 2 + textureAt(rest, 1) / 4, gray);
      frame.depth(v, u) = image.depth(v, u);
    }
  }
  return frame;
}

/// The box half a metre away, top face towards the camera, tilted so that three faces are seen.
inline Eigen::Isometry3d boxPose() {
  return Eigen::Translation3d(0.01, 0.0, 0.5) *
         Eigen::AngleAxisd(0.6, Eigen::Vector3d(1.0, 0.3, 0.1).normalized()) *
         Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
}

}  // namespace softbody

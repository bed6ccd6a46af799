#include "softbody_common/geometry/tet_geometry.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <stdexcept>

namespace softbody {
namespace {

/// Numbers the connected pieces of elements, by union-find over the vertices.
template <typename Elements>
std::vector<std::uint32_t> connectedPieces(const Elements& elements, int vertex_count) {
  std::vector<int> parent(static_cast<std::size_t>(vertex_count));
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&parent](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    for (Eigen::Index k = 1; k < elements.cols(); ++k) parent[find(elements(e, k))] = find(elements(e, 0));
  }
  constexpr auto kUnnumbered = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> numbers(parent.size(), kUnnumbered);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> pieces(static_cast<std::size_t>(elements.rows()));
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    std::uint32_t& number = numbers[find(elements(e, 0))];
    if (number == kUnnumbered) number = count++;
    pieces[e] = number;
  }
  return pieces;
}

constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // outward

/// A face with its vertices in ascending order; `place` is 4 * tet + row of kFaces.
struct TetFace {
  int low, mid, high;
  std::size_t place;
};

/// All faces of all tets, sorted by their lowest vertex (counting sort).
std::vector<TetFace> facesByLowestVertex(const Tets& tets) {
  std::vector<TetFace> faces;
  faces.reserve(4 * static_cast<std::size_t>(tets.rows()));
  std::vector<std::size_t> start(tets.size() > 0 ? static_cast<std::size_t>(tets.maxCoeff()) + 2 : 1, 0);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (const auto& face : kFaces) {
      const int a = tets(t, face[0]), b = tets(t, face[1]), c = tets(t, face[2]);
      const int low = std::min({a, b, c}), high = std::max({a, b, c});
      faces.push_back({low, a + b + c - low - high, high, faces.size()});
      ++start[static_cast<std::size_t>(low) + 1];
    }
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<TetFace> sorted(faces.size());
  for (const TetFace& face : faces) sorted[start[static_cast<std::size_t>(face.low)]++] = face;
  return sorted;
}

/// Whether edges with the same lower vertex are used equally often in both directions.
/// The range holds their higher vertices v: 2 v for an edge to v, 2 v + 1 for an edge from v.
bool asManyUpAsDown(std::vector<int>::iterator begin, std::vector<int>::iterator end) {
  std::sort(begin, end);
  int surplus = 0;
  for (auto e = begin; e != end; ++e) {
    surplus += *e % 2 == 0 ? 1 : -1;
    const bool is_last = e + 1 == end || *e / 2 != *(e + 1) / 2;
    if (is_last && surplus != 0) return false;
  }
  return true;
}

}  // namespace

Eigen::VectorXd tetVolumes(const Points& vertices, const Tets& tets) {
  Eigen::VectorXd volumes(tets.rows());
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.row(k) = vertices.row(tets(t, k + 1)) - vertices.row(tets(t, 0));
    volumes[t] = edges.determinant() / 6.0;
  }
  return volumes;
}

double enclosedVolume(const Points& vertices, const Triangles& triangles) {
  double volume = 0.0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::Vector3d a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                          c = vertices.row(triangles(f, 2));
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

Triangles boundaryTriangles(const Tets& tets) {
  const std::vector<TetFace> faces = facesByLowestVertex(tets);
  std::vector<bool> inner(4 * static_cast<std::size_t>(tets.rows()), false);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t g = f + 1; g < faces.size() && faces[g].low == faces[f].low; ++g) {
      if (faces[g].mid == faces[f].mid && faces[g].high == faces[f].high)
        inner[faces[f].place] = inner[faces[g].place] = true;
    }
  }
  Triangles triangles(std::count(inner.begin(), inner.end(), false), 3);
  Eigen::Index row = 0;
  for (std::size_t place = 0; place < inner.size(); ++place) {
    if (inner[place]) continue;
    const auto t = static_cast<Eigen::Index>(place / 4);
    const int* face = kFaces[place % 4];
    triangles.row(row++) << tets(t, face[0]), tets(t, face[1]), tets(t, face[2]);
  }
  return triangles;
}

bool isClosed(const Triangles& triangles) {
  std::vector<std::size_t> start(
      triangles.size() > 0 ? static_cast<std::size_t>(triangles.maxCoeff()) + 2 : 1, 0);
  const auto forEachEdge = [&](const auto& visit) {
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      for (int k = 0; k < 3; ++k) visit(triangles(f, k), triangles(f, (k + 1) % 3));
    }
  };
  forEachEdge([&](int a, int b) { ++start[static_cast<std::size_t>(std::min(a, b)) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> ends(static_cast<std::size_t>(triangles.size()));
  std::vector<std::size_t> next = start;
  forEachEdge([&](int a, int b) {
    ends[next[static_cast<std::size_t>(std::min(a, b))]++] = 2 * std::max(a, b) + (a < b ? 0 : 1);
  });
  for (std::size_t v = 0; v + 1 < start.size(); ++v) {
    const auto at = [&](std::size_t i) { return ends.begin() + static_cast<std::ptrdiff_t>(i); };
    if (!asManyUpAsDown(at(start[v]), at(start[v + 1]))) return false;
  }
  return true;
}

std::vector<std::uint32_t> tetPieces(const Tets& tets, int vertex_count) {
  return connectedPieces(tets, vertex_count);
}

std::vector<std::uint32_t> trianglePieces(const Triangles& triangles, int vertex_count) {
  return connectedPieces(triangles, vertex_count);
}

std::vector<std::vector<int>> verticesOfPieces(const Tets& tets, Eigen::Index vertex_count) {
  const auto count = static_cast<int>(vertex_count);
  const std::vector<std::uint32_t> piece_of = vertexPieces(tets, tetPieces(tets, count), vertex_count);
  std::vector<std::vector<int>> pieces;
  for (int v = 0; v < count; ++v) {
    if (piece_of[v] >= pieces.size()) pieces.resize(piece_of[v] + 1);
    pieces[piece_of[v]].push_back(v);
  }
  return pieces;
}

Points vertexNormals(const Points& vertices, const Triangles& triangles) {
  Points normals = Points::Zero(vertices.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::Vector3d a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                          c = vertices.row(triangles(f, 2));
    const Eigen::RowVector3d doubled_area = (b - a).cross(c - a).transpose();
    for (int k = 0; k < 3; ++k) normals.row(triangles(f, k)) += doubled_area;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) normals.row(v).normalize();
  return normals;
}

Eigen::Vector4d barycentricCoordinates(const Eigen::Vector3d& point, const Points& vertices,
                                       const Eigen::Vector4i& tet) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = (vertices.row(tet[k + 1]) - vertices.row(tet[0])).transpose();
  if (edges.determinant() == 0.0)
    throw std::invalid_argument("barycentric coordinates of a tet without volume");
  const Eigen::Vector3d tail = edges.inverse() * (point - vertices.row(tet[0]).transpose());
  return {1.0 - tail.sum(), tail[0], tail[1], tail[2]};
}

double meanEdgeLength(const Points& vertices, const Tets& tets) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(static_cast<std::size_t>(6 * tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) edges.push_back(std::minmax(tets(t, i), tets(t, j)));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  double sum = 0.0;
  for (const auto& [a, b] : edges) sum += (vertices.row(a) - vertices.row(b)).norm();
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

Eigen::Vector3d nearestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  // Ericson, Real-Time Collision Detection, 5.1.5.
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Eigen::Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const Eigen::Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double scale = 1.0 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

Eigen::Vector3d cornerWeights(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c) {
  const Eigen::Vector3d areas((b - p).cross(c - p).norm(), (c - p).cross(a - p).norm(),
                              (a - p).cross(b - p).norm());
  return areas.sum() > 0.0 ? Eigen::Vector3d(areas / areas.sum()) : Eigen::Vector3d::Constant(1.0 / 3.0);
}

}  // namespace softbody

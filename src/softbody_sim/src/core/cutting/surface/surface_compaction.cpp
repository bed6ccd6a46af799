#include "cutting/surface/surface_compaction.h"

#include <utility>

namespace softbody {
namespace {

std::vector<std::uint32_t> numberPieces(std::size_t triangle_count, const std::vector<int>& mates) {
  constexpr auto kUnknown = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> pieces(triangle_count, kUnknown);
  std::uint32_t count = 0;
  std::vector<int> open;
  for (std::size_t first = 0; first < triangle_count; ++first) {
    if (pieces[first] != kUnknown) continue;
    pieces[first] = count;
    open.push_back(static_cast<int>(first));
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int neighbour = mates[3 * t + k] / 3;
        if (pieces[neighbour] != kUnknown) continue;
        pieces[neighbour] = count;
        open.push_back(neighbour);
      }
    }
    ++count;
  }
  return pieces;
}

/// Numbers the used entries in order; -1 for the others. @return the number of used entries.
template <class Used>
int numberUsed(std::size_t count, const Used& used, std::vector<int>* numbers) {
  int next = 0;
  numbers->resize(count);
  for (std::size_t k = 0; k < count; ++k) (*numbers)[k] = used(k) ? next++ : -1;
  return next;
}

class Compaction {
 public:
  Compaction(const MeshTopology& before, const SplitSurface& surface, const StitchedSurface& stitched)
      : before_(before), surface_(surface), stitched_(stitched) {}

  SurfaceCut run();

 private:
  void number();
  void writeVertices();
  void writeTriangles();
  void writeTexture();

  const MeshTopology& before_;
  const SplitSurface& surface_;
  const StitchedSurface& stitched_;
  std::vector<int> vertices_, triangles_;  ///< new numbers
  int vertex_count_ = 0, triangle_count_ = 0;
  SurfaceCut cut_;
};

SurfaceCut Compaction::run() {
  cut_.outcome = CutOutcome::kCut;
  cut_.mesh.revision = before_.revision + 1;
  number();
  writeVertices();
  writeTriangles();
  writeTexture();
  return std::move(cut_);
}

void Compaction::number() {
  const TriangleList& triangles = stitched_.triangles;
  triangle_count_ = numberUsed(
      triangles.size(), [&](std::size_t t) { return triangles[t][0] >= 0; }, &triangles_);
  std::vector<char> used(stitched_.vertices.size(), 0);
  for (const auto& triangle : triangles) {
    if (triangle[0] < 0) continue;
    for (const int v : triangle) used[v] = 1;
  }
  vertex_count_ = numberUsed(
      used.size(), [&](std::size_t v) { return used[v] != 0; }, &vertices_);
}

void Compaction::writeVertices() {
  MeshTopology& mesh = cut_.mesh;
  mesh.rest_vertices.resize(vertex_count_, 3);
  mesh.vertex_parents.resize(static_cast<std::size_t>(vertex_count_));
  cut_.vertex_sources.resize(static_cast<std::size_t>(vertex_count_));
  for (std::size_t v = 0; v < stitched_.vertices.size(); ++v) {
    const int row = vertices_[v], source = stitched_.copied_from[v];
    if (row < 0) continue;
    const bool own = source >= 0 && source < surface_.own_vertices;
    mesh.rest_vertices.row(row) = own ? stitched_.vertices[v] : rounded(stitched_.vertices[v]);
    mesh.vertex_parents[row] = own ? before_.vertex_parents[source] : -1;
    cut_.vertex_sources[row] = own ? source : -1;
  }
}

void Compaction::writeTriangles() {
  MeshTopology& mesh = cut_.mesh;
  const auto count = static_cast<std::size_t>(triangle_count_);
  mesh.triangles.resize(triangle_count_, 3);
  mesh.cut.resize(count);
  cut_.on_new_wall.resize(count);
  ManifoldMesh& manifold = cut_.manifold;
  manifold.triangles.resize(count);
  manifold.mates.resize(3 * count);
  for (std::size_t t = 0; t < stitched_.triangles.size(); ++t) {
    const int row = triangles_[t];
    if (row < 0) continue;
    for (int k = 0; k < 3; ++k) {
      const int mate = stitched_.mates[3 * t + static_cast<std::size_t>(k)];
      mesh.triangles(row, k) = manifold.triangles[row][k] = vertices_[stitched_.triangles[t][k]];
      manifold.mates[3 * row + k] = 3 * triangles_[mate / 3] + mate % 3;
    }
    const bool of_surface = t < surface_.triangles.size();
    cut_.on_new_wall[row] = !of_surface;
    mesh.cut[row] = !of_surface || before_.cut[surface_.sources[t]];
  }
  mesh.triangle_pieces = numberPieces(manifold.triangles.size(), manifold.mates);
}

void Compaction::writeTexture() {
  Points& texture = cut_.mesh.texture_coordinates;
  texture.setZero(surface_.texture.empty() ? 0 : 3 * triangle_count_, 3);
  for (std::size_t h = 0; h < surface_.texture.size(); ++h) {
    const int row = triangles_[h / 3];
    if (row >= 0) texture.row(3 * row + static_cast<int>(h % 3)).head<2>() = surface_.texture[h];
  }
}

}  // namespace

SurfaceCut compacted(const MeshTopology& before, const SplitSurface& surface,
                     const StitchedSurface& stitched) {
  return Compaction(before, surface, stitched).run();
}

}  // namespace softbody

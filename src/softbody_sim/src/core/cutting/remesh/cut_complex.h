#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A list of at most N numbers; further ones are dropped.
template <std::size_t N>
struct FewInts {
  std::array<int, N> values{};
  std::size_t count = 0;

  void add(int value) {
    if (count < N) values[count++] = value;
  }
  bool contains(int value) const { return std::find(begin(), end(), value) != end(); }
  std::size_t size() const { return count; }
  bool empty() const { return count == 0; }
  int operator[](std::size_t k) const { return values[k]; }
  const int* begin() const { return values.data(); }
  const int* end() const { return values.data() + count; }
};

/// The two kinds of triangles of a complex.
enum class Sheet : unsigned char {
  kSkin,  ///< the surface of the body near the cut, not yet opened
  kFill   ///< the faces of the cut, once
};

/// What an edge of a complex is, besides an edge: vertices on lines move along them only.
enum class Line : unsigned char {
  kNone,
  kBorder,  ///< a seam of the texture, or an end of the fill inside the body
  kCurve    ///< where the fill meets the skin
};

/// A triangle of a complex. Its edge k runs from corner k to corner k + 1.
struct ComplexTriangle {
  std::array<int, 3> corners{-1, -1, -1};  ///< corners -1: removed
  Sheet sheet = Sheet::kSkin;
  std::array<Line, 3> lines{};           ///< per edge
  std::array<int, 3> curve{-1, -1, -1};  ///< per edge, as SplitSurface::curve; of the fill: the half-edge of
                                         ///< the split surface, where both sheets do not share its vertices
  std::array<Eigen::Vector2d, 3> texture{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                         Eigen::Vector2d::Zero()};
  int source = -1;                         ///< of the skin: the triangle of the mesh that it comes from
  int place = -1;                          ///< of the skin: its number in the split surface; -1: new
  bool is_fixed = false;                   ///< it must stay
  double shape = 0.0;                      ///< sine of the least angle
  std::vector<Eigen::Vector3d> samples{};  ///< places of removed vertices and edges, nearest to it [m]

  bool used() const { return corners[0] >= 0; }
  bool onLine(int k) const { return lines[k] != Line::kNone; }
  /// The position of a vertex among the corners; -1: it is none of them.
  int cornerOf(int vertex) const;
  /// The corner that is neither of two others.
  int thirdCorner(int a, int b) const;
  /// The edge between two corners, in either direction.
  int edgeBetween(int a, int b) const;
};

/// A vertex of a complex. On the curve it belongs to both sheets.
struct ComplexVertex {
  Eigen::Vector3d position;      ///< at rest [m]
  int skin = -1;                 ///< number in the split surface; -1: new, or of the fill only
  bool is_new = true;            ///< made by remeshing
  bool is_complete = true;       ///< all of its triangles are in the complex
  bool may_leave = true;         ///< it may be removed or replaced by a new vertex
  std::vector<int> triangles{};  ///< around it
};

constexpr std::array<Sheet, 2> kSheets{Sheet::kSkin, Sheet::kFill};

/// The skin near a cut and the fill, joined along the curve: there three triangles meet at an edge.
struct CutComplex {
  std::vector<ComplexVertex> vertices;
  std::vector<ComplexTriangle> triangles;
  /// Places of removed vertices on lines, by the ends of their edge of the line, the smaller one first.
  std::map<std::array<int, 2>, std::vector<Eigen::Vector3d>> line_samples;

  const Eigen::Vector3d& at(int vertex) const { return vertices[vertex].position; }
  /// Triangles of a sheet that contain both vertices: two, or one at the border of the fill.
  FewInts<4> trianglesAt(int a, int b, Sheet sheet) const;
  bool adjacent(int a, int b, Sheet sheet) const;
  bool hasSheet(int vertex, Sheet sheet) const;
  /// The other ends of the lines at a vertex. @param least kCurve: only of the curve.
  FewInts<4> lineEnds(int vertex, Sheet sheet, Line least = Line::kBorder) const;
  /// Twice the area times the normal.
  Eigen::Vector3d normalOf(const ComplexTriangle& triangle) const;
};

/// Sine of the least angle of a triangle; 0 if it has no area.
double sineOfLeastAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace softbody

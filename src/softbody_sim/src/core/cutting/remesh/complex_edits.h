#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "cutting/remesh/cut_complex.h"

/// Edits of a complex: flip, collapse, slide, move, cut off, split (Botsch and Kobbelt 2004). Each is first
/// described, then judged, then made.
namespace softbody {

/// How a vertex may leave its place.
struct Freedom {
  enum class Kind : unsigned char { kNone, kAlongLine, kAnywhere } kind = Kind::kNone;
  std::array<int, 2> ends{-1, -1};  ///< its neighbours on the line

  bool towards(int neighbour) const {
    return kind == Kind::kAnywhere ||
           (kind == Kind::kAlongLine && (neighbour == ends[0] || neighbour == ends[1]));
  }
};

/// A vertex on one line may move along it, one on several lines not at all.
Freedom freedomOf(const CutComplex& complex, int vertex);

/// An edit that replaces triangles by others, and removes at most one vertex.
struct ComplexEdit {
  struct Added {
    std::array<int, 3> corners;
    int parent;  ///< the removed triangle that it inherits from
  };
  /// A removed triangle in which the target lies; or both triangles of a flip.
  struct Carrier {
    int triangle;
    Eigen::Vector3d weights;  ///< barycentric coordinates of the target
  };

  std::vector<int> removed;
  std::vector<Added> added;
  std::vector<Carrier> carriers;
  int gone = -1;             ///< vertex that the edit removes
  int target = -1;           ///< vertex that takes its place; the number of vertices: a new one
  Eigen::Vector3d position;  ///< of the new vertex
  std::vector<std::array<int, 2>> old_lines;  ///< edges of a line that the edit removes
  std::vector<std::array<int, 2>> new_lines;  ///< edges that it adds in their place
  /// Of a flip: the old edge and the new one.
  std::optional<std::array<int, 4>> flipped;
  std::optional<std::array<int, 2>> split;  ///< the edge on which the new vertex lies
};

/// Each of these describes an edit, if it is possible. Whether the result is a complex of the same kind is
/// not tested yet.

/// Replaces edge k of a triangle by the other diagonal of its two triangles.
bool describeFlip(const CutComplex& complex, int triangle, int k, ComplexEdit* edit);
/// Merges a vertex into a neighbour. @param freedom of the vertex.
bool describeCollapse(const CutComplex& complex, int vertex, const Freedom& freedom, int neighbour,
                      ComplexEdit* edit);
/// Moves a vertex by a share of the way to a neighbour. @param freedom of the vertex.
bool describeSlide(const CutComplex& complex, int vertex, const Freedom& freedom, int neighbour, double share,
                   ComplexEdit* edit);
/// Moves a vertex that is on no line to the point of its triangles nearest to a place.
bool describeMove(const CutComplex& complex, int vertex, const Eigen::Vector3d& place, ComplexEdit* edit);
/// Splits edge k of a triangle, part of a line, at the foot of the third corner, and merges this corner,
/// which is on no line, into the foot.
bool describeCutOff(const CutComplex& complex, int triangle, int k, ComplexEdit* edit);
/// Splits edge k of a triangle in its middle.
bool describeSplit(const CutComplex& complex, int triangle, int k, ComplexEdit* edit);

/// Positions of vertices after an edit.
class PlacesAfter {
 public:
  /// Keeps references to both.
  PlacesAfter(const CutComplex& complex, const ComplexEdit& edit) : complex_(complex), edit_(edit) {}

  const Eigen::Vector3d& operator()(int vertex) const {
    return vertex == static_cast<int>(complex_.vertices.size()) ? edit_.position : complex_.at(vertex);
  }

 private:
  const CutComplex& complex_;
  const ComplexEdit& edit_;
};

}  // namespace softbody

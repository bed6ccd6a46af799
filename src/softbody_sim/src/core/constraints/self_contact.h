#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "constraints/box_grid.h"
#include "constraints/clearance.h"
#include "constraints/contact_detection.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Finds where the body touches itself: a point of the surface at a triangle of another piece, or of another
/// part of its own piece. Both are material points, so a contact moves with the body.
class SelfContact {
 public:
  struct Options {
    double reach_m = 0.0;    ///< larger distances are no contact
    double largest_m = 0.0;  ///< depth that pushes; a point that starts deeper comes out over several steps
    double deepest_m = 0.0;  ///< a point that starts deeper is not pushed
    double friction = 0.0;   ///< coefficient
  };

  SelfContact(const TetTopology& topology, const Options& options);

  /// Forgets the shape that was measured last.
  void restart() { clearance_ = {}; }

  /// Begins a step at the vertices `before`. @param points the same in each call.
  void start(const std::vector<ContactPoint>& points, const Points& before);

  /// Whether parts may come near each other between two shapes. Fast. @param before, now #V by 3 [m].
  bool mayTouch(const Points& before, const Points& now);

  /// Appends the contacts of the shapes of the last mayTouch, at most one a point, sorted by point. A point
  /// that was outside touches the triangle that its path meets first, relative to the moving triangle. @param
  /// points the same in each call.
  void find(const std::vector<ContactPoint>& points, const Points& before, const Points& now,
            std::vector<Contact>* contacts);

 private:
  using Box = Eigen::AlignedBox3d;

  /// A contact point on its way through a step.
  struct Path {
    std::size_t point;
    Eigen::Vector3d start, end;
  };
  /// What a point touches.
  struct Meeting {
    int triangle = -1;
    Eigen::Vector3d weights;  ///< barycentric, on the triangle
    double distance = 0.0;    ///< at the end of the step, negative inside [m]
  };
  struct Meetings {
    Meeting crossed, nearest;
    double time = 0.0;                                             ///< of the crossing, 0 to 1
    double surface_distance = std::numeric_limits<double>::max();  ///< of any triangle [m]
    bool is_inside = false;                                        ///< by that triangle
  };

  void sortPoints(const std::vector<ContactPoint>& points);
  void collectTriangles(const Points& before, const Points& now);
  bool isNear(std::size_t piece, const Box& box) const;
  void setNeighbors(std::size_t point, const std::vector<std::vector<int>>& around);
  void measureClearance(const std::vector<ContactPoint>& points, const Points& x);
  bool isNeighbor(std::size_t point, int triangle) const;
  bool isOfOtherPiece(std::size_t point, int triangle) const;
  bool faces(std::size_t point, int triangle) const;
  void meet(const Path& path, int triangle, bool is_other_piece, const Points& before, const Points& now,
            Meetings* best) const;
  Meeting choose(const Meetings& meetings) const;
  Contact contactOf(const Path& path, const Meeting& meeting, const Points& before) const;

  const TetTopology* topology_;
  Options options_;
  std::vector<std::size_t> piece_of_vertex_;
  std::vector<int> tet_of_triangle_;
  std::vector<Box> piece_boxes_;  ///< over the step
  std::vector<std::size_t> piece_of_point_;
  std::vector<std::vector<int>> triangles_of_point_;
  std::vector<std::vector<int>> neighbors_of_point_;  ///< triangles within an edge of those, sorted
  Clearance clearance_;                               ///< of parts of one piece
  double at_start_m_ = 0.0;                           ///< the same, at the start of the step
  bool parts_near_ = false;                           ///< parts of one piece, in this step
  std::vector<int> triangles_;                        ///< near another part
  std::vector<Box> triangle_boxes_;
  Points normals_before_, normals_;  ///< of all triangles, outward
  BoxGrid grid_;
};

}  // namespace softbody

#pragma once

#include <string>
#include <string_view>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The argument with which prepare_model fills one surface: FillRequest on stdin, tets on stdout.
constexpr char kFillArgument[] = "--fill-surface";

/// A closed surface to be filled with tets by TetGen.
struct FillRequest {
  TriangleMesh surface;
  double largest_volume = 0.0;  ///< of a tet [m^3]
  bool keep_surface = false;    ///< the boundary keeps the triangles of the surface
};

/// Both ways between two processes of one machine. @throw std::invalid_argument if the bytes are incomplete.
std::string toBytes(const FillRequest& request);
FillRequest fillRequest(std::string_view bytes);
std::string toBytes(const TetMesh& mesh);
TetMesh tetMesh(std::string_view bytes);

}  // namespace softbody

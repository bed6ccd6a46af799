#pragma once

#include <map>
#include <string>
#include <vector>

#include "softbody_common/files/text_reader.h"
#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// A corner of a polygon.
struct Corner {
  int vertex = 0;
  int texture = -1;  ///< index of a texture coordinate; out of range: none
};

/// What a surface file holds, polygon by polygon.
struct PolygonSoup {
  struct Face {
    std::size_t end_corner;  ///< its corners begin where those of the face before end
    int material;
    int place;  ///< line or number, for messages
  };
  std::vector<Eigen::RowVector3d> vertices;
  std::map<int, std::string> bad_vertices;  ///< not finite: index, and what to say if a face uses it
  std::vector<Eigen::RowVector3d> texture;  ///< need not be finite
  std::vector<Corner> corners;
  std::vector<Face> faces;

  void addVertex(const Eigen::RowVector3d& position, const std::string& complaint);
  /// The vertex from a field on.
  void addVertex(const TextReader& reader, std::size_t first_field);
  void addFace(const std::vector<Corner>& face, int material, int place);
};

/// The triangles, without faces of less than three different corners. @param place of faces in messages, e.g.
/// "a.obj:" before a line.
/// @throw std::invalid_argument if a face uses a missing vertex or one that is not finite.
SurfaceFile triangulated(const PolygonSoup& soup, const std::string& path, const std::string& place,
                         Warnings* warnings);

}  // namespace softbody

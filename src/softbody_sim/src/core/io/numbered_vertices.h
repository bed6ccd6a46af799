#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "softbody_common/files/text_reader.h"
#include "softbody_common/geometry/types.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// Vertices by the ids of a file, which need not be consecutive, and tets that refer to those ids.
class NumberedVertices {
 public:
  /// Reads `count` lines "id x y z". The ids must differ.
  void readVertices(TextReader& reader, int count);

  /// Adds the vertex whose coordinates start at a field of the reader's line.
  void addVertex(const TextReader& reader, int id, std::size_t first_field);

  /// Adds the tet whose ids start at a field of the reader's line. @param nodes 4, or 10 of a quadratic tet.
  void addTet(const TextReader& reader, std::size_t first_field, int nodes = 4);

  /// @param path for the warning about quadratic tets.
  TetMesh mesh(const std::string& path, Warnings* warnings) const;

 private:
  std::unordered_map<int, int> index_of_id_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<Eigen::RowVector4i> tets_;
  int quadratic_ = 0;
};

}  // namespace softbody

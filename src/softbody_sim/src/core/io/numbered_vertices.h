#pragma once

#include <unordered_map>
#include <vector>

#include "io/text_reader.h"

namespace softbody {

/// Vertices by the ids of a file, which need not be consecutive, and tets that refer to those ids.
class NumberedVertices {
 public:
  /// Reads `count` lines "id x y z". The ids must differ.
  void readVertices(TextReader& reader, int count);

  /// Adds the tet whose four ids start at a field of the reader's line.
  void addTet(const TextReader& reader, std::size_t first_field);

  TetMesh mesh() const;

 private:
  std::unordered_map<int, int> index_of_id_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<Eigen::RowVector4i> tets_;
};

}  // namespace softbody

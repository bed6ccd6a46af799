#include "io/msh_file.h"

#include <fmt/format.h>

#include "io/numbered_vertices.h"

namespace softbody {
namespace {

constexpr int kGmshTet = 4, kGmshQuadraticTet = 11;

class MshReader {
 public:
  explicit MshReader(const std::string& path) : reader_(path) {}

  TetMesh read(Warnings* warnings) {
    bool has_vertices = false, has_elements = false;
    while (reader_.next()) {
      const std::string section = reader_.keyword();
      if (section == "$meshformat") readFormat();
      if (section == "$nod" || section == "$nodes") {
        has_vertices = true;
        reader_.require("the number of vertices");
        version_ < 4.0 ? mesh_.readVertices(reader_, reader_.count(0)) : readVertexBlocks();
      }
      if (section == "$elm") version_ = 1.0;
      if (section == "$elm" || section == "$elements") {
        has_elements = true;
        reader_.require("the number of elements");
        version_ < 4.0 ? readElements(reader_.count(0)) : readElementBlocks();
      }
    }
    if (!has_vertices) reader_.fail("the file ends without a $Nodes or $NOD section");
    if (!has_elements) reader_.fail("the file ends without an $Elements or $ELM section");
    if (skipped_ > 0)
      warnings->push_back(
          fmt::format("{}: {} elements other than tets were skipped", reader_.path(), skipped_));
    return mesh_.mesh(reader_.path(), warnings);
  }

 private:
  void readFormat() {
    reader_.require("the format's version");
    version_ = reader_.number(0);
    const std::string advice =
        fmt::format("convert it: gmsh {} -0 -format msh22 -o ascii.msh", reader_.path());
    if (!((version_ >= 1.0 && version_ < 3.0) || version_ == 4.1))
      reader_.fail(
          fmt::format("MSH version {} is not supported; supported: 1, 2 and 4.1; {}", version_, advice));
    if (reader_.integer(1) != 0) reader_.fail("binary MSH files are not supported; " + advice);
  }

  /// Blocks of version 4.1: "dimension tag parametric count", then the ids, then the coordinates.
  void readVertexBlocks() {
    for (int blocks = reader_.count(0); blocks > 0; --blocks) {
      reader_.require("a block of vertices");
      std::vector<int> ids(static_cast<std::size_t>(reader_.count(3)));
      for (int& id : ids) {
        reader_.require("a vertex id");
        id = reader_.integer(0);
      }
      for (const int id : ids) {
        reader_.require(fmt::format("vertex {}", id));
        mesh_.addVertex(reader_, id, 0);
      }
    }
  }

  /// Blocks of version 4.1: "dimension tag type count", then "id vertex-ids...".
  void readElementBlocks() {
    for (int blocks = reader_.count(0); blocks > 0; --blocks) {
      reader_.require("a block of elements");
      const int type = reader_.integer(2);
      for (int count = reader_.count(3); count > 0; --count) {
        reader_.require("an element");
        addElement(type, 1);
      }
    }
  }

  /// Version 1: "id type physical elementary count vertex-ids...", version 2: "id type number-of-tags tags...
  /// vertex-ids...".
  void readElements(int count) {
    for (int e = 0; e < count; ++e) {
      reader_.require(fmt::format("element {} of {}", e + 1, count));
      const int tags = version_ < 2.0 ? 2 : reader_.integer(2);
      if (tags < 0) reader_.fail(fmt::format("{} tags", tags));
      addElement(reader_.integer(1), 3 + static_cast<std::size_t>(tags));
    }
  }

  void addElement(int type, std::size_t first_field) {
    if (type == kGmshTet || type == kGmshQuadraticTet)
      mesh_.addTet(reader_, first_field, type == kGmshTet ? 4 : 10);
    else
      ++skipped_;
  }

  TextReader reader_;
  NumberedVertices mesh_;
  double version_ = 2.0;
  int skipped_ = 0;
};

}  // namespace

TetMesh readMsh(const std::string& path, Warnings* warnings) { return MshReader(path).read(warnings); }

}  // namespace softbody

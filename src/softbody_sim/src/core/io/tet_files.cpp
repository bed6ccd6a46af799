#include "softbody_sim/io/tet_files.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "io/msh_file.h"
#include "io/tet_repair.h"
#include "io/tetgen_file.h"
#include "io/veg_file.h"
#include "io/vtu_file.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

TetMesh readTetsByExtension(const std::string& path, Warnings* warnings) {
  const std::string extension = extensionOf(path);
  if (extension == "vtu") return parseVtu(path, readTextFile(path), warnings);
  if (extension == "msh") return readMsh(path, warnings);
  if (extension == "veg") return readVeg(path, warnings);
  if (extension == "node" || extension == "ele") return readTetGen(path, warnings);
  if (extension == "tet") return readTet(path, warnings);
  throw std::invalid_argument(
      fmt::format("{}: '.{}' is not a tet mesh format; supported: .vtu, .msh, .node and .ele, .veg, .tet; "
                  "convert a mesh of tets with: "
                  "meshio convert --ascii {} mesh.vtu",
                  path, extension, path));
}

}  // namespace

TetMesh readTetFile(const std::string& path, Warnings* warnings) {
  return repairTets(readTetsByExtension(path, warnings), path, warnings);
}

std::string vtuText(const TetMesh& mesh) {
  std::ostringstream stream;
  const auto array = [&stream](const char* attributes, Eigen::Index rows, const auto& row) {
    stream << fmt::format("<DataArray {} format=\"ascii\">\n", attributes);
    for (Eigen::Index r = 0; r < rows; ++r) stream << row(r) << '\n';
    stream << "</DataArray>\n";
  };
  stream << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
            "byte_order=\"LittleEndian\">\n"
         << fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
                        mesh.vertices.rows(), mesh.tets.rows());
  array(R"(type="Float64" NumberOfComponents="3")", mesh.vertices.rows(), [&mesh](Eigen::Index v) {
    return fmt::format("{:.17g} {:.17g} {:.17g}", mesh.vertices(v, 0), mesh.vertices(v, 1),
                       mesh.vertices(v, 2));
  });
  stream << "</Points>\n<Cells>\n";
  array(R"(type="Int32" Name="connectivity")", mesh.tets.rows(), [&mesh](Eigen::Index t) {
    return fmt::format("{} {} {} {}", mesh.tets(t, 0), mesh.tets(t, 1), mesh.tets(t, 2), mesh.tets(t, 3));
  });
  array(R"(type="Int32" Name="offsets")", mesh.tets.rows(),
        [](Eigen::Index t) { return fmt::format("{}", 4 * (t + 1)); });
  array(R"(type="UInt8" Name="types")", mesh.tets.rows(),
        [](Eigen::Index) { return fmt::format("{}", kVtkTetra); });
  stream << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return stream.str();
}

void writeVtu(const std::string& path, const TetMesh& mesh) { writeBytes(path, vtuText(mesh)); }

}  // namespace softbody

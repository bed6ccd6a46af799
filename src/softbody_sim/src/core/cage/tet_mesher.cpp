#include "cage/tet_mesher.h"

#define TETLIBRARY
#include <tetgen.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "cage/child_process.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kRadiusEdgeRatio = 1.4;  ///< bound for the refinement
constexpr double kSmallestAngle = 15.0;   ///< dihedral angle, bound for the refinement [degrees]
constexpr double kLargestVolume = 2.0;    ///< of a tet, in regular tets of the surface's edge length

/// TetGen frees its input with delete[].
void setFacet(const Eigen::RowVector3i& corners, tetgenio::facet* facet) {
  tetgenio::init(facet);
  facet->numberofpolygons = 1;
  facet->polygonlist = new tetgenio::polygon[1];
  tetgenio::init(facet->polygonlist);
  facet->polygonlist->numberofvertices = 3;
  facet->polygonlist->vertexlist = new int[3];
  std::copy_n(corners.data(), 3, facet->polygonlist->vertexlist);
}

void setSurface(const TriangleMesh& surface, tetgenio* input) {
  input->firstnumber = 0;
  input->numberofpoints = static_cast<int>(surface.vertices.rows());
  input->pointlist = new double[static_cast<std::size_t>(surface.vertices.size())];
  std::copy_n(surface.vertices.data(), surface.vertices.size(), input->pointlist);
  input->numberoffacets = static_cast<int>(surface.triangles.rows());
  input->facetlist = new tetgenio::facet[static_cast<std::size_t>(surface.triangles.rows())];
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    setFacet(surface.triangles.row(f), &input->facetlist[f]);
  }
}

TetMesh toTetMesh(const tetgenio& output) {
  TetMesh mesh{Points(output.numberofpoints, 3), Tets(output.numberoftetrahedra, 4)};
  std::copy_n(output.pointlist, mesh.vertices.size(), mesh.vertices.data());
  std::copy_n(output.tetrahedronlist, mesh.tets.size(), mesh.tets.data());
  const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    if (volumes[t] < 0.0) std::swap(mesh.tets(t, 2), mesh.tets(t, 3));
  }
  return mesh;
}

std::string toBytes(const TetMesh& mesh) {
  const Eigen::Index counts[2] = {mesh.vertices.rows(), mesh.tets.rows()};
  std::string bytes(reinterpret_cast<const char*>(counts), sizeof(counts));
  bytes.append(reinterpret_cast<const char*>(mesh.vertices.data()), sizeof(double) * mesh.vertices.size());
  bytes.append(reinterpret_cast<const char*>(mesh.tets.data()), sizeof(int) * mesh.tets.size());
  return bytes;
}

TetMesh fromBytes(const std::string& bytes) {
  Eigen::Index counts[2];
  std::memcpy(counts, bytes.data(), sizeof(counts));
  TetMesh mesh{Points(counts[0], 3), Tets(counts[1], 4)};
  const char* vertices = bytes.data() + sizeof(counts);
  std::memcpy(mesh.vertices.data(), vertices, sizeof(double) * mesh.vertices.size());
  std::memcpy(mesh.tets.data(), vertices + sizeof(double) * mesh.vertices.size(),
              sizeof(int) * mesh.tets.size());
  return mesh;
}

/// Runs TetGen. @throw int as TetGen does.
TetMesh fill(const TriangleMesh& surface, double largest_volume, bool keep_surface) {
  tetgenio input, output;
  setSurface(surface, &input);
  std::string switches = fmt::format("p{}q{}/{}a{:.25f}Q", keep_surface ? "Y" : "", kRadiusEdgeRatio,
                                     kSmallestAngle, largest_volume);
  tetrahedralize(switches.data(), &input, &output);
  return toTetMesh(output);
}

}  // namespace

TetMesh meshInside(const TriangleMesh& surface, double edge_length_m, bool keep_surface) {
  const double volume = kLargestVolume * std::pow(edge_length_m, 3) / (6.0 * std::sqrt(2.0));
  // TetGen 1.5 can crash when it fails.
  const std::optional<std::string> bytes =
      outputOfChild([&] { return toBytes(fill(surface, volume, keep_surface)); });
  if (!bytes) throw std::runtime_error("TetGen cannot fill the surface; does it touch or cross itself?");
  TetMesh mesh = fromBytes(*bytes);
  if (mesh.tets.rows() == 0) throw std::runtime_error("TetGen made no tet inside the surface");
  return mesh;
}

}  // namespace softbody

#include "tools/surface_filling.h"

#define TETLIBRARY
#include <fmt/format.h>
#include <sys/prctl.h>
#include <tetgen.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <string>

#include "cage/fill_request.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kRadiusEdgeRatio = 1.4;  ///< bound for the refinement
constexpr double kSmallestAngle = 15.0;   ///< dihedral angle, bound for the refinement [degrees]

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

/// Runs TetGen. @throw int as TetGen does.
TetMesh fill(const FillRequest& request) {
  tetgenio input, output;
  setSurface(request.surface, &input);
  std::string switches = fmt::format("p{}q{}/{}a{:.25f}Q", request.keep_surface ? "Y" : "", kRadiusEdgeRatio,
                                     kSmallestAngle, request.largest_volume);
  tetrahedralize(switches.data(), &input, &output);
  return toTetMesh(output);
}

}  // namespace

int answerFillRequest() try {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // TetGen prints on stdout, where the answer belongs.
  std::FILE* answer = fdopen(dup(STDOUT_FILENO), "wb");
  if (answer == nullptr || dup2(STDERR_FILENO, STDOUT_FILENO) == -1) return 1;
  const std::string question{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  const std::string bytes = toBytes(fill(fillRequest(question)));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), answer) == bytes.size();
  return std::fclose(answer) == 0 && written ? 0 : 1;
} catch (...) {
  return 1;
}

}  // namespace softbody

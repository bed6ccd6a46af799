#include <gtest/gtest.h>

#include <filesystem>

#include "corpus/model_corpus.h"
#include "fixtures/model_files.h"
#include "fixtures/test_meshes.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"

namespace softbody {
namespace {

using test::CorpusMesh;
using test::PreparedModel;
using test::ScratchFolder;

std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += sentence + "; ";
  return all;
}

TriangleMesh box(const Eigen::RowVector3d& size) {
  TriangleMesh mesh{Points(8, 3), Triangles(12, 3)};
  for (int v = 0; v < 8; ++v) {
    mesh.vertices.row(v) = size.cwiseProduct(Eigen::RowVector3d(v & 1, v >> 1 & 1, v >> 2 & 1));
  }
  mesh.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6,
      1, 3, 5, 3, 7, 5;
  return mesh;
}

PreparedModel prepare(const TriangleMesh& mesh) {
  const ScratchFolder folder;
  writeObj(folder.file("mesh.obj"), mesh);
  return test::prepareAndCheck({"mesh", folder.file("mesh.obj"), false}, folder.file("."));
}

/// A cow, a torus and the boundary of a tet mesh. `make shared-data` prepares many more.
TEST(ModelCorpus, SurfacesAndBoundariesArePreparedWithoutFault) {
  const ScratchFolder folder;
  std::filesystem::copy(test::testData("spot.obj"), folder.file("spot.obj"));
  writeObj(folder.file("torus.obj"), test::torus(0.1, 0.03, 60, 24));
  const TetTopology tets = testing::boxTopology({8, 4, 4}, {0.2, 0.1, 0.1});
  writeVtu(folder.file("tets.vtu"), {tets.rest_vertices, tets.tets});
  const std::vector<CorpusMesh> corpus = test::modelCorpus(folder.file("."));
  ASSERT_EQ(corpus.size(), 3u);
  const ScratchFolder scratch;
  for (const CorpusMesh& mesh : corpus) {
    const PreparedModel prepared = test::prepareAndCheck(mesh, scratch.file("."));
    EXPECT_TRUE(prepared.faults.empty()) << mesh.name << ": " << joined(prepared.faults);
  }
}

TEST(ModelCorpus, BoxesHaveTightCagesThatCanBend) {
  for (const Eigen::RowVector3d& size :
       {Eigen::RowVector3d(0.2, 0.1, 0.04), Eigen::RowVector3d(0.1, 0.1, 0.1)}) {
    const PreparedModel prepared = prepare(box(size));
    EXPECT_TRUE(prepared.faults.empty()) << joined(prepared.faults);
    EXPECT_GE(prepared.quality.cage_vertices, 100);
    EXPECT_LT(prepared.quality.cage_volume, 1.1 * prepared.quality.visual_volume);
  }
}

TEST(ModelCorpus, ThinPlatesStayThin) {
  const PreparedModel prepared = prepare(box({0.2, 0.2, 0.002}));
  EXPECT_TRUE(prepared.faults.empty()) << joined(prepared.faults);
  EXPECT_LT(prepared.quality.largest_margin, 0.001);
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

#include "corpus/mesh_checks.h"
#include "fixtures/model_files.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

TEST(CountedVolume, OfATorusAgreesWithItsTriangles) {
  const TriangleMesh torus = test::torus(0.1, 0.03, 60, 24);
  EXPECT_NEAR(test::countedVolume(torus, 120) / enclosedVolume(torus.vertices, torus.triangles), 1.0, 0.01);
}

/// Every kind of defect once, on another mesh each. `make meshes` tries all pairs and more meshes.
TEST(MutatedMeshes, AreRepairedOrRefusedAndWhatIsCalledGoodIsGood) {
  const test::ScratchFolder folder;
  const std::vector<test::SoundMesh> sound = test::simpleMeshes();
  for (std::size_t kind = 0; kind < test::mutationsOf(sound[0], 1).size(); ++kind) {
    const test::MutatedMesh mesh = test::mutationsOf(sound[kind % sound.size()], 1)[kind];
    const test::CheckedMesh checked = test::checkMesh(mesh, folder.file("."), 1);
    EXPECT_EQ(checked.fault, "") << mesh.base << ", " << mesh.kind << ": " << checked.outcome;
  }
}

}  // namespace
}  // namespace softbody

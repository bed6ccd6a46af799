#include <gtest/gtest.h>

#include <stdexcept>
#include <system_error>

#include "cage/fill_request.h"
#include "cage/program_run.h"
#include "cage/tet_mesher.h"
#include "fixtures/model_files.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

TEST(MeshInside, KeepsTheSurfaceAndFillsItsVolume) {
  const TriangleMesh torus = test::torus(0.1, 0.03, 24, 8);
  const TetMesh mesh = meshInside(torus, 0.02, true);
  EXPECT_EQ(boundaryTriangles(mesh.tets).rows(), torus.triangles.rows());
  const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
  EXPECT_GT(volumes.minCoeff(), 0.0);
  EXPECT_NEAR(volumes.sum(), enclosedVolume(torus.vertices, torus.triangles), 1e-12);
}

TEST(MeshInside, ASurfaceThatCrossesItselfIsRefusedAndNothingCrashes) {
  TriangleMesh torus = test::torus(0.1, 0.03, 24, 8);
  torus.vertices.row(3) << -0.3, 0.01, 0.02;
  EXPECT_THROW(meshInside(torus, 0.02, true), std::runtime_error);
}

TEST(ProgramRun, PassesBytesBothWays) {
  const std::string input(300000, 'x');
  EXPECT_EQ(outputOfProgram("/bin/cat", "-", input, std::chrono::seconds(60)), input);
}

TEST(ProgramRun, AFailureIsNothingAndAMissingProgramAnError) {
  EXPECT_EQ(outputOfProgram("/bin/false", "", "", std::chrono::seconds(60)), std::nullopt);
  EXPECT_THROW(outputOfProgram("/nowhere/program", "", "", std::chrono::seconds(60)), std::system_error);
}

TEST(ProgramRun, AProgramThatDoesNotEndIsKilled) {
  EXPECT_THROW(outputOfProgram("/bin/sleep", "600", "", std::chrono::seconds(0)), std::system_error);
}

TEST(FillRequest, IncompleteBytesAreRefused) {
  const std::string bytes = toBytes(FillRequest{test::torus(0.1, 0.03, 6, 3), 1e-6, true});
  EXPECT_EQ(fillRequest(bytes).surface.triangles, test::torus(0.1, 0.03, 6, 3).triangles);
  for (const std::size_t length : {std::size_t{0}, std::size_t{12}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(fillRequest(bytes.substr(0, length)), std::invalid_argument) << length;
}

}  // namespace
}  // namespace softbody

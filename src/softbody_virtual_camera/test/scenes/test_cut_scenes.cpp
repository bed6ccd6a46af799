#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/pieces.h"
#include "fixtures/scene_fixtures.h"
#include "scenes/tool.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

const std::string kConfig = CONFIG_DIR;
const std::vector<std::string> kCutScenes = {"cut",      "cut-partial",      "cut-cross",
                                             "doll_cut", "doll_cut-partial", "doll_cut-cross"};

Scene scene(const std::string& name) {
  return makeScene(name, shippedBody(objectOf(name)), 1, kConfig + "/knife.yaml");
}

/// When the truth's revisions begin.
std::vector<double> editTimes(const std::string& name) {
  return name.find("cross") == std::string::npos ? std::vector<double>{2.5} : std::vector<double>{2.5, 6.5};
}

TEST(CutScenes, ChangeTheTopologyWhereTheBodyTouchesAndWithoutAJump) {
  for (const std::string& name : kCutScenes) {
    const Scene scene = virtual_camera::scene(name);
    ASSERT_EQ(scene.edits.size(), editTimes(name).size()) << name;
    for (std::size_t edit = 0; edit < scene.edits.size(); ++edit) {
      const SceneState before = scene.state(editTimes(name)[edit] - 1e-3),
                       after = scene.state(editTimes(name)[edit]);
      EXPECT_EQ(before.revision, edit) << name;
      EXPECT_EQ(after.revision, edit + 1) << name;
      const Eigen::Index common = before.vertices[0].rows();
      EXPECT_LT((after.vertices[0].topRows(common) - before.vertices[0]).rowwise().norm().maxCoeff(), 1e-9)
          << name;
    }
  }
}

TEST(CutScenes, PiecesMoveApartRigidlyAndDoNotMeet) {
  for (const std::string name : {"cut", "cut-cross", "doll_cut", "doll_cut-cross"}) {
    const Scene scene = virtual_camera::scene(name);
    const MeshTopology& cut = scene.edits.back().topology;
    ASSERT_EQ(pieces(cut), scene.edits.size() * 2);
    const Points end = scene.state(scene.duration_s).vertices[0];
    for (std::uint32_t piece = 0; piece < pieces(cut); ++piece) {
      EXPECT_NEAR(enclosedVolume(end, pieceOf(cut, piece)) / volumeOf(cut, piece), 1.0, 1e-9) << name;
    }
    // Vertices that a cut made come in pairs at rest; each of the two walls has moved away from the other.
    for (Eigen::Index i = 0; i + 1 < cut.rest_vertices.rows(); ++i) {
      if (cut.vertex_parents[static_cast<std::size_t>(i)] >= 0) continue;
      if ((cut.rest_vertices.row(i) - cut.rest_vertices.row(i + 1)).norm() > 1e-12) continue;
      EXPECT_GT((end.row(i) - end.row(i + 1)).norm(), 0.01) << name;
    }
  }
}

TEST(TearScene, TearsAtHalfAsLongAgainAndTheEndsStay) {
  constexpr double kTear = 2.5, kAround = 4e-3;  // [s], [m]
  const Scene scene = virtual_camera::scene("tear");
  ASSERT_EQ(scene.edits.size(), 1u);
  const MeshTopology& torn = scene.edits[0].topology;
  EXPECT_EQ(pieces(torn), 2u);
  EXPECT_EQ(scene.state(kTear - 1e-6).revision, 0u);
  const SceneState tears = scene.state(kTear), relaxed = scene.state(scene.duration_s);
  EXPECT_EQ(tears.revision, 1u);
  const auto length = [&](const SceneState& state, Eigen::Index a, Eigen::Index b) {
    return (state.vertices[0].row(a) - state.vertices[0].row(b)).norm();
  };
  Eigen::Index left, right;
  torn.rest_vertices.col(0).minCoeff(&left);
  torn.rest_vertices.col(0).maxCoeff(&right);
  EXPECT_NEAR(length(relaxed, left, right), length(tears, left, right), 1e-3);
  for (std::uint32_t piece = 0; piece < 2; ++piece)
    EXPECT_NEAR(enclosedVolume(relaxed.vertices[0], pieceOf(torn, piece)) / volumeOf(torn, piece), 1.0, 1e-9);
  // Two points on both sides of the section, closer than the stretch changes.
  const double section = torn.rest_vertices(torn.rest_vertices.rows() - 1, 0);
  double stretch = 0.0;
  for (Eigen::Index i = 0; i < torn.rest_vertices.rows(); ++i) {
    const double beyond = torn.rest_vertices(i, 0) - section;
    if (beyond < 1e-6 || beyond > kAround) continue;
    stretch = std::max(
        stretch,
        ((tears.T_camera_body.inverse() * Eigen::Vector3d(tears.vertices[0].row(i))).x() - section) / beyond);
  }
  EXPECT_NEAR(stretch, 1.5, 0.02);
}

TEST(CutScenes, SlitOpensAtItsTopAndStaysJoinedAtItsFront) {
  for (const std::string name : {"cut-partial", "doll_cut-partial"}) {
    const Scene scene = virtual_camera::scene(name);
    const MeshTopology& slit = scene.edits.at(0).topology;
    EXPECT_EQ(pieces(slit), 1u) << name;
    const SceneState end = scene.state(scene.duration_s);
    const Points body = transformed(end.T_camera_body.inverse(), end.vertices[0]);
    double widest = 0.0;
    for (Eigen::Index i = 0; i + 1 < body.rows(); ++i) {
      if (slit.vertex_parents[static_cast<std::size_t>(i)] >= 0) continue;
      if ((slit.rest_vertices.row(i) - slit.rest_vertices.row(i + 1)).norm() > 1e-12) continue;
      widest = std::max(widest, (body.row(i) - body.row(i + 1)).norm());
    }
    EXPECT_NEAR(widest, 0.012, 1e-4) << name;
    const double rest_volume = enclosedVolume(slit.rest_vertices, slit.triangles);
    EXPECT_NEAR(enclosedVolume(body, slit.triangles) / rest_volume, 1.0, 0.05) << name;
    EXPECT_LT(enclosedVolume(body, slit.triangles), rest_volume) << name;
  }
}

TEST(CutScenes, BladeIsOverTheBodyThenInThePatchAllAcrossTheSection) {
  const Points blade = readTool(kConfig + "/knife.yaml").blade;
  for (const std::string& name : kCutScenes) {
    const Scene scene = virtual_camera::scene(name);
    for (std::size_t edit = 0; edit < scene.edits.size(); ++edit) {
      const SceneState through = scene.state(editTimes(name)[edit]),
                       above = scene.state(editTimes(name)[edit] - 2.0);
      const auto inBody = [&](const SceneState& state) {
        return transformed(state.T_camera_body.inverse() * *state.T_camera_tool, blade);
      };
      const TriangleMesh& patch = scene.edits[edit].patch;
      const Eigen::Vector3d corner = patch.vertices.row(0);
      const Eigen::Vector3d u = (patch.vertices.row(1) - patch.vertices.row(0)).transpose(),
                            normal = u.cross(Eigen::Vector3d::UnitZ()).normalized();
      for (const Points& at : {inBody(through), inBody(above)}) {
        EXPECT_LT(((at.rowwise() - corner.transpose()) * normal).cwiseAbs().maxCoeff(), 1e-9) << name;
      }
      EXPECT_NEAR(inBody(through).col(2).minCoeff(), patch.vertices.col(2).minCoeff(), 1e-9) << name;
      EXPECT_NEAR(inBody(above).col(2).minCoeff(), patch.vertices.col(2).maxCoeff(), 1e-9) << name;
      const MeshTopology& topology = scene.edits[edit].topology;
      const Points& before =
          edit == 0 ? scene.actors[0].rest.vertices : scene.edits[edit - 1].topology.rest_vertices;
      for (Eigen::Index i = before.rows(); i < topology.rest_vertices.rows(); ++i) {
        const Eigen::Vector3d p = topology.rest_vertices.row(i).transpose() - corner;
        EXPECT_NEAR(p.dot(normal), 0.0, 1e-9) << name;
        EXPECT_GT(p.dot(u.normalized()), 0.0) << name;
        EXPECT_LT(p.dot(u.normalized()), u.norm()) << name;
        EXPECT_GT(p.z(), -1e-9) << name;
      }
    }
  }
}

TEST(CutScenes, RefuseABodyThatTheBladeIsTooShortFor) {
  Body large = shippedBody("sponge");
  large.rest.vertices *= 1.2;
  EXPECT_NO_THROW(makeScene("cut", large, 1, kConfig + "/knife.yaml"));
  large.rest.vertices *= 1.2;
  EXPECT_THROW(makeScene("cut", large, 1, kConfig + "/knife.yaml"), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::virtual_camera

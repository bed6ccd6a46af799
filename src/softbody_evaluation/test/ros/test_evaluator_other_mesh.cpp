#include <test_support/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "fixtures/evaluator_bags.h"
#include "report/report_json.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/ros/conversions.h"

namespace softbody::evaluation {
namespace {

/// A mesh of the same surface with other vertices: one in the middle of each triangle of the truth, and its
/// corners in another order. Its rest shape lies in another frame.
class Remeshed {
 public:
  explicit Remeshed(const MeshTopology& truth) : corners_(truth.triangles), mesh_(truth) {
    const auto old = static_cast<int>(truth.rest_vertices.rows());
    std::vector<Eigen::RowVector3i> triangles;
    for (int f = 0; f < corners_.rows(); ++f) {
      for (int k = 0; k < 3; ++k)
        triangles.emplace_back(place(corners_(f, k), old), place(corners_(f, (k + 1) % 3), old), f);
    }
    mesh_.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
      mesh_.triangles.row(static_cast<Eigen::Index>(f)) = triangles[f];
    const Eigen::Isometry3d motion = Eigen::Translation3d(0.1, 0.7, -0.2) *
                                     Eigen::AngleAxisd(1.9, Eigen::Vector3d(1.0, -2.0, 0.5).normalized());
    mesh_.rest_vertices = transformed(vertices(truth.rest_vertices), motion);
    mesh_.vertex_parents.resize(static_cast<std::size_t>(mesh_.rest_vertices.rows()));
    for (std::size_t i = 0; i < mesh_.vertex_parents.size(); ++i)
      mesh_.vertex_parents[i] = static_cast<int>(i);
    mesh_.triangle_pieces.assign(triangles.size(), 0);
    mesh_.cut.assign(triangles.size(), false);
    mesh_.texture_coordinates.resize(0, 3);
  }

  const MeshTopology& mesh() const { return mesh_; }

  /// The middles, then the truth's vertices from the last to the first.
  Points vertices(const Points& truth) const {
    Points all(corners_.rows() + truth.rows(), 3);
    for (Eigen::Index f = 0; f < corners_.rows(); ++f) {
      all.row(f) = (truth.row(corners_(f, 0)) + truth.row(corners_(f, 1)) + truth.row(corners_(f, 2))) / 3.0;
    }
    all.bottomRows(truth.rows()) = truth.colwise().reverse();
    return all;
  }

 private:
  int place(int vertex, int old) const { return static_cast<int>(corners_.rows()) + old - 1 - vertex; }

  Triangles corners_;
  MeshTopology mesh_;
};

/// The truth as a result of the other mesh. @param size factor of all places.
std::string otherMesh(const std::string& name, const Eigen::RowVector3d& shift, double size = 1.0) {
  const std::string path = testing::TempDir() + name;
  rosbag::Bag in(recording()), out(path, rosbag::bagmode::Write);
  std::unique_ptr<Remeshed> other;
  // A state can come before its topology.
  for (const rosbag::MessageInstance& m :
       rosbag::View(in, rosbag::TopicQuery("/ground_truth/surface/topology"))) {
    softbody_msgs::MeshTopology message = *m.instantiate<softbody_msgs::MeshTopology>();
    other = std::make_unique<Remeshed>(fromMessage(message));
    MeshTopology mesh = other->mesh();
    mesh.rest_vertices *= size;
    const std_msgs::Header header = message.header;
    message = toMessage(mesh);
    message.header = header;
    out.write("/softbody/surface/topology", m.getTime(), message);
  }
  for (const rosbag::MessageInstance& m :
       rosbag::View(in, rosbag::TopicQuery("/ground_truth/surface/state"))) {
    softbody_msgs::MeshState message = *m.instantiate<softbody_msgs::MeshState>();
    MeshState state = fromMessage(message);
    state.vertices = size * (other->vertices(state.vertices).rowwise() + shift);
    state.confidence.assign(static_cast<std::size_t>(state.vertices.rows()), 1.0f);
    const std_msgs::Header header = message.header;
    message = toMessage(state);
    message.header = header;
    out.write("/softbody/surface/state", m.getTime(), message);
  }
  out.close();
  return path;
}

TEST(EvaluatorOtherMesh, TheSameSurfaceHasNoErrorAndANoteSaysThatTheMeshIsAnother) {
  const Report report = evaluate(optionsOf(otherMesh("other_mesh.bag", {0.0, 0.0, 0.0})));
  EXPECT_LT(report.vertex_error->all.max, 1e-4);
  EXPECT_EQ(report.vertex_error->unmatched_share, 0.0);
  EXPECT_GT(report.vertex_error->hidden.count, 0u);
  EXPECT_LT(report.surface_distance->all.max, 1e-6);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_TRUE(says(report.notes[0], "not that of the truth: at rest, their surfaces are 0.000 mm apart"));
}

TEST(EvaluatorOtherMesh, AKnownShiftIsTheErrorAlsoWhereItSlides) {
  const Report report = evaluate(optionsOf(otherMesh("other_shifted.bag", {0.003, 0.0, 0.0})));
  EXPECT_NEAR(report.vertex_error->all.mean, 0.003, 5e-5);
  EXPECT_NEAR(report.vertex_error->visible.max, 0.003, 1e-4);
  const Report same = evaluate(optionsOf(resultFromTruth("same_shifted.bag", [](auto* state, int) {
    for (geometry_msgs::Point32& p : state->vertices) p.x += 0.003f;
    return true;
  })));
  // Of the distance from the surface, only what does not slide is left; the mesh does not matter.
  EXPECT_LT(same.surface_distance->visible.mean, 0.5 * same.vertex_error->visible.mean);
  EXPECT_NEAR(report.surface_distance->visible.mean, same.surface_distance->visible.mean, 5e-5);
  EXPECT_EQ(toJson(report)["surface_distance"]["visible"]["mean_mm"],
            1e3 * report.surface_distance->visible.mean);
}

TEST(EvaluatorOtherMesh, AMeshOfAnotherSizeIsRefused) {
  EXPECT_TRUE(
      says(failure(optionsOf(otherMesh("other_size.bag", {0.0, 0.0, 0.0}, 4.0))), "not the same body"));
}

}  // namespace
}  // namespace softbody::evaluation

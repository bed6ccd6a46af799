#include <test_support/gtest.h>

#include "fixtures/synthetic_scene.h"
#include "registration/box_mesh.h"
#include "registration/search_anywhere.h"
#include "registration/search_near_pose.h"
#include "search_report/search_measurement.h"
#include "search_report/search_sentence.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

TriangleMesh scaledBox(double factor) { return {factor * kMesh.vertices, kMesh.triangles}; }

RgbdFrame boxFrame() { return renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1); }

/// Of a search anywhere.
SearchReport searchIn(const RgbdFrame& frame, const TriangleMesh& mesh = kMesh) {
  const SearchMeshes meshes = makeSearchMeshes(mesh);
  const RegionColors colors;
  const SearchOutcome outcome =
      searchAnywhere(frame, colors, meshes, {}, [](const Eigen::Isometry3d&) { return -1.0; });
  SearchReport report = measureSearch(frame, colors, meshes, outcome, std::nullopt);
  report.found = outcome.found.has_value();
  if (!report.found) report.fitting_scale = fittingScale(frame, colors, meshes, outcome.best);
  return report;
}

void expectWords(const SearchReport& report, const std::vector<std::string>& words) {
  ASSERT_FALSE(report.found);
  const std::string sentence = whyNotFound(report);
  EXPECT_EQ(sentence.rfind("the body was not found: ", 0), 0U) << sentence;
  for (const std::string& word : words) EXPECT_TRUE(says(sentence, word)) << word << " in: ";
}

/// The box and another one that touches it, at the same distance.
RgbdFrame touched(const Eigen::Vector3d& beside) {
  RgbdFrame frame = boxFrame();
  const RgbdFrame other =
      renderFrame(kBox, transformed(kMesh.vertices, boxPose() * Eigen::Translation3d(beside)), 1);
  frame.depth = cv::min(frame.depth, other.depth);
  return frame;
}

RgbdFrame bent(double curvature) {
  Points vertices = kMesh.vertices;
  vertices.col(2) += curvature * vertices.col(0).cwiseAbs2();
  return renderFrame(kBox, transformed(vertices, boxPose()), 1);
}

TEST(SearchReport, ABodyThatIsFoundNeedsNoExplanation) {
  const SearchReport report = searchIn(boxFrame());
  EXPECT_TRUE(report.found);
  EXPECT_EQ(whyNotFound(report), "");
  EXPECT_GT(report.agreeing, 0.9);
  EXPECT_NEAR(report.body_m.x(), 0.2, 1e-9);
  EXPECT_NEAR(report.body_m.z(), 0.04, 1e-9);
  EXPECT_NEAR(report.part_distance_m, 0.5, 0.05);
}

TEST(SearchReport, SaysWhatThePosesOfABodyWithAPictureLack) {
  SearchReport report = searchIn(bent(12.0));
  report.fitting_scale.reset();
  report.pictured = 31, report.refused_by_depth = 20, report.refused_by_picture = 7;
  expectWords(report,
              {"Of 31 poses, 20 do not agree", "at 7 something else than the object's picture", "4 neither"});
  report.several_places = true;
  expectWords(report, {"several places"});
}

TEST(SearchReport, AMeshInAnotherUnitIsRecognised) {
  for (const double factor : {1000.0, 100.0, 1.0 / 0.0254, 0.001}) {
    const SearchReport report = searchIn(boxFrame(), scaledBox(factor));
    ASSERT_TRUE(report.fitting_scale) << factor << ": " << whyNotFound(report);
    EXPECT_NEAR(*report.fitting_scale * factor, 1.0, 1e-9);
    expectWords(report, {factor > 1.0 ? "times smaller would fit" : "times larger would fit", "--unit"});
  }
}

TEST(SearchReport, DepthInAnotherUnitIsRecognised) {
  RgbdFrame frame = boxFrame();
  frame.depth *= 4.0f;
  const SearchReport report = searchIn(frame);
  ASSERT_TRUE(report.fitting_scale) << whyNotFound(report);
  EXPECT_NEAR(*report.fitting_scale, 4.0, 0.2);
  expectWords(report, {"times larger would fit", "depth_scale"});
}

TEST(SearchReport, AMeshOfAnotherSizeIsMeasured) {
  for (const double factor : {0.7, 1.4}) {
    const SearchReport report = searchIn(boxFrame(), scaledBox(factor));
    ASSERT_FALSE(report.found) << factor;
    ASSERT_TRUE(report.fitting_scale) << factor << ": " << whyNotFound(report);
    EXPECT_NEAR(*report.fitting_scale * factor, 1.0, 0.06) << factor;
  }
}

TEST(SearchReport, NamesEachCauseWithNumbers) {
  RgbdFrame dark = boxFrame();
  dark.depth = 0.0f;
  expectWords(searchIn(dark), {"0.0 %", "min_depth_m", "depth_scale"});
  RgbdFrame wall = boxFrame();
  wall.depth = 1.2f;
  expectWords(searchIn(wall), {"nothing stands free", "200 x 100 x 40 mm", "initial_pose"});
  expectWords(searchIn(bent(12.0)),
              {"200 x 100 x 40 mm", "disagreement", "allowed: 22 %", "mm. ", "bent", "initial_pose"});
}

/// A report of a pose that disagrees.
SearchReport disagreeing() {
  SearchReport report;
  report.body_m = {0.2, 0.1, 0.04};
  report.part_m = {0.25, 0.11, 0.05};
  report.part_distance_m = 0.5;
  report.part_fits = true;
  report.depth_share = 0.9;
  report.cost = 0.31;
  report.agreeing = 0.6;
  report.difference_m = 0.012;
  report.confined = 0.8;
  return report;
}

TEST(SearchReport, SaysWhatToDo) {
  SearchReport report = disagreeing();
  expectWords(report, {"250 x 110 x 50 mm at 0.50 m", "31 %", "22 %", "60 %", "12.0 mm", "bent"});
  report.continuing = 0.4;
  expectWords(report, {"goes on beyond 40 %", "touches"});
  report.hidden = 0.3;
  expectWords(report, {"before 30 % of it: take it away"});
  report.part_at_border = true;
  expectWords(report, {"border of the image"});
  report.fitting_scale = 1.11;
  expectWords(report, {"a mesh 11 % larger would fit", "--unit", "depth_scale"});
  report = disagreeing();
  report.cost = 0.1;
  expectWords(report, {"colours or features"});
  report.without_edge = 0.5;
  expectWords(report, {"at 50 % of the outline (allowed: 35 %)"});
  report.outside = report.near_pose = true;
  report.shift_m = 0.12;
  expectWords(report, {"120 mm and 0 degrees", "search: anywhere"});
  report.confined = 0.1;
  expectWords(report, {"only 10 % of the edges", "needed: 20 %"});
  report.found = true;
  EXPECT_EQ(whyNotFound(report), "");
}

TEST(SearchReport, ABodyThatTouchesAnotherIsFoundNearItsRoughPose) {
  const RoughPose rough = roughPose(boxPose(), RegistrationConfig());
  EXPECT_TRUE(searchNearAccepted(touched({0.195, 0.0, 0.0}), makeSearchMeshes(kMesh), rough).found);
}

}  // namespace
}  // namespace softbody

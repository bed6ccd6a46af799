#include "report/metrics.h"

#include <test_support/gtest.h>

#include <nlohmann/json.hpp>

namespace softbody::evaluation {
namespace {

MeshState stateAt(double x) {
  MeshState state;
  state.vertices = Points::Zero(4, 3);
  state.vertices.col(0).setConstant(x);
  state.confidence.assign(4, 1.0f);
  return state;
}

Report reportWith(double error_m) {
  Report report;
  report.frames = {10, 9, {}};
  report.vertex_error =
      summarize(std::vector<FrameVertexError>{vertexError(stateAt(error_m), stateAt(0.0), {0, 1, 2, 3})});
  return report;
}

TEST(Metrics, AForceThatIsNeverFoundHasNoPlace) {
  Report report = reportWith(0.001);
  report.forces = ForceReport{3, summarize(std::vector<float>{2.0f}), 0.0, {}, 0.0};
  for (const Metric& metric : metrics(report))
    EXPECT_FALSE(says(metric.name, "place of the force")) << " " << metric.value;
}

TEST(Compare, PutsTheSameMetricsSideBySide) {
  Report first = reportWith(0.001), second = reportWith(0.003);
  second.stages[{"replay", "registration", false}] = summarize(std::vector<float>{2.0f, 4.0f});
  const nlohmann::json rows = toJson(compare(first, second));
  bool found = false;
  for (const nlohmann::json& row : rows) {
    if (row["figure"] == "vertex error, mean") {
      found = true;
      EXPECT_NEAR(row["result"].get<double>(), 1.0, 1e-5);
      EXPECT_NEAR(row["other"].get<double>(), 3.0, 1e-5);
      EXPECT_NEAR(row["difference"].get<double>(), -2.0, 1e-5);
    }
  }
  EXPECT_TRUE(found);
  EXPECT_FALSE(rows.back().contains("result"));
  EXPECT_NEAR(rows.at(rows.size() - 2)["other"].get<double>(), 3.0, 1e-6);
}

}  // namespace
}  // namespace softbody::evaluation

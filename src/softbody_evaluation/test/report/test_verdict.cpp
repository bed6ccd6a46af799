#include "report/verdict.h"

#include <test_support/gtest.h>

#include "report/metric_meaning.h"

namespace softbody::evaluation {
namespace {

/// A report without truth, as of a real recording.
Report reportWith(double p95_m, double volume_change) {
  Report report;
  report.frames = {100, 100, {}};
  report.states["tracking"] = 100;
  report.residual = ResidualReport();
  report.residual->residual = summarize(std::vector<float>(10, 0.001f));
  report.residual->residual.p95 = p95_m;
  report.residual->within_15mm_of_measured = 0.9;
  report.volume.closed = true;
  report.volume.change = {volume_change, volume_change};
  return report;
}

TEST(Verdict, IsTheWorstFindingAndSaysTheWorstFirst) {
  EXPECT_EQ(judge(reportWith(0.002, 0.0)).level, Level::kGood);
  EXPECT_TRUE(judge(reportWith(0.002, 0.0)).findings.empty());
  EXPECT_EQ(judge(reportWith(0.021, 0.0)).level, Level::kSuspect);
  const Verdict wrong = judge(reportWith(0.089, -0.05));
  EXPECT_EQ(wrong.level, Level::kWrong);
  ASSERT_EQ(wrong.findings.size(), 2u);
  EXPECT_TRUE(says(wrong.findings[0].sentence, "depth residual, p95 is 89 mm"));
  EXPECT_TRUE(says(wrong.findings[1].sentence, "volume change, mean is -5 %"));
}

TEST(Verdict, AResultThatIsNeverTrackedIsWrong) {
  Report report = reportWith(0.002, 0.0);
  report.states = {{"lost", 100}};
  EXPECT_EQ(judge(report).level, Level::kWrong);
}

TEST(Verdict, WithoutTruthItSaysWhatItCannotKnow) {
  Report report = reportWith(0.002, 0.0);
  EXPECT_EQ(judge(report).limits.size(), 1u);
  report.residual.reset();
  EXPECT_EQ(judge(report).level, Level::kSuspect);  // compared with nothing
  report.vertex_error = VertexErrorReport();
  EXPECT_EQ(judge(report).level, Level::kGood);
  EXPECT_TRUE(judge(report).limits.empty());
}

TEST(Verdict, EveryMetricWithLimitsExistsAndHasAMeaningOfItsOwn) {
  const std::string of_stages = meaningOf("replay: registration, mean");
  for (const Metric& metric : metrics(reportWith(0.002, 0.0)))
    EXPECT_NE(meaningOf(metric.name), of_stages) << metric.name;
  EXPECT_EQ(limitsOf("depth residual, p95"), "suspect above 20, wrong above 50");
  EXPECT_EQ(limitsOf("jitter while still, RMS"), "");
}

}  // namespace
}  // namespace softbody::evaluation

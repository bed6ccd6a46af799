#include "fixtures/evaluator_bags.h"
#include "report/metrics.h"

namespace softbody::evaluation {
namespace {

constexpr int kTracked = 16;

/// The truth moved by 1 mm while it is tracked, and by 2 mm in the last frames, which have no image.
std::string predicted(const std::string& name) {
  ros::Time last;
  return resultFromTruth(name, [&last](softbody_msgs::MeshState* state, int frame) {
    if (frame < kTracked) last = state->header.stamp;
    state->observed = last;
    return shift(state, frame < kTracked ? 1e-3f : 2e-3f);
  });
}

TEST(OpenLoop, PredictedFramesAreMeasuredAlone) {
  EvaluatorOptions options;
  options.result = predicted("open_loop.bag");
  options.truth = recording();
  options.open_loop = 0.2;
  const Report report = evaluate(options);
  ASSERT_TRUE(report.open_loop.has_value());
  EXPECT_EQ(report.open_loop->frames, static_cast<std::size_t>(kFrames - kTracked));
  EXPECT_NEAR(report.open_loop->duration_s, 1.0, 1e-6);
  EXPECT_NEAR(report.open_loop->all.mean, 2e-3, 1e-6);
  EXPECT_NEAR(report.open_loop->last_mean, 2e-3, 1e-6);
  EXPECT_NEAR(report.vertex_error->all.max, 1e-3, 1e-6);
  EXPECT_EQ(report.frames.expected, static_cast<std::size_t>(kTracked));
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kTracked));
  EXPECT_EQ(report.frames.recorded, static_cast<std::size_t>(kTracked));
  const std::vector<Metric> all = metrics(report);
  const auto metric =
      std::find_if(all.begin(), all.end(), [](const Metric& one) { return one.name == "open loop, mean"; });
  ASSERT_NE(metric, all.end());
  EXPECT_NEAR(metric->value, 2.0, 1e-3);
}

TEST(OpenLoop, AResultThatUsedItsImagesIsRefused) {
  EvaluatorOptions options;
  options.result = resultFromTruth("closed_loop.bag", asItIs);
  options.truth = recording();
  options.open_loop = 0.2;
  EXPECT_TRUE(says(failure(options), "replay --open-loop 0.2"));
  options.result = predicted("open_loop.bag");
  options.open_loop = 0.5;
  EXPECT_TRUE(says(failure(options), "4 states at its end are predicted"));
  options.open_loop = 0.2;
  options.truth.clear();
  options.recording = recording();
  EXPECT_TRUE(says(failure(options), "add --truth"));
}

}  // namespace
}  // namespace softbody::evaluation

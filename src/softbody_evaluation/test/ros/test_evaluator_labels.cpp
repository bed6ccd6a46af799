#include <sensor_msgs/Image.h>
#include <test_support/gtest.h>

#include <nlohmann/json.hpp>

#include "fixtures/evaluator_bags.h"
#include "report/report_json.h"

namespace softbody::evaluation {
namespace {

/// A hand of the body's own colour, with the true labels.
std::string labelledRecording() {
  virtual_camera::CameraSetup setup = smallSetup();
  setup.scene = "touch";
  setup.texture = "plain";
  return recordingOf(setup, "evaluator_labelled.bag", kFrames, 4.0, true);
}

/// The true surface as a result, with the true labels after a change; every second frame has some.
std::string resultWithLabels(const std::string& name, const std::string& truth,
                             const std::function<void(sensor_msgs::Image*)>& change) {
  const std::string path = resultFromTruth(name, asItIs, truth);
  rosbag::Bag in(truth), out(path, rosbag::bagmode::Append);
  int frame = 0;
  for (const rosbag::MessageInstance& m : rosbag::View(in, rosbag::TopicQuery("/ground_truth/labels"))) {
    sensor_msgs::Image image = *m.instantiate<sensor_msgs::Image>();
    change(&image);
    if (frame++ % 2 == 0) out.write("/softbody/labels", m.getTime(), image);
  }
  out.close();
  return path;
}

TEST(Evaluator, ComparesLabelsWithTheTrueOnes) {
  EvaluatorOptions options;
  options.truth = labelledRecording();
  options.result = resultWithLabels("right.bag", options.truth, [](sensor_msgs::Image*) {});
  const Report right = evaluate(options);
  ASSERT_TRUE(right.labels);
  EXPECT_EQ(right.labels->frames, kFrames / 2u);
  EXPECT_EQ(right.labels->right, 1.0);
  options.result = resultWithLabels("one_class.bag", options.truth, [](sensor_msgs::Image* image) {
    for (std::uint8_t& label : image->data) label = label == 2 ? 3 : label;
  });
  const Report body_only = evaluate(options);
  const nlohmann::json labels = toJson(body_only)["labels"];
  EXPECT_EQ(labels["body"], 1.0);
  EXPECT_EQ(labels["background"], 1.0);
  EXPECT_EQ(labels["occluder"], 0.0);
  EXPECT_LT(labels["right"], 1.0);
}

TEST(Evaluator, HasNoLabelsWithoutThoseOfBothBags) {
  EvaluatorOptions options;
  options.truth = labelledRecording();
  options.result = resultFromTruth("without.bag", asItIs, options.truth);
  EXPECT_FALSE(evaluate(options).labels);
  EXPECT_FALSE(toJson(evaluate(options)).contains("labels"));
  options.result = resultWithLabels("with.bag", options.truth, [](sensor_msgs::Image*) {});
  options.truth = recording();
  EXPECT_FALSE(evaluate(options).labels);
}

TEST(Evaluator, RefusesLabelsOfAnotherEncodingOrSize) {
  EvaluatorOptions options;
  options.truth = labelledRecording();
  options.result = resultWithLabels("other.bag", options.truth,
                                    [](sensor_msgs::Image* image) { image->encoding = "8UC1"; });
  EXPECT_TRUE(says(failure(options), "/softbody/labels are 8UC1 instead of mono8"));
  options.result = resultWithLabels("small.bag", options.truth, [](sensor_msgs::Image* image) {
    image->height /= 2;
    image->data.resize(image->data.size() / 2);
  });
  EXPECT_TRUE(says(failure(options), "/softbody/labels: label images of 160x120 and 160x60"));
}

}  // namespace
}  // namespace softbody::evaluation

#include <gtest/gtest.h>

#include "softbody_common/images/pixel_labels.h"
#include "softbody_tracking/ros/feature_messages.h"

namespace softbody {
namespace {

TEST(FeatureMessages, LabelsAreAsLargeAsTheImageAndUnknownOutsideOfTheirPart) {
  TrackingResult result;
  result.labelled = {2, 1, 3, 2};
  result.labels = cv::Mat1b(2, 3, labels::kBody);
  result.labels(0, 2) = labels::kOccluder;
  const sensor_msgs::Image image = makeLabelImage(result, {6, 4});
  EXPECT_EQ(image.encoding, "mono8");
  EXPECT_EQ(image.step, 6u);
  EXPECT_EQ(image.data, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0,  //
                                                   0, 0, 3, 3, 2, 0,  //
                                                   0, 0, 3, 3, 3, 0,  //
                                                   0, 0, 0, 0, 0, 0}));
}

TEST(FeatureMessages, WithoutALabelledPartAllPixelsAreUnknown) {
  const sensor_msgs::Image image = makeLabelImage(TrackingResult(), {6, 4});
  EXPECT_EQ(image.data, std::vector<std::uint8_t>(24, labels::kUnknown));
}

}  // namespace
}  // namespace softbody

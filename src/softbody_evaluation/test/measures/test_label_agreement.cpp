#include <gtest/gtest.h>

#include "softbody_common/images/pixel_labels.h"
#include "softbody_evaluation/measures/label_agreement.h"

namespace softbody::evaluation {
namespace {

/// A body of 20 x 10 pixels, and an occluder of 10 x 10 beside it.
cv::Mat1b trueLabels() {
  cv::Mat1b image(120, 160, labels::kBackground);
  image(cv::Rect(60, 50, 20, 10)) = labels::kBody;
  image(cv::Rect(80, 50, 10, 10)) = labels::kOccluder;
  return image;
}
constexpr int kRegion = (20 + 2 * 24) * (10 + 2 * 24);  // [px]

TEST(LabelAgreement, OfTheTruthItselfIsOne) {
  LabelAgreement agreement;
  EXPECT_FALSE(agreement.report());
  for (int i = 0; i < 2; ++i) agreement.add(trueLabels(), trueLabels());
  const LabelReport report = agreement.report().value();
  EXPECT_EQ(report.frames, 2u);
  EXPECT_EQ(report.pixels, 2u * kRegion);
  EXPECT_EQ(report.right, 1.0);
  EXPECT_EQ(report.unknown, 0.0);
  for (const std::uint8_t label : {labels::kBackground, labels::kOccluder, labels::kBody})
    EXPECT_EQ(report.of_class[label], 1.0);
}

TEST(LabelAgreement, CountsWrongAndUnknownPixelsByTheirTrueLabel) {
  cv::Mat1b found = trueLabels();
  found(cv::Rect(60, 50, 5, 10)) = labels::kOccluder;
  found(cv::Rect(80, 50, 2, 10)) = labels::kUnknown;
  found(cv::Rect(0, 0, 30, 20)) = labels::kBody;  // outside of the region
  LabelAgreement agreement;
  agreement.add(trueLabels(), found);
  const LabelReport report = agreement.report().value();
  EXPECT_NEAR(report.right, 1.0 - 70.0 / kRegion, 1e-12);
  EXPECT_NEAR(report.unknown, 20.0 / kRegion, 1e-12);
  EXPECT_EQ(report.of_class[labels::kBackground], 1.0);
  EXPECT_NEAR(report.of_class[labels::kBody].value(), 0.75, 1e-12);
  EXPECT_NEAR(report.of_class[labels::kOccluder].value(), 0.8, 1e-12);
}

TEST(LabelAgreement, AFrameWithoutABodyDoesNotCount) {
  LabelAgreement agreement;
  agreement.add(cv::Mat1b(120, 160, labels::kBackground), trueLabels());
  EXPECT_FALSE(agreement.report());
  cv::Mat1b alone = cv::Mat1b(120, 160, labels::kBackground);
  alone(0, 0) = labels::kBody;  // the region ends at the edge of the image
  agreement.add(alone, alone);
  EXPECT_EQ(agreement.report().value().pixels, 25u * 25u);
  EXPECT_FALSE(agreement.report().value().of_class[labels::kOccluder]);
}

TEST(LabelAgreement, RefusesImagesOfAnotherSize) {
  EXPECT_THROW(LabelAgreement().add(cv::Mat1b(2, 3), cv::Mat1b(3, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::evaluation

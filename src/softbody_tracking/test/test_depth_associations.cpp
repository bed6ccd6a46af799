#include <gtest/gtest.h>

#include "core/depth_associations.h"
#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"
#include "synthetic_scene.h"

namespace softbody {
namespace {

class DepthAssociationsTest : public ::testing::Test {
 protected:
  DepthAssociationsTest()
      : truth_(transformed(box_.volume.rest_vertices, boxPose())),
        frame_(renderFrame(box_, truth_, 1)),
        surface_(box_.volume, box_.surface),
        all_colors_(frame_.color.size(), 255) {
    surface_.update(frame_.camera, truth_);
  }

  DepthAssociations associate(const DepthConfig& config = DepthConfig()) {
    return associateDepth(frame_, surface_, all_colors_,
                          meanEdgeLength(box_.volume.rest_vertices, box_.volume.tets), config);
  }

  BoxBody box_ = makeBox();
  Points truth_;
  RgbdFrame frame_;
  PredictedSurface surface_;
  cv::Mat1b all_colors_;
};

TEST_F(DepthAssociationsTest, AgreeWhereThePredictionIsTrue) {
  const DepthAssociations found = associate();
  EXPECT_GT(found.associations.size(), 1000u);
  EXPECT_EQ(found.occluded_blocks, 0);
  EXPECT_EQ(found.absent_blocks, 0);
  for (const Association& a : found.associations) {
    EXPECT_LT(std::abs(a.residual()), 1e-6);
    EXPECT_LT((positionOf(a.place, truth_, box_.volume.tets) - a.predicted).norm(), 1e-6);
    EXPECT_LT(a.normal.dot(a.predicted), 0.0) << "visible surface faces the camera";
  }
}

TEST_F(DepthAssociationsTest, MeasureAShiftAlongTheNormals) {
  surface_.update(frame_.camera,
                  transformed(truth_, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.004))));
  for (const Association& a : associate().associations) {
    EXPECT_LT(a.residual(), 0.0) << "the body lies behind its prediction, against the normals";
    EXPECT_NEAR(a.residual(), 0.004 * a.normal.z(), 0.0025);
  }
}

TEST_F(DepthAssociationsTest, WeighTheSameSurfaceTheSameWhateverTheNumberOfBlocks) {
  const auto totalWeight = [](const DepthAssociations& found) {
    double sum = 0.0;
    for (const Association& a : found.associations) sum += a.weight;
    return sum;
  };
  DepthConfig few;
  few.max_targets = 300;
  EXPECT_NEAR(totalWeight(associate(few)) / totalWeight(associate()), 1.0, 0.1);
}

TEST_F(DepthAssociationsTest, TellOccludersFromAnAbsentBody) {
  frame_.depth(cv::Rect(0, 0, 320, 480)) -= 0.1f;
  DepthAssociations found = associate();
  EXPECT_GT(found.occluded_blocks, 300);
  EXPECT_EQ(found.absent_blocks, 0);
  frame_.depth.setTo(2.0f);
  found = associate();
  EXPECT_EQ(found.occluded_blocks, 0);
  EXPECT_EQ(found.absent_blocks, found.visible_blocks);
  EXPECT_TRUE(found.associations.empty());
}

TEST_F(DepthAssociationsTest, ForeignColorsAreOccluders) {
  all_colors_.setTo(0);
  const DepthAssociations found = associate();
  EXPECT_EQ(found.occluded_blocks, found.visible_blocks);
  EXPECT_TRUE(found.associations.empty());
}

TEST_F(DepthAssociationsTest, NoDepthGivesNothing) {
  frame_.depth.setTo(0.0f);
  EXPECT_EQ(associate().visible_blocks, 0);
}

}  // namespace
}  // namespace softbody

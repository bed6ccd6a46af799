#include <gtest/gtest.h>

#include <random>

#include "fixtures/painted_box.h"
#include "picture/picture_fit.h"

namespace softbody {
namespace {

struct Painted {
  explicit Painted(const Paint& paint)
      : body(paint),
        mesh{body.box.surface.rest_vertices, body.box.surface.triangles},
        baked(body.picture, mesh, body.box.surface.texture_coordinates, 0.0014) {}
  PictureFit fit(const RgbdFrame& frame, const Eigen::Isometry3d& pose) const {
    return pictureFit(colorPatches(colorFrame(frame), mesh, baked, pose));
  }
  PaintedBox body;
  TriangleMesh mesh;
  BakedPicture baked;
};

Eigen::Isometry3d randomPose(std::mt19937* random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond turn(normal(*random), normal(*random), normal(*random), normal(*random));
  return Eigen::Translation3d(0.03 * normal(*random), 0.03 * normal(*random), 0.5 + 0.03 * normal(*random)) *
         turn.normalized();
}

const cv::Vec3d kLights[] = {{1.0, 1.0, 1.0}, {0.85, 1.0, 1.1}, {0.3, 0.35, 0.38}};  // usual, warm, dim

/// Rich and weak, in any light, and with the error of place that a search leaves.
TEST(PictureFit, TellsTheRightOfFourAlikePoses) {
  std::mt19937 random(3);
  for (const double contrast : {1.0, 0.12}) {
    for (const cv::Vec3d& light : kLights) {
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Painted painted(cells(seed, contrast));
        const Eigen::Isometry3d truth = randomPose(&random);
        const RgbdFrame frame = painted.body.frameAt(truth, light);
        for (const Eigen::Isometry3d& turn : alikeTurns()) {
          const Eigen::Isometry3d pose = Eigen::Translation3d(0.001, -0.001, 0.001) * truth * turn;
          const PictureFit fit = painted.fit(frame, pose);
          const bool right = turn.isApprox(Eigen::Isometry3d::Identity());
          EXPECT_EQ(pictureFits(fit, 4), right)
              << "contrast " << contrast << ", light " << light << ", seed " << seed << ", patches "
              << fit.patches << ", correlation " << fit.correlation << ", evidence " << fit.evidence
              << ", shortfall " << fit.shortfall << ", cast " << fit.cast;
          const bool disagrees = pictureDisagrees(fit, 4);
          EXPECT_FALSE(right && disagrees) << contrast << " " << seed << " " << fit.shortfall;
          // A weak picture in dim light is hardly seen.
          const bool plainly_seen = contrast == 1.0 || light[0] > 0.5;
          EXPECT_TRUE(right || disagrees || !plainly_seen) << contrast << " " << seed << " " << fit.shortfall;
        }
      }
    }
  }
}

/// A body of one colour is no other than one of the same colour.
TEST(PictureFit, ComparesTheHueOfPlainBodies) {
  std::mt19937 random(4);
  const Painted red(cells(1, 0.0, {50, 60, 180})), green(cells(1, 0.0, {60, 160, 60}));
  for (const cv::Vec3d& light : kLights) {
    const Eigen::Isometry3d pose = randomPose(&random);
    const PictureFit same = red.fit(red.body.frameAt(pose, light), pose),
                     other = red.fit(green.body.frameAt(pose, light), pose);
    EXPECT_FALSE(pictureFits(same, 1));
    EXPECT_FALSE(pictureDisagrees(same, 1)) << same.cast << " " << same.shortfall;
    EXPECT_TRUE(pictureDisagrees(other, 1)) << other.cast;
  }
}

/// The share of wrong pictures that fit by chance is that of a normal distribution.
TEST(PictureFit, IsSeldomFooledByAnotherPicture) {
  std::mt19937 random(5);
  int fits = 0, agrees = 0, tried = 0;
  const Painted painted(cells(1, 1.0));
  for (std::uint64_t seed = 2; seed < 42; ++seed) {
    const Eigen::Isometry3d pose = randomPose(&random);
    const PictureFit fit = painted.fit(PaintedBox(cells(seed, 1.0)).frameAt(pose), pose);
    ++tried;
    fits += pictureFits(fit, 1) ? 1 : 0;
    agrees += pictureDisagrees(fit, 1) ? 0 : 1;
  }
  EXPECT_EQ(fits, 0) << "of " << tried;
  EXPECT_LE(agrees, tried / 10);
}

TEST(PictureFit, SaysNothingWithoutPixels) {
  const PictureFit fit = pictureFit({});
  EXPECT_FALSE(pictureFits(fit, 1));
  EXPECT_FALSE(pictureDisagrees(fit, 1));
}

}  // namespace
}  // namespace softbody

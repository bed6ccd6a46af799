#include "softbody_recordings/injection/image_faults.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "softbody_common/statistics/random.h"
#include "softbody_recordings/injection/deliveries.h"

namespace softbody::injection {
namespace {

constexpr int kHoleBlock = 8, kMisplacedBlock = 24;  // [px]
constexpr double kNearest = 4.0, kFarthest = 12.0;   // displacement of a block [px]
// The frame's number is added to these.
constexpr std::uint64_t kHolePurpose = 100, kMisplacedPurpose = 1ull << 40, kOffsetPurpose = 2ull << 40;
const cv::Vec3b kSkinRgb(224, 172, 138);

template <typename Pixel>
void bringNearer(Pixel distance, cv::Mat_<Pixel> region) {
  for (Pixel& z : region) {
    const bool nearer = z > Pixel(0) && z < distance;
    if (!nearer) z = distance;
  }
}

/// The chosen share of an image's blocks.
std::vector<cv::Rect> chosenBlocks(const cv::Size& image, int side, double share, std::uint64_t seed,
                                   std::uint64_t purpose) {
  const int columns = (image.width + side - 1) / side, rows = (image.height + side - 1) / side;
  const int count = columns * rows;
  const std::vector<bool> chosen = choose(static_cast<std::size_t>(count), share, seed, purpose);
  std::vector<cv::Rect> blocks;
  for (int i = 0; i < count; ++i) {
    const cv::Rect block(i % columns * side, i / columns * side, side, side);
    if (chosen[static_cast<std::size_t>(i)]) blocks.push_back(block & cv::Rect(cv::Point(), image));
  }
  return blocks;
}

cv::Point randomOffset(std::mt19937_64* random) {
  const double length = kNearest + (kFarthest - kNearest) * unit((*random)()),
               angle = 2.0 * CV_PI * unit((*random)());
  return {cvRound(length * std::cos(angle)), cvRound(length * std::sin(angle))};
}

/// The block, shifted into the image.
cv::Rect inside(cv::Rect block, const cv::Size& image) {
  block.x = std::clamp(block.x, 0, image.width - block.width);
  block.y = std::clamp(block.y, 0, image.height - block.height);
  return block;
}

}  // namespace

cv::Rect occluderRegion(const cv::Size& image, const ImageFaults& faults) {
  const double side = std::sqrt(faults.occluder_share);
  const int width = static_cast<int>(std::lround(side * image.width)),
            height = static_cast<int>(std::lround(side * image.height));
  const cv::Rect region(static_cast<int>(std::lround(faults.occluder_u * image.width - 0.5 * width)),
                        static_cast<int>(std::lround(faults.occluder_v * image.height - 0.5 * height)), width,
                        height);
  return region & cv::Rect(cv::Point(), image);
}

bool occluderPresent(double time_s, const ImageFaults& faults) {
  return faults.occluder_share > 0.0 && time_s >= faults.occluder_from_s &&
         time_s < faults.occluder_from_s + faults.occluder_for_s;
}

void occludeColor(const ImageFaults& faults, bool rgb, cv::Mat3b* color) {
  const cv::Vec3b skin = rgb ? kSkinRgb : cv::Vec3b(kSkinRgb[2], kSkinRgb[1], kSkinRgb[0]);
  (*color)(occluderRegion(color->size(), faults)).setTo(skin);
}

void occludeDepth(const ImageFaults& faults, cv::Mat* depth) {
  const cv::Mat region = (*depth)(occluderRegion(depth->size(), faults));
  if (depth->type() == CV_16UC1) {
    bringNearer<std::uint16_t>(static_cast<std::uint16_t>(std::lround(1e3 * faults.occluder_m)), region);
  } else if (depth->type() == CV_32FC1) {
    bringNearer<float>(static_cast<float>(faults.occluder_m), region);
  } else {
    throw std::invalid_argument("a depth image is neither 16UC1 nor 32FC1");
  }
}

void punchHoles(const ImageFaults& faults, std::size_t frame, cv::Mat* depth) {
  for (const cv::Rect& block :
       chosenBlocks(depth->size(), kHoleBlock, faults.hole_share, faults.seed, kHolePurpose + frame))
    (*depth)(block).setTo(0);
}

void misplaceBlocks(const ImageFaults& faults, std::size_t frame, cv::Mat3b* color) {
  const cv::Mat3b original = color->clone();
  std::mt19937_64 random(faults.seed + kOffsetPurpose + frame);
  for (const cv::Rect& block : chosenBlocks(color->size(), kMisplacedBlock, faults.misplaced_share,
                                            faults.seed, kMisplacedPurpose + frame)) {
    original(inside(block + randomOffset(&random), color->size())).copyTo((*color)(block));
  }
}

}  // namespace softbody::injection

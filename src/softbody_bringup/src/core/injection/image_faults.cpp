#include "softbody_bringup/injection/image_faults.h"

#include <cmath>
#include <stdexcept>

#include "softbody_bringup/injection/deliveries.h"

namespace softbody::injection {
namespace {

constexpr int kBlock = 8;                    // [px]
constexpr std::uint64_t kHolePurpose = 100;  // plus the frame's number
const cv::Vec3b kSkinRgb(224, 172, 138);

template <typename Pixel>
void bringNearer(Pixel distance, cv::Mat_<Pixel> region) {
  for (Pixel& z : region) {
    const bool nearer = z > Pixel(0) && z < distance;
    if (!nearer) z = distance;
  }
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
  const int columns = (depth->cols + kBlock - 1) / kBlock, rows = (depth->rows + kBlock - 1) / kBlock;
  const std::vector<bool> holes =
      choose(static_cast<std::size_t>(columns * rows), faults.hole_share, faults.seed, kHolePurpose + frame);
  for (int i = 0; i < columns * rows; ++i) {
    if (!holes[static_cast<std::size_t>(i)]) continue;
    const cv::Rect block(i % columns * kBlock, i / columns * kBlock, kBlock, kBlock);
    (*depth)(block & cv::Rect(cv::Point(), depth->size())).setTo(0);
  }
}

}  // namespace softbody::injection

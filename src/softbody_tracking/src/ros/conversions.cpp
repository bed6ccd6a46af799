#include "softbody_tracking/ros/conversions.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <cstring>
#include <stdexcept>

#include "ros/image_pixels.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"

namespace enc = sensor_msgs::image_encodings;

namespace softbody {
namespace {

constexpr float kFarthestDepth_m = 100.0f;  // the largest max_depth_m of camera_ingest

void requireSize(const cv::Mat& image, const Pinhole& camera, const char* name) {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw std::invalid_argument(fmt::format("the {} image has {}x{} pixels, but its camera_info says {}x{}",
                                          name, image.cols, image.rows, camera.width, camera.height));
}

/// No camera_ingest sends such a depth. NaN is not wrong: nothing was measured.
bool isWrong(float z) { return (z < 0.0f) | (z > kFarthestDepth_m); }

/// Whether all depths are usable or NaN.
bool isUsable(const cv::Mat1f& depth) {
  for (int v = 0; v < depth.rows; ++v) {
    int unusable = 0;
    for (const float *z = depth[v], *end = z + depth.cols; z != end; ++z)
      unusable |= static_cast<int>(isWrong(*z));
    if (unusable != 0) return false;
  }
  return true;
}

/// Depth with 0 in place of negative and too large values. It is copied only if it has such values.
cv::Mat1f usableDepth(const cv::Mat1f& depth) {
  if (isUsable(depth)) return depth;
  cv::Mat1f usable = depth.clone();
  for (float& z : usable) z = isWrong(z) ? 0.0f : z;
  return usable;
}

}  // namespace

cv::Mat3b colorFromMessage(const sensor_msgs::Image& image) {
  const std::string encoding = usualEncoding(image.encoding);
  if (encoding == enc::TYPE_16UC1 || encoding == enc::TYPE_32FC1) {
    throw std::invalid_argument(
        fmt::format("the colour image's encoding is '{}', a depth encoding", encoding));
  }
  if (enc::isMono(encoding)) {
    throw std::invalid_argument(fmt::format(
        "the colour image's encoding is '{}', which has no colours; set color:= to the topic of a colour "
        "camera (rgb8, bgr8, rgba8 or bgra8)",
        image.encoding));
  }
  const cv::Mat bgr = pixelsAs(image, enc::BGR8, "colour");
  return bgr.data == image.data.data() ? bgr.clone() : bgr;
}

cv::Mat depthFromMessage(const sensor_msgs::Image& image) {
  // Some drivers call depth in millimetres mono16.
  const std::string encoding = usualEncoding(image.encoding);
  if (encoding != enc::TYPE_16UC1 && encoding != enc::MONO16 && encoding != enc::TYPE_32FC1) {
    throw std::invalid_argument(
        fmt::format("the depth image's encoding is '{}'; expected 16UC1 [mm] or 32FC1 [m]",
                    image.encoding.substr(0, 60)));
  }
  return pixelsOf(image, "depth");
}

RgbdFrame frameFromRectified(const sensor_msgs::Image& color, const sensor_msgs::Image& depth,
                             const sensor_msgs::CameraInfo& info) {
  const Pinhole camera = pinholeFromMessage(info);
  if (depth.encoding != enc::TYPE_32FC1) {
    throw std::invalid_argument(
        fmt::format("the rectified depth image's encoding is '{}'; expected 32FC1 [m]", depth.encoding));
  }
  const cv::Mat bgr = pixelsAs(color, enc::BGR8, "colour"), metres = pixelsOf(depth, "depth");
  requireSize(bgr, camera, "colour");
  requireSize(metres, camera, "depth");
  return {toNanoseconds(color.header.stamp), camera, bgr, usableDepth(metres)};
}

cv::Mat1b maskFromMessage(const sensor_msgs::Image& image) {
  const cv::Mat1b mask = pixelsAs(image, enc::MONO8, "mask");
  return mask.data == image.data.data() ? cv::Mat1b(mask.clone()) : mask;
}

bool isUsualColor(const sensor_msgs::Image& image) {
  if (image.encoding != enc::BGR8 && image.encoding != enc::RGB8) return false;
  pixelsOf(image, "colour");  // throws
  return true;
}

sensor_msgs::ImagePtr toMessage(const cv::Mat& image, const std_msgs::Header& header) {
  return cv_bridge::CvImage(header, image.type() == CV_32FC1 ? enc::TYPE_32FC1 : enc::BGR8, image)
      .toImageMsg();
}

sensor_msgs::PointCloud2Ptr toMessage(const std::vector<ColoredPoint>& points, int width,
                                      const std_msgs::Header& header) {
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  cloud->header = header;
  cloud->width = width > 0 ? static_cast<std::uint32_t>(width) : static_cast<std::uint32_t>(points.size());
  cloud->height = width > 0 ? static_cast<std::uint32_t>(points.size()) / cloud->width : 1;
  cloud->is_dense = width == 0;
  cloud->point_step = sizeof(ColoredPoint);
  cloud->row_step = cloud->width * cloud->point_step;
  const char* const names[] = {"x", "y", "z", "rgb"};
  for (std::uint32_t k = 0; k < 4; ++k) {
    sensor_msgs::PointField field;
    field.name = names[k];
    field.offset = 4 * k;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud->fields.push_back(field);
  }
  cloud->data.resize(points.size() * sizeof(ColoredPoint));
  if (!points.empty()) std::memcpy(cloud->data.data(), points.data(), cloud->data.size());
  return cloud;
}

}  // namespace softbody

#include "softbody_tracking/ros/conversions.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <cstring>
#include <set>
#include <stdexcept>

#include "softbody_common/plausibility.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"

namespace enc = sensor_msgs::image_encodings;

namespace softbody {
namespace {

constexpr double kFarthestDepth_m = 100.0;  // the largest max_depth_m of camera_ingest

void checkLayout(const sensor_msgs::Image& image, const char* name) {
  const bool empty = image.width == 0 || image.height == 0;
  if (empty || image.width > kLargestImageSide || image.height > kLargestImageSide) {
    throw std::invalid_argument(fmt::format("the {} image has {}x{} pixels; allowed: 1 to {} a side", name,
                                            image.width, image.height, kLargestImageSide));
  }
  std::size_t bytes = 0;
  try {
    bytes = static_cast<std::size_t>(enc::numChannels(image.encoding) * enc::bitDepth(image.encoding) / 8);
  } catch (const std::runtime_error&) {
    throw std::invalid_argument(fmt::format("the {} image's encoding '{}' is unknown", name, image.encoding));
  }
  if (image.step < image.width * bytes ||
      image.data.size() < static_cast<std::size_t>(image.step) * image.height) {
    throw std::invalid_argument(
        fmt::format("the {} image is truncated: {} bytes in rows of {} for {}x{} pixels of {}", name,
                    image.data.size(), image.step, image.width, image.height, image.encoding));
  }
}

/// A view without a reference to the message: the caller's message must outlive it.
cv_bridge::CvImageConstPtr share(const sensor_msgs::Image& image, const std::string& encoding,
                                 const char* name) {
  try {
    return cv_bridge::toCvShare(image, boost::shared_ptr<void const>(), encoding);
  } catch (const std::exception& error) {  // cv_bridge::Exception, or cv::Exception from the conversion
    throw std::invalid_argument(
        fmt::format("the {} image's encoding '{}' cannot be used: {}", name, image.encoding, error.what()));
  }
}

/// The depth of an image that has been checked. cv_bridge 1.16 swaps the bytes of a big-endian image, but
/// returns them as bytes.
cv::Mat sharedDepth(const sensor_msgs::Image& message) {
  cv::Mat image = share(message, "", "depth")->image;
  const int type = message.encoding == enc::TYPE_32FC1 ? CV_32FC1 : CV_16UC1;
  if (image.type() == type) return image;
  return cv::Mat(image.rows, image.cols, type, image.data, image.step).clone();
}

void requireSize(const cv::Mat& image, const Pinhole& camera, const char* name) {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw std::invalid_argument(fmt::format("the {} image has {}x{} pixels, but its camera_info says {}x{}",
                                          name, image.cols, image.rows, camera.width, camera.height));
}

/// Depth with 0 in place of NaN, negative and too large values. It is copied only if it has such values.
cv::Mat1f usableDepth(const cv::Mat& depth) {
  if (cv::checkRange(depth, true, nullptr, 0.0, kFarthestDepth_m)) return depth;
  cv::Mat1f usable = depth.clone();
  for (float& z : usable) z = z >= 0.0f && z < kFarthestDepth_m ? z : 0.0f;  // false for NaN
  return usable;
}

cv::Matx33d matrix(const boost::array<double, 9>& values) { return cv::Matx33d(values.data()); }

}  // namespace

cv::Mat3b colorFromMessage(const sensor_msgs::Image& image) {
  checkLayout(image, "colour");
  const std::set<std::string> depth_only{enc::TYPE_16UC1, enc::TYPE_32FC1};
  if (depth_only.count(image.encoding) != 0) {
    throw std::invalid_argument(
        fmt::format("the colour image's encoding is '{}', a depth encoding", image.encoding));
  }
  if (enc::isMono(image.encoding)) {
    throw std::invalid_argument(fmt::format(
        "the colour image's encoding is '{}', which has no colours; set color:= to the topic of a colour "
        "camera (rgb8, bgr8, rgba8 or bgra8)",
        image.encoding));
  }
  const cv_bridge::CvImageConstPtr bgr = share(image, enc::BGR8, "colour");
  return bgr->image.data == image.data.data() ? bgr->image.clone() : bgr->image;
}

cv::Mat depthFromMessage(const sensor_msgs::Image& image) {
  checkLayout(image, "depth");
  // Some drivers call depth in millimetres mono16.
  const std::set<std::string> allowed{enc::TYPE_16UC1, enc::MONO16, enc::TYPE_32FC1};
  if (allowed.count(image.encoding) == 0) {
    throw std::invalid_argument(
        fmt::format("the depth image's encoding is '{}'; expected 16UC1 [mm] or 32FC1 [m]", image.encoding));
  }
  return sharedDepth(image);
}

Distortion distortionFromMessage(const sensor_msgs::CameraInfo& info) {
  const std::set<std::string> models{"", "plumb_bob", "rational_polynomial", "equidistant"};
  if (models.count(info.distortion_model) == 0) {
    throw std::invalid_argument(
        fmt::format("camera_info: the distortion model '{}' is unknown; known: plumb_bob, "
                    "rational_polynomial, equidistant",
                    info.distortion_model));
  }
  Distortion distortion;
  distortion.K = matrix(info.K);
  // R is all zero in a message that was not filled in.
  if (matrix(info.R) != cv::Matx33d::zeros()) distortion.R = matrix(info.R);
  distortion.coefficients = info.D;
  distortion.fisheye = info.distortion_model == "equidistant";
  return distortion;
}

RgbdFrame frameFromMessages(const sensor_msgs::Image& color, const sensor_msgs::Image* depth,
                            const sensor_msgs::CameraInfo& info, CameraIngest* ingest,
                            const DepthCamera* depth_camera) {
  const cv::Mat3b bgr = colorFromMessage(color);
  const cv::Mat raw_depth = depth != nullptr ? depthFromMessage(*depth) : cv::Mat();
  return ingest->process(bgr, raw_depth, distortionFromMessage(info), pinholeFromMessage(info),
                         toNanoseconds(color.header.stamp), depth_camera);
}

RgbdFrame frameFromRectified(const sensor_msgs::Image& color, const sensor_msgs::Image& depth,
                             const sensor_msgs::CameraInfo& info) {
  const Pinhole camera = pinholeFromMessage(info);
  checkLayout(color, "colour");
  checkLayout(depth, "depth");
  if (depth.encoding != enc::TYPE_32FC1) {
    throw std::invalid_argument(
        fmt::format("the rectified depth image's encoding is '{}'; expected 32FC1 [m]", depth.encoding));
  }
  const cv::Mat bgr = share(color, enc::BGR8, "colour")->image, metres = sharedDepth(depth);
  requireSize(bgr, camera, "colour");
  requireSize(metres, camera, "depth");
  return {toNanoseconds(color.header.stamp), camera, bgr, usableDepth(metres)};
}

cv::Mat1b maskFromMessage(const sensor_msgs::Image& image) {
  checkLayout(image, "mask");
  const cv::Mat1b mask = share(image, enc::MONO8, "mask")->image;
  return mask.data == image.data.data() ? cv::Mat1b(mask.clone()) : mask;
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

#include "softbody_tracking/ros/conversions.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <cstring>
#include <set>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"

namespace enc = sensor_msgs::image_encodings;

namespace softbody {
namespace {

// Pixels in a row or column. Products of a corrupt header's numbers must not overflow.
constexpr std::uint32_t kMaxSide = 1u << 14;

void checkLayout(const sensor_msgs::Image& image, const char* name) {
  if (image.width == 0 || image.height == 0 || image.width > kMaxSide || image.height > kMaxSide) {
    throw std::invalid_argument(
        fmt::format("the {} image has {}x{} pixels", name, image.width, image.height));
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

cv::Matx33d matrix(const boost::array<double, 9>& values) { return cv::Matx33d(values.data()); }

}  // namespace

cv::Mat3b colorFromMessage(const sensor_msgs::Image& image) {
  checkLayout(image, "colour");
  const std::set<std::string> depth_only{enc::TYPE_16UC1, enc::TYPE_32FC1};
  if (depth_only.count(image.encoding) != 0) {
    throw std::invalid_argument(
        fmt::format("the colour image's encoding is '{}', a depth encoding", image.encoding));
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
  return share(image, "", "depth")->image;
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
                            const sensor_msgs::CameraInfo& info, CameraIngest* ingest) {
  const cv::Mat3b bgr = colorFromMessage(color);
  const cv::Mat raw_depth = depth != nullptr ? depthFromMessage(*depth) : cv::Mat();
  return ingest->process(bgr, raw_depth, distortionFromMessage(info), pinholeFromMessage(info),
                         toNanoseconds(color.header.stamp));
}

std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
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

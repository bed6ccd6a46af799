#include "softbody_tracking/ros/camera_reader.h"

#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "ros/camera_info.h"
#include "ros/image_pixels.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/ros/conversions.h"

namespace enc = sensor_msgs::image_encodings;

namespace softbody {
namespace {

constexpr double kSameFocalLength = 0.01, kSameCentre_px = 2.0;
// Two cameras nearer than this are one: far below a pixel at any distance.
constexpr double kSamePlace_m = 1e-4, kSameTurn_rad = 1e-4;

/// A camera as its CameraInfo describes it, for images of one size.
struct Lens {
  Pinhole rectified;
  Distortion distortion;
};

/// Whether the images of a topic are rectified by the names of image_proc, for example
/// /rgb/image_rect_color/compressed.
bool isRectified(std::string topic) {
  for (const std::string transport : {"/compressed", "/compressedDepth"}) {
    if (topic.size() > transport.size() &&
        topic.compare(topic.size() - transport.size(), std::string::npos, transport) == 0)
      topic.resize(topic.size() - transport.size());
  }
  return topic.compare(topic.rfind('/') + 1, 10, "image_rect") == 0;
}

Lens lensOf(const sensor_msgs::CameraInfo& info, bool rectified) {
  Lens lens{pinholeFromMessage(info), rectified ? Distortion() : distortionFromMessage(info)};
  checkDistortion(lens.distortion, lens.rectified);
  return lens;
}

bool areAlike(const Pinhole& a, const Pinhole& b) {
  const auto near = [](double x, double y, double tolerance) { return std::abs(x - y) <= tolerance; };
  return a.width == b.width && a.height == b.height && near(a.fx, b.fx, kSameFocalLength * a.fx) &&
         near(a.fy, b.fy, kSameFocalLength * a.fy) && near(a.cx, b.cx, kSameCentre_px) &&
         near(a.cy, b.cy, kSameCentre_px);
}

bool isIdentity(const Eigen::Isometry3d& T) {
  return T.translation().norm() < kSamePlace_m && Eigen::AngleAxisd(T.linear()).angle() < kSameTurn_rad;
}

/// The pose of depth's camera in colour's.
Eigen::Isometry3d depthInColor(const std_msgs::Header& color, const std_msgs::Header& depth,
                               const TransformLookup& lookup) try {
  const std::string target = withoutSlash(color.frame_id), source = withoutSlash(depth.frame_id);
  const bool same = target == source || target.empty() || source.empty();
  return same ? Eigen::Isometry3d::Identity() : lookup(target, source, depth.stamp);
} catch (const std::exception& error) {
  throw std::invalid_argument(fmt::format(
      "depth is in frame '{}', colour in '{}', and tf does not say where the one is in the other "
      "({}): publish this transform on /tf_static, or set depth:= to the driver's registered depth, "
      "which has colour's frame",
      depth.frame_id, color.frame_id, error.what()));
}

/// Nothing: depth is registered to colour.
std::optional<DepthCamera> depthCameraOf(const CameraMessages& messages, const Lens& color,
                                         bool depth_rectified, const TransformLookup& lookup) {
  const sensor_msgs::Image& depth = *messages.depth;
  const Eigen::Isometry3d T_color_depth = depthInColor(messages.color.header, depth.header, lookup);
  const bool same_size = depth.width == messages.color.width && depth.height == messages.color.height;
  if (messages.depth_info == nullptr) {
    if (same_size && isIdentity(T_color_depth)) return std::nullopt;
    throw std::invalid_argument(fmt::format(
        "depth is not registered to colour ({}x{} and {}x{} pixels, in the frames '{}' and '{}'), and "
        "depth's camera_info is missing: set depth_info:= to its topic, or depth:= to the driver's "
        "registered depth "
        "(RealSense: align_depth:=true)",
        depth.width, depth.height, messages.color.width, messages.color.height, depth.header.frame_id,
        messages.color.header.frame_id));
  }
  const Lens lens =
      lensOf(infoOfImage(*messages.depth_info, depth.width, depth.height, "depth"), depth_rectified);
  if (areAlike(color.rectified, lens.rectified) && isIdentity(T_color_depth)) return std::nullopt;
  return DepthCamera{lens.rectified, lens.distortion, T_color_depth};
}

}  // namespace

CameraReader::CameraReader(Config config, TransformLookup lookup, Note note)
    : config_(std::move(config)),
      color_rectified_(isRectified(config_.color_topic)),
      depth_rectified_(isRectified(config_.depth_topic)),
      lookup_(std::move(lookup)),
      note_(std::move(note)) {}

CameraImages CameraReader::read(const CameraMessages& messages) {
  const cv::Mat3b color = colorFromMessage(messages.color);
  CameraImages images = readWithoutColor(messages);
  images.color = color;
  return images;
}

CameraImages CameraReader::readWithoutColor(const CameraMessages& messages) {
  const sensor_msgs::Image& color = messages.color;
  const Lens lens =
      lensOf(infoOfImage(messages.color_info, color.width, color.height, "colour"), color_rectified_);
  CameraImages images;
  if (messages.depth != nullptr) {
    images.depth = depthFromMessage(*messages.depth);
    images.depth_camera = depthCameraOf(messages, lens, depth_rectified_, lookup_);
  }
  images.distortion = lens.distortion;
  images.rectified = lens.rectified;
  images.stamp = toNanoseconds(color.header.stamp);
  images.depth_unit_m = config_.depth_scale;
  images.registered_to_rectified = depth_rectified_;
  tellAbout(messages, images);
  return images;
}

void CameraReader::tellAbout(const CameraMessages& messages, const CameraImages& images) {
  const std::vector<double>& D = messages.color_info.D;
  if (color_rectified_ && std::any_of(D.begin(), D.end(), [](double d) { return d != 0.0; }))
    tell(
        fmt::format("{} is rectified by its name, so D of its camera_info is taken as 0, and P as its camera",
                    config_.color_topic));
  if (messages.color.encoding.compare(0, 2, "8U") == 0)
    tell(fmt::format(
        "{} has encoding '{}', which does not name its colours: taken as {}; name them in the driver "
        "(cv2_to_imgmsg(image, \"bgr8\"))",
        config_.color_topic, messages.color.encoding, usualEncoding(messages.color.encoding)));
  if (images.depth_camera)
    tell(fmt::format("{} is not registered to {}, so it is registered here, by the two camera_infos and tf",
                     config_.depth_topic, config_.color_topic));
  const sensor_msgs::CameraInfo& info = messages.color_info;
  const bool whole = info.width == messages.color.width && info.height == messages.color.height;
  if (whole && (info.binning_x > 1 || info.binning_y > 1))
    tell(fmt::format("{} has the size of its camera_info, so the binning there is ignored",
                     config_.color_topic));
}

void CameraReader::tell(const std::string& sentence) {
  if (told_.insert(sentence).second) note_(sentence);
}

}  // namespace softbody

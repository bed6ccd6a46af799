#include "softbody_tracking/camera/camera_ingest.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "camera/depth_registration.h"
#include "camera/flying_pixels.h"
#include "camera/rectifier.h"

namespace softbody {
namespace {

std::string sizeOf(const cv::Mat& image) { return fmt::format("{}x{}", image.cols, image.rows); }

void checkColor(const cv::Mat3b& color, const Pinhole& camera) {
  if (color.empty()) throw std::invalid_argument("the colour image is empty");
  if (color.cols != camera.width || color.rows != camera.height) {
    throw std::invalid_argument(fmt::format("the colour image has {} pixels, but its camera_info says {}x{}",
                                            sizeOf(color), camera.width, camera.height));
  }
}

void checkDepth(const cv::Mat& depth, const Pinhole& camera) {
  if (depth.cols != camera.width || depth.rows != camera.height) {
    throw std::invalid_argument(fmt::format("the depth image has {} pixels, but its camera_info says {}x{}",
                                            sizeOf(depth), camera.width, camera.height));
  }
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw std::invalid_argument(fmt::format("the depth image is {}; expected 16UC1 [mm] or 32FC1 [m]",
                                            cv::typeToString(depth.type())));
  }
}

/// From the raw to the rectified camera.
Eigen::AngleAxisd rotation(const Distortion& distortion) {
  return Eigen::AngleAxisd(
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(distortion.R.val).eval());
}

/// Depth in metres, and 0 for depth out of range. NaN fails both comparisons.
template <typename Depth>
void metresInRange(const cv::Mat& depth, float unit_m, float min, float max, cv::Mat1f* metres) {
  metres->create(depth.size());
  for (int v = 0; v < depth.rows; ++v) {
    const Depth* in = depth.ptr<Depth>(v);
    float* out = (*metres)[v];
    for (int u = 0; u < depth.cols; ++u) {
      const float z = static_cast<float>(in[u]) * unit_m;
      out[u] = z >= min && z <= max ? z : 0.0f;
    }
  }
}

}  // namespace

CameraIngestConfig readCameraIngestConfig(Parameters& parameters) {
  CameraIngestConfig config;
  config.edge_jump_ratio = parameters.number("edge_jump_ratio", config.edge_jump_ratio, 0.001, 1.0);
  config.min_depth_m = parameters.number("min_depth_m", config.min_depth_m, 0.001, 100.0);
  config.max_depth_m = parameters.number("max_depth_m", config.max_depth_m, config.min_depth_m, 100.0);
  return config;
}

struct CameraIngest::Implementation {
  explicit Implementation(const CameraIngestConfig& c) : config(c), filter(c.edge_jump_ratio) {}

  void cleanDepth(const CameraImages& images, cv::Mat1f* result) {
    const cv::Mat& raw = images.depth;
    const auto unit_m = static_cast<float>(unitOf(images));
    const auto min = config.keep_all_depth ? 0.0f : static_cast<float>(config.min_depth_m);
    const auto max =
        config.keep_all_depth ? std::numeric_limits<float>::max() : static_cast<float>(config.max_depth_m);
    cv::Mat1f* const in_range = config.keep_all_depth ? result : &metres;
    if (raw.type() == CV_16UC1) {
      metresInRange<std::uint16_t>(raw, unit_m, min, max, in_range);
    } else {
      metresInRange<float>(raw, unit_m, min, max, in_range);
    }
    if (!config.keep_all_depth) filter.apply(metres, result);
  }

  /// The result has its own memory, because the caller keeps it. Intermediate images are reused.
  cv::Mat1f rectifiedDepth(const CameraImages& images, const Rectifier* rectifier) {
    cv::Mat1f result;
    if (rectifier == nullptr || rectifier->isIdentity()) {
      cleanDepth(images, &result);
      return result;
    }
    cleanDepth(images, &clean);
    return rectifier->depth(clean);
  }

  /// Depth of its own camera, as the rectified colour camera sees it.
  cv::Mat1f registered(const CameraImages& images) {
    const DepthCamera& camera = *images.depth_camera;
    depth_rectifier.setCamera(camera.distortion, camera.rectified);
    const Eigen::Isometry3d T_rectified_color(rotation(images.distortion)),
        T_depth_rectified(rotation(camera.distortion).inverse());
    return registeredDepth(rectifiedDepth(images, &depth_rectifier), camera.rectified,
                           T_rectified_color * camera.T_color_depth * T_depth_rectified, images.rectified);
  }

  CameraIngestConfig config;
  FlyingPixelFilter filter;
  Rectifier rectifier, depth_rectifier;
  cv::Mat1f metres, clean;
};

CameraIngest::CameraIngest(const CameraIngestConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}
CameraIngest::~CameraIngest() = default;

RgbdFrame CameraIngest::process(const CameraImages& images) {
  const cv::Mat& depth = images.depth;
  checkColor(images.color, images.rectified);
  if (!depth.empty())
    checkDepth(depth, images.depth_camera ? images.depth_camera->rectified : images.rectified);
  Rectifier& rectifier = implementation_->rectifier;
  rectifier.setCamera(images.distortion, images.rectified);
  RgbdFrame frame;
  frame.stamp = images.stamp;
  frame.pass = images.pass;
  frame.camera = images.rectified;
  frame.color = rectifier.color(images.color);
  if (depth.empty()) {
    frame.depth = cv::Mat1f::zeros(images.color.size());
  } else if (images.depth_camera) {
    frame.depth = implementation_->registered(images);
  } else {
    frame.depth =
        implementation_->rectifiedDepth(images, images.registered_to_rectified ? nullptr : &rectifier);
  }
  return frame;
}

}  // namespace softbody

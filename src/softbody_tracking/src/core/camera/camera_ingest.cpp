#include "softbody_tracking/camera/camera_ingest.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "camera/depth_kernel.h"
#include "camera/depth_registration.h"
#include "camera/rectifier.h"

namespace softbody {
namespace {

// Two neighbouring pixels belong to one surface if their depths differ by less than this share of z: surfaces
// are kept up to a slant of about atan(kEdgeJump * focal length in px), 80 degrees at 275 px, 85 at 600.
constexpr float kEdgeJump = 0.02f;

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

void requireDepthRange(const CameraIngestConfig& config) {
  if (config.max_depth_m >= config.min_depth_m) return;
  throw std::invalid_argument(fmt::format("max_depth_m is {}; allowed: min_depth_m, which is {}, or more",
                                          config.max_depth_m, config.min_depth_m));
}

ParameterTable<CameraIngestConfig> makeCameraIngestTable() {
  using Config = CameraIngestConfig;
  ParameterTable<Config> table;
  table.group("camera_ingest");
  table.number("min_depth_m", &Config::min_depth_m, {0.001, 100.0}, "m",
               "smallest depth that is used: what the camera cannot measure nearer", Change::kLive);
  table.number("max_depth_m", &Config::max_depth_m, {0.001, 100.0}, "m",
               "largest depth that is used, at least `min_depth_m`: less for a camera that is noisy far away",
               Change::kLive);
  table.check(requireDepthRange);
  return table;
}

}  // namespace

const ParameterTable<CameraIngestConfig>& cameraIngestParameters() {
  static const ParameterTable<CameraIngestConfig> table = makeCameraIngestTable();
  return table;
}

struct CameraIngest::Implementation {
  explicit Implementation(const CameraIngestConfig& c) : config(c) {}

  DepthLimits limitsOf(const CameraImages& images) const {
    const auto unit_m = static_cast<float>(unitOf(images));
    if (config.keep_all_depth) return {unit_m};
    return {unit_m, static_cast<float>(config.min_depth_m), static_cast<float>(config.max_depth_m),
            kEdgeJump};
  }

  /// Intermediate images are reused.
  void rectify(const CameraImages& images, const Rectifier* rectifier, cv::Mat1f* result) {
    if (rectifier == nullptr || rectifier->isIdentity()) {
      cleaner.clean(images.depth, limitsOf(images), result);
    } else {
      cleaner.clean(images.depth, limitsOf(images), &clean);
      rectifier->depth(clean, result);
    }
  }

  /// Depth of its own camera, as the rectified colour camera sees it.
  void registerDepth(const CameraImages& images, cv::Mat1f* result) {
    const DepthCamera& camera = *images.depth_camera;
    depth_rectifier.setCamera(camera.distortion, camera.rectified);
    const Eigen::Isometry3d T_rectified_color(rotation(images.distortion)),
        T_depth_rectified(rotation(camera.distortion).inverse());
    rectify(images, &depth_rectifier, &own_depth);
    registeredDepth(own_depth, camera.rectified, T_rectified_color * camera.T_color_depth * T_depth_rectified,
                    images.rectified)
        .copyTo(*result);
  }

  CameraIngestConfig config;
  DepthCleaner cleaner;
  Rectifier rectifier, depth_rectifier;
  cv::Mat1f clean, own_depth;
};

CameraIngest::CameraIngest(const CameraIngestConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}
CameraIngest::~CameraIngest() = default;

cv::Mat3b CameraIngest::color(const CameraImages& images) {
  checkColor(images.color, images.rectified);
  implementation_->rectifier.setCamera(images.distortion, images.rectified);
  return implementation_->rectifier.color(images.color);
}

void CameraIngest::depth(const CameraImages& images, cv::Mat1f* depth) {
  const cv::Size size(images.rectified.width, images.rectified.height);
  if (images.depth.empty()) {
    depth->create(size);
    depth->setTo(std::numeric_limits<float>::quiet_NaN());
    return;
  }
  checkDepth(images.depth, images.depth_camera ? images.depth_camera->rectified : images.rectified);
  Rectifier& rectifier = implementation_->rectifier;
  rectifier.setCamera(images.distortion, images.rectified);
  if (images.depth_camera)
    implementation_->registerDepth(images, depth);
  else
    implementation_->rectify(images, images.registered_to_rectified ? nullptr : &rectifier, depth);
}

RgbdFrame CameraIngest::process(const CameraImages& images) {
  RgbdFrame frame;
  frame.stamp = images.stamp;
  frame.pass = images.pass;
  frame.camera = images.rectified;
  frame.color = color(images);
  depth(images, &frame.depth);
  return frame;
}

}  // namespace softbody

#include "ros/camera_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>

namespace softbody {
namespace {

/// The part of the sensor that the image shows [px of the sensor], and how many of its pixels make one.
struct Window {
  std::uint32_t x = 0, y = 0, width = 0, height = 0, binning_x = 1, binning_y = 1;
};

Window windowOf(const sensor_msgs::CameraInfo& info) {
  Window window{info.roi.x_offset,
                info.roi.y_offset,
                info.roi.width,
                info.roi.height,
                std::max(1u, info.binning_x),
                std::max(1u, info.binning_y)};
  if (info.roi.width == 0 || info.roi.height == 0) {  // the whole sensor
    window.width = info.width;
    window.height = info.height;
  }
  return window;
}

/// Whether so many pixels make an image of this size. Pixels that do not fill the last one may be left out.
bool makes(std::uint32_t pixels, std::uint32_t binning, std::uint32_t size) {
  return pixels / binning == size || (pixels + binning - 1) / binning == size;
}

std::string told(const sensor_msgs::CameraInfo& info, const Window& window) {
  std::string text = fmt::format("{}x{}", info.width, info.height);
  if (window.width != info.width || window.height != info.height)
    text += fmt::format(" with a region of interest of {}x{}", window.width, window.height);
  if (window.binning_x > 1 || window.binning_y > 1)
    text += fmt::format(" with binning {}x{}", window.binning_x, window.binning_y);
  return text;
}

/// fx, skew and cx, or fy and cy, of a row of K or P. The last one of P is -fx times the baseline.
template <typename Row>
void scaleRow(double offset, double binning, int columns, std::size_t centre, Row row) {
  row[centre] -= offset;
  for (int k = 0; k < columns; ++k) row[k] /= binning;
}

std::vector<double> withoutTrailingZeros(std::vector<double> coefficients) {
  while (!coefficients.empty() && coefficients.back() == 0.0) coefficients.pop_back();
  return coefficients;
}

/// The models by the names of REP 104 and of calibration tools.
bool isFisheye(const std::string& model) {
  std::string small = model;
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto isOneOf = [&small](const auto& names) {
    return std::find(names.begin(), names.end(), small) != names.end();
  };
  if (isOneOf(std::array<std::string, 2>{"equidistant", "fisheye"})) return true;
  if (isOneOf(std::array<std::string, 4>{"", "plumb_bob", "rational_polynomial", "radtan"})) return false;
  throw std::invalid_argument(
      fmt::format("camera_info: the distortion model '{}' is unknown; known: plumb_bob, "
                  "rational_polynomial, equidistant; rectify the images first (image_proc)",
                  model.substr(0, 60)));
}

}  // namespace

sensor_msgs::CameraInfo infoOfImage(const sensor_msgs::CameraInfo& info, std::uint32_t width,
                                    std::uint32_t height, const char* name) {
  sensor_msgs::CameraInfo camera = info;
  camera.width = width;
  camera.height = height;
  camera.binning_x = camera.binning_y = 0;
  camera.roi = sensor_msgs::RegionOfInterest();
  const bool unknown_size = info.width == 0 && info.height == 0,
             whole = info.width == width && info.height == height;
  if (unknown_size || whole) return camera;
  const Window window = windowOf(info);
  if (!makes(window.width, window.binning_x, width) || !makes(window.height, window.binning_y, height)) {
    throw std::invalid_argument(
        fmt::format("the {} image has {}x{} pixels, but its camera_info says {}; send the camera_info of "
                    "these images, with binning and roi if they show a part of the sensor",
                    name, width, height, told(info, window)));
  }
  scaleRow(window.x, window.binning_x, 3, 2, camera.K.begin());
  scaleRow(window.y, window.binning_y, 3, 2, camera.K.begin() + 3);
  scaleRow(window.x, window.binning_x, 4, 2, camera.P.begin());
  scaleRow(window.y, window.binning_y, 4, 2, camera.P.begin() + 4);
  return camera;
}

Distortion distortionFromMessage(const sensor_msgs::CameraInfo& info) {
  const auto matrix = [](const boost::array<double, 9>& values) { return cv::Matx33d(values.data()); };
  Distortion distortion;
  distortion.fisheye = isFisheye(info.distortion_model);
  distortion.K = matrix(info.K);
  // R is all zero in a message that was not filled in.
  if (matrix(info.R) != cv::Matx33d::zeros()) distortion.R = matrix(info.R);
  distortion.coefficients = withoutTrailingZeros(info.D);
  // OpenCV knows these numbers of coefficients; more zeros change nothing.
  const std::vector<std::size_t> counts =
      distortion.fisheye ? std::vector<std::size_t>{4} : std::vector<std::size_t>{0, 4, 5, 8, 12, 14};
  const auto count = std::lower_bound(counts.begin(), counts.end(), distortion.coefficients.size());
  if (count == counts.end()) {
    throw std::invalid_argument(
        fmt::format("camera_info: D has {} coefficients; a lens of the model '{}' has up to {}",
                    distortion.coefficients.size(), info.distortion_model, counts.back()));
  }
  distortion.coefficients.resize(*count, 0.0);
  return distortion;
}

}  // namespace softbody

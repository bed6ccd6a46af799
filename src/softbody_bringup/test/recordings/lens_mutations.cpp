#include <cv_bridge/cv_bridge.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/mutations.h"

namespace softbody::recordings {
namespace {

using sensor_msgs::CameraInfo;

Change onInfos(const std::function<void(CameraInfo*)>& change) {
  return [change](Recording* recording, Random*) {
    for (Frame& frame : recording->frames) {
      change(&*frame.color_info);
      change(&*frame.depth_info);
    }
  };
}

Change onColorInfo(const std::function<void(CameraInfo*)>& change) {
  return [change](Recording* recording, Random*) {
    for (Frame& frame : recording->frames) change(&*frame.color_info);
  };
}

/// The image as a part of a larger sensor with joined pixels.
void asPartOfSensor(std::uint32_t binning, std::uint32_t x, std::uint32_t y, CameraInfo* info) {
  info->roi.x_offset = x;
  info->roi.y_offset = y;
  info->roi.width = info->width * binning;
  info->roi.height = info->height * binning;
  info->roi.do_rectify = x % 2 != 0;
  info->width = info->width * binning + x + 10;
  info->height = info->height * binning + y + 10;
  info->binning_x = info->binning_y = binning;
  for (double* matrix : {info->K.data(), info->P.data()}) {
    const int columns = matrix == info->K.data() ? 3 : 4;
    for (int k = 0; k < 2 * columns; ++k) matrix[k] *= binning;
    matrix[2] += x;
    matrix[columns + 2] += y;
  }
}

struct Lens {
  const char* model;
  std::vector<double> D;
  std::size_t coefficients;  ///< with zeros at the end
};

/// Where the rectified image has what the raw one shows at each pixel.
cv::Mat2f rectifiedPlaces(const CameraInfo& info, const Lens& lens) {
  std::vector<cv::Point2f> raw, rectified;
  for (int v = 0; v < static_cast<int>(info.height); ++v)
    for (int u = 0; u < static_cast<int>(info.width); ++u)
      raw.emplace_back(static_cast<float>(u), static_cast<float>(v));
  const cv::Matx33d K(info.K.data());
  if (std::string(lens.model) == "equidistant")
    cv::fisheye::undistortPoints(raw, rectified, K, lens.D, cv::noArray(), K);
  else
    cv::undistortPoints(raw, rectified, K, lens.D, cv::noArray(), K);
  return cv::Mat2f(static_cast<int>(info.height), static_cast<int>(info.width),
                   reinterpret_cast<cv::Vec2f*>(rectified.data()))
      .clone();
}

/// The images as this lens shows them.
void distort(const Lens& lens, Recording* recording) {
  const cv::Mat2f places = rectifiedPlaces(*recording->frames.front().color_info, lens);
  for (Frame& frame : recording->frames) {
    const auto warp = [&places](int interpolation, sensor_msgs::Image* image) {
      const cv_bridge::CvImagePtr before = cv_bridge::toCvCopy(*image);
      cv::Mat after;
      cv::remap(before->image, after, places, cv::noArray(), interpolation, cv::BORDER_CONSTANT);
      *image = *cv_bridge::CvImage(before->header, before->encoding, after).toImageMsg();
    };
    warp(cv::INTER_LINEAR, &*frame.color);
    warp(cv::INTER_NEAREST, &*frame.depth);
    for (CameraInfo* info : {&*frame.color_info, &*frame.depth_info}) {
      info->distortion_model = lens.model;
      info->D = lens.D;
      info->D.resize(lens.coefficients, 0.0);
    }
  }
}

void nameDepthFrame(const std::string& name, Recording* recording) {
  for (Frame& frame : recording->frames) frame.depth->header.frame_id = name;
}

/// @param x place of depth's frame in colour's [m].
void addDepthFrame(double x, const std::string& name, Recording* recording) {
  geometry_msgs::TransformStamped transform;
  transform.header = recording->frames.front().color->header;
  transform.child_frame_id = name;
  transform.transform.translation.x = x;
  transform.transform.rotation.w = 1.0;
  recording->tf_static.transforms.push_back(transform);
  nameDepthFrame(name, recording);
}

/// Depth as a camera at this place sees it: every pixel moves by fx x / z, the nearest one wins.
void moveDepthCamera(double x, Recording* recording) {
  addDepthFrame(x, "camera_depth_optical_frame", recording);
  for (Frame& frame : recording->frames) {
    const cv::Mat1w before = cv_bridge::toCvCopy(*frame.depth)->image;
    cv::Mat1w after = cv::Mat1w::zeros(before.size());
    for (int v = 0; v < before.rows; ++v) {
      for (int u = 0; u < before.cols; ++u) {
        const std::uint16_t z = before(v, u);
        if (z == 0) continue;
        const int to = static_cast<int>(std::lround(u - frame.depth_info->K[0] * x / (1e-3 * z)));
        if (to < 0 || to >= after.cols) continue;
        std::uint16_t& pixel = after(v, to);
        if (pixel == 0 || z < pixel) pixel = z;
      }
    }
    *frame.depth = *cv_bridge::CvImage(frame.depth->header, "16UC1", after).toImageMsg();
  }
}

/// Every second pixel of depth.
void halveDepth(bool with_info, Recording* recording) {
  for (Frame& frame : recording->frames) {
    const cv::Mat1w before = cv_bridge::toCvCopy(*frame.depth)->image;
    cv::Mat1w after(before.rows / 2, before.cols / 2);
    after.forEach([&before](std::uint16_t& z, const int* at) { z = before(2 * at[0], 2 * at[1]); });
    *frame.depth = *cv_bridge::CvImage(frame.depth->header, "16UC1", after).toImageMsg();
    CameraInfo& info = *frame.depth_info;
    info.width /= 2;
    info.height /= 2;
    for (std::size_t k = 0; k < 6; ++k) info.K[k] /= 2.0;
    for (std::size_t k = 0; k < 8; ++k) info.P[k] /= 2.0;
    if (!with_info) frame.depth_info.reset();
  }
}

std::vector<Mutation> infoMutations() {
  const int info = Mutation::kInfo;
  const auto part = [](std::uint32_t binning, std::uint32_t x, std::uint32_t y) {
    return onInfos([=](CameraInfo* i) { asPartOfSensor(binning, x, y, i); });
  };
  return {
      {"binned", true, info, part(2, 0, 0)},
      {"region of interest", true, info, part(1, 40, 33)},
      {"binned region to be rectified", true, info, part(3, 21, 8)},
      {"binning that was not done", true, info,
       onInfos([](CameraInfo* i) { i->binning_x = i->binning_y = 2; })},
      {"camera_info without a size", true, info, onInfos([](CameraInfo* i) { i->width = i->height = 0; })},
      {"camera_info of another size", false, info, onColorInfo([](CameraInfo* i) { i->width *= 2; })},
      {"no calibration", false, info, onInfos([](CameraInfo* i) { i->K.fill(0.0), i->P.fill(0.0); })},
      {"only P", true, info, onInfos([](CameraInfo* i) { i->K.fill(0.0); })},
      {"only K", true, info, onInfos([](CameraInfo* i) { i->P.fill(0.0), i->R.fill(0.0); })},
      {"unknown lens", false, info, onInfos([](CameraInfo* i) { i->distortion_model = "fov"; })},
      {"unnamed lens", true, info, onInfos([](CameraInfo* i) { i->distortion_model = "", i->D.clear(); })},
      {"NaN in D", false, info,
       onColorInfo([](CameraInfo* i) { i->D.assign(5, std::numeric_limits<double>::quiet_NaN()); })},
      {"zeros in D", true, info, onInfos([](CameraInfo* i) { i->D.assign(12, 0.0); })},
      {"twice the focal length", false, info,
       onInfos([](CameraInfo* i) { i->K[0] *= 2.0, i->K[4] *= 2.0, i->P[0] *= 2.0, i->P[5] *= 2.0; })}};
}

std::vector<Mutation> imageMutations() {
  const int images = Mutation::kColorPixels | Mutation::kDepthPixels | Mutation::kInfo;
  const auto with = [](const Lens& lens) { return [lens](Recording* r, Random*) { distort(lens, r); }; };
  return {{"plumb_bob with 4", true, images, with({"plumb_bob", {-0.2, 0.05, 0.001, -0.001}, 4})},
          {"plumb_bob with 5", true, images, with({"plumb_bob", {-0.2, 0.05, 0.001, -0.001, 0.01}, 5})},
          {"rational_polynomial with 8", true, images,
           with({"rational_polynomial", {0.3, -0.1, 0.001, 0.0, 0.02, 0.4, -0.1, 0.01}, 8})},
          {"rational_polynomial with 12", true, images,
           with({"rational_polynomial", {0.3, -0.1, 0.001, 0.0, 0.02, 0.4, -0.1, 0.01}, 12})},
          {"equidistant", true, images, with({"equidistant", {0.05, -0.01, 0.002, 0.0}, 4})},
          {"equidistant with zeros", true, images, with({"equidistant", {0.05, -0.01, 0.002, 0.0}, 5})},
          {"rectified topic with D", true, Mutation::kInfo | Mutation::kTopics, [](Recording* r, Random*) {
             r->topics.color = r->options.color = "/camera/color/image_rect_color";
             for (Frame& frame : r->frames) frame.color_info->D = {-0.35, 0.15, 0.0, 0.0, 0.0};
           }}};
}

std::vector<Mutation> depthCameraMutations() {
  const int frame = Mutation::kFrames, camera = frame | Mutation::kDepthPixels | Mutation::kInfo;
  return {{"colour's frame by another name", true, frame,
           [](Recording* r, Random*) { addDepthFrame(0.0, "aligned_depth", r); }},
          {"depth's frame without tf", false, frame,
           [](Recording* r, Random*) { nameDepthFrame("camera_depth_optical_frame", r); }},
          {"depth of its own camera", true, camera, [](Recording* r, Random*) { moveDepthCamera(0.015, r); }},
          {"depth of half the size", true, camera, [](Recording* r, Random*) { halveDepth(true, r); }, true},
          {"depth of half the size, not calibrated", false, camera,
           [](Recording* r, Random*) { halveDepth(false, r); }},
          {"depth beside colour", false, camera, [](Recording* r, Random*) {
             for (Frame& f : r->frames) {
               const cv::Mat1w depth = cv_bridge::toCvCopy(*f.depth)->image;
               cv::Mat1w moved = cv::Mat1w::zeros(depth.size());
               depth(cv::Rect(0, 0, depth.cols - 25, depth.rows))
                   .copyTo(moved(cv::Rect(25, 0, depth.cols - 25, depth.rows)));
               *f.depth = *cv_bridge::CvImage(f.depth->header, "16UC1", moved).toImageMsg();
             }
           }}};
}

}  // namespace

std::vector<Mutation> lensMutations() {
  std::vector<Mutation> all = infoMutations();
  for (const auto& more : {imageMutations(), depthCameraMutations()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace softbody::recordings

#include <cv_bridge/cv_bridge.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/mutations.h"

namespace softbody::recordings {
namespace {

/// Changes every image of a stream.
Change onColor(const std::function<void(sensor_msgs::Image*)>& change) {
  return [change](Recording* recording, Random*) {
    for (Frame& frame : recording->frames) change(&*frame.color);
  };
}

Change onDepth(const std::function<void(sensor_msgs::Image*)>& change) {
  return [change](Recording* recording, Random*) {
    for (Frame& frame : recording->frames) change(&*frame.depth);
  };
}

cv::Mat pixels(const sensor_msgs::Image& image) { return cv_bridge::toCvCopy(image)->image; }

void set(const cv::Mat& pixels, const std::string& encoding, sensor_msgs::Image* image) {
  *image = *cv_bridge::CvImage(image->header, encoding, pixels).toImageMsg();
}

void convert(const char* encoding, sensor_msgs::Image* color) {
  *color = *cv_bridge::toCvCopy(*color, encoding)->toImageMsg();
}

void scaleDepth(double factor, const char* encoding, sensor_msgs::Image* depth) {
  cv::Mat scaled;
  pixels(*depth).convertTo(scaled, std::string(encoding) == "32FC1" ? CV_32F : CV_16U, factor);
  set(scaled, encoding, depth);
}

void swapBytes(sensor_msgs::Image* depth) {
  const std::ptrdiff_t bytes = depth->encoding == "32FC1" ? 4 : 2;
  for (auto number = depth->data.begin(); number != depth->data.end(); number += bytes)
    std::reverse(number, number + bytes);
  depth->is_bigendian = 1;
}

void pad(std::uint32_t bytes, sensor_msgs::Image* image) {
  std::vector<std::uint8_t> rows;
  for (std::uint32_t v = 0; v < image->height; ++v) {
    const auto row = image->data.begin() + v * image->step;
    rows.insert(rows.end(), row, row + image->step);
    rows.insert(rows.end(), bytes, 0x5A);
  }
  image->data = rows;
  image->step += bytes;
}

/// One colour of two by two pixels, as a sensor with a filter gives it.
void toBayer(sensor_msgs::Image* color) {
  const cv::Mat3b bgr = cv_bridge::toCvCopy(*color, "bgr8")->image;
  cv::Mat1b raw(bgr.size());
  raw.forEach([&bgr](uchar& value, const int* at) {
    const int channel = at[0] % 2 == 0 ? (at[1] % 2 == 0 ? 2 : 1) : (at[1] % 2 == 0 ? 1 : 0);
    value = bgr(at[0], at[1])[channel];
  });
  set(raw, "bayer_rggb8", color);
}

Change compressColor(const char* extension, const char* format) {
  return [=](Recording* recording, Random*) {
    recording->compress_color = [=](const sensor_msgs::Image& color) {
      sensor_msgs::CompressedImage image;
      image.header = color.header;
      image.format = format;
      cv::imencode(extension, cv_bridge::toCvCopy(color, "bgr8")->image, image.data,
                   {cv::IMWRITE_JPEG_QUALITY, 95});
      return image;
    };
  };
}

/// @param kept bytes of the data.
Change compressDepth(const char* format, std::size_t kept = std::numeric_limits<std::size_t>::max()) {
  return [=](Recording* recording, Random*) {
    recording->compress_depth = [=](const sensor_msgs::Image& depth) {
      sensor_msgs::CompressedImage image;
      image.header = depth.header;
      image.format = format;
      cv::imencode(".png", pixels(depth), image.data);
      image.data.insert(image.data.begin(), 12, 0);  // what compressed_depth_image_transport writes first
      image.data.resize(std::min(kept, image.data.size()));
      return image;
    };
  };
}

std::vector<Mutation> colorMutations() {
  const int color = Mutation::kColorPixels;
  const auto to = [](const char* encoding) {
    return onColor([encoding](sensor_msgs::Image* image) { convert(encoding, image); });
  };
  const auto name = [](const char* encoding) {
    return onColor([encoding](sensor_msgs::Image* image) {
      convert("bgr8", image);
      image->encoding = encoding;
    });
  };
  return {
      {"rgb8", true, color, to("rgb8")},
      {"bgra8", true, color, to("bgra8")},
      {"rgba8", true, color, to("rgba8")},
      {"rgb16", true, color, to("rgb16")},
      {"8UC3", true, color, name("8UC3")},
      {"BGR8", true, color, name("BGR8")},
      {"bayer", true, color, onColor(toBayer)},
      {"grey", false, color, to("mono8")},
      {"unknown encoding", false, color, name("yuy2")},
      {"padded colour", true, color, onColor([](sensor_msgs::Image* image) { pad(7, image); })},
      {"short colour", false, color, onColor([](sensor_msgs::Image* image) { image->data.resize(1000); })},
      {"colour as big-endian", true, color,
       onColor([](sensor_msgs::Image* image) { image->is_bigendian = 1; })},
      {"jpeg", true, color, compressColor(".jpg", "rgb8; jpeg compressed bgr8")},
      {"png as jpeg", true, color, compressColor(".png", "jpeg")},
      {"no pixels", false, color,
       onColor([](sensor_msgs::Image* image) { image->width = image->height = 0; })}};
}

std::vector<Mutation> unitMutations() {
  const int depth = Mutation::kDepthPixels;
  const auto to = [](double factor, const char* encoding) {
    return onDepth([=](sensor_msgs::Image* image) { scaleDepth(factor, encoding, image); });
  };
  const auto withUnit = [](double factor, const char* encoding, double unit_m) {
    return [=](Recording* recording, Random*) {
      for (Frame& frame : recording->frames) scaleDepth(factor, encoding, &*frame.depth);
      recording->options.depth_scale = unit_m;
    };
  };
  return {{"metres", true, depth, to(0.001, "32FC1")},
          {"millimetres as metres", false, depth, to(1.0, "32FC1")},
          {"quarters of a millimetre", false, depth, to(4.0, "16UC1")},
          {"tenths of a millimetre", false, depth, to(10.0, "16UC1")},
          {"centimetres", false, depth, to(0.1, "16UC1")},
          {"quarters with depth_scale", true, depth, withUnit(4.0, "16UC1", 0.00025)},
          {"millimetres as 32FC1 with depth_scale", true, depth, withUnit(1.0, "32FC1", 0.001)},
          {"no depth", false, depth, to(0.0, "16UC1")}};
}

std::vector<Mutation> depthMutations() {
  const int depth = Mutation::kDepthPixels;
  return {{"big-endian", true, depth, onDepth(swapBytes)},
          {"padded depth", true, depth, onDepth([](sensor_msgs::Image* image) { pad(6, image); })},
          {"odd rows", true, depth, onDepth([](sensor_msgs::Image* image) { pad(3, image); })},
          {"big-endian and padded", true, depth,
           onDepth([](sensor_msgs::Image* image) { swapBytes(image), pad(10, image); })},
          {"last row without padding", true, depth, onDepth([](sensor_msgs::Image* image) {
             pad(6, image);
             image->data.resize(image->data.size() - 6);
           })},
          {"more bytes than rows", true, depth,
           onDepth([](sensor_msgs::Image* image) { image->data.resize(image->data.size() + 64); })},
          {"short depth", false, depth,
           onDepth([](sensor_msgs::Image* image) { image->data.resize(image->data.size() / 2); })},
          {"mono16", true, depth, onDepth([](sensor_msgs::Image* image) { image->encoding = "mono16"; })},
          {"8 bits of depth", false, depth, onDepth([](sensor_msgs::Image* image) {
             cv::Mat1b small;
             pixels(*image).convertTo(small, CV_8U, 0.1);
             set(small, "mono8", image);
           })},
          {"compressedDepth", true, depth, compressDepth("16UC1; compressedDepth png")},
          {"compressedDepth by another name", true, depth, compressDepth("png")},
          {"damaged compressedDepth", false, depth, compressDepth("16UC1; compressedDepth png", 40)}};
}

}  // namespace

std::vector<Mutation> cameraMutations() {
  std::vector<Mutation> all = colorMutations();
  for (const auto& more : {unitMutations(), depthMutations()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace softbody::recordings

#include <test_support/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "softbody_common/ros/camera_messages.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/ros/camera_reader.h"

namespace softbody {
namespace {

const Pinhole kCamera{64, 48, 60.0, 61.0, 31.0, 24.0};

/// The messages of one frame, to be written in another way by a test.
struct Messages {
  sensor_msgs::Image color, depth;
  sensor_msgs::CameraInfo color_info, depth_info;
  bool has_depth_info = true;
  CameraReader::Config config{"/camera/color/image_raw", "/camera/depth/image_raw"};
};

using Change = std::function<void(Messages*)>;

sensor_msgs::Image blankImage(const char* encoding, std::uint32_t bytes) {
  sensor_msgs::Image image;
  image.header.frame_id = "color";
  image.encoding = encoding;
  image.width = 64;
  image.height = 48;
  image.step = 64 * bytes;
  image.data.resize(std::size_t{image.step} * 48);
  return image;
}

Messages usualMessages() {
  Messages messages;
  std::mt19937 random(7);
  messages.color = blankImage("bgr8", 3);
  for (auto& byte : messages.color.data) byte = static_cast<std::uint8_t>(random());
  messages.depth = blankImage("16UC1", 2);
  for (std::size_t i = 0; i < messages.depth.data.size(); i += 2) {
    const auto z = static_cast<std::uint16_t>(random() % 5 == 0 ? 0 : 400 + random() % 500);
    std::memcpy(&messages.depth.data[i], &z, 2);
  }
  messages.color_info = messages.depth_info = toMessage(kCamera);
  return messages;
}

/// The two frames are 30 mm apart; "same" is colour's frame by another name.
Eigen::Isometry3d lookup(const std::string& target, const std::string& source, const ros::Time&) {
  if (target != "color" || (source != "depth" && source != "same")) throw std::runtime_error("no such frame");
  return Eigen::Isometry3d(Eigen::Translation3d(source == "depth" ? 0.03 : 0.0, 0.0, 0.0));
}

struct Outcome {
  RgbdFrame frame;
  CameraImages images;
  std::vector<std::string> notes;
};

Outcome read(const Messages& messages) {
  Outcome outcome;
  CameraReader reader(messages.config, lookup,
                      [&](const std::string& note) { outcome.notes.push_back(note); });
  for (int k = 0; k < 2; ++k)  // notes come once
    outcome.images = reader.read({messages.color, &messages.depth, messages.color_info,
                                  messages.has_depth_info ? &messages.depth_info : nullptr});
  CameraIngestConfig everything;
  everything.keep_all_depth = true;
  outcome.frame = CameraIngest(everything).process(outcome.images);
  return outcome;
}

/// Rows of the same pixels with bytes behind them.
void pad(std::uint32_t bytes, sensor_msgs::Image* image) {
  std::vector<std::uint8_t> rows;
  for (std::uint32_t v = 0; v < image->height; ++v) {
    rows.insert(rows.end(), image->data.begin() + v * image->step,
                image->data.begin() + (v + 1) * image->step);
    rows.insert(rows.end(), bytes, 0xAB);
  }
  image->data = rows;
  image->step += bytes;
}

void swapBytes(std::size_t bytes, sensor_msgs::Image* image) {
  for (auto number = image->data.begin(); number != image->data.end();
       number += static_cast<std::ptrdiff_t>(bytes))
    std::reverse(number, number + static_cast<std::ptrdiff_t>(bytes));
  image->is_bigendian = 1 - image->is_bigendian;
}

void toMetres(float unit_m, sensor_msgs::Image* depth) {
  std::vector<std::uint8_t> data(depth->data.size() * 2);
  for (std::size_t i = 0; i < depth->data.size() / 2; ++i) {
    std::uint16_t z = 0;
    std::memcpy(&z, &depth->data[2 * i], 2);
    const float value = unit_m * static_cast<float>(z);
    std::memcpy(&data[4 * i], &value, 4);
  }
  depth->data = data;
  depth->step *= 2;
  depth->encoding = "32FC1";
}

void withAlpha(const char* encoding, sensor_msgs::Image* color) {
  std::vector<std::uint8_t> data;
  for (std::size_t i = 0; i < color->data.size(); i += 3) {
    data.insert(data.end(), color->data.begin() + static_cast<std::ptrdiff_t>(i),
                color->data.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    data.push_back(200);
  }
  color->data = data;
  color->step = 64 * 4;
  color->encoding = encoding;
}

/// A sensor of which the image is a part, with pixels that are joined.
void asPartOfSensor(std::uint32_t binning, std::uint32_t x, std::uint32_t y, sensor_msgs::CameraInfo* info) {
  info->width = 64 * binning + x + 50;
  info->height = 48 * binning + y + 20;
  info->binning_x = info->binning_y = binning;
  info->roi.x_offset = x;
  info->roi.y_offset = y;
  info->roi.width = 64 * binning;
  info->roi.height = 48 * binning + (binning > 1 ? 1 : 0);  // a row that does not fill a pixel
  for (auto* matrix : {info->K.data(), info->P.data()}) {
    const int columns = matrix == info->K.data() ? 3 : 4;
    for (int k = 0; k < 2 * columns; ++k) matrix[k] *= binning;
    matrix[2] += x;
    matrix[columns + 2] += y;
  }
}

/// Every way to write the same frame, and words of its note; none: nothing is said.
const std::map<std::string, std::pair<Change, std::string>> kSameFrame{
    {"big-endian depth", {[](Messages* m) { swapBytes(2, &m->depth); }, ""}},
    {"padded rows", {[](Messages* m) { pad(6, &m->depth), pad(5, &m->color); }, ""}},
    {"rows of an odd number of bytes", {[](Messages* m) { pad(3, &m->depth); }, ""}},
    {"no padding of the last row",
     {[](Messages* m) {
        pad(6, &m->depth);
        m->depth.data.resize(m->depth.data.size() - 6);
      },
      ""}},
    {"bytes behind the image", {[](Messages* m) { m->depth.data.resize(m->depth.data.size() + 9); }, ""}},
    {"big-endian with padding", {[](Messages* m) { swapBytes(2, &m->depth), pad(4, &m->depth); }, ""}},
    {"metres", {[](Messages* m) { toMetres(0.001f, &m->depth); }, ""}},
    {"big-endian metres", {[](Messages* m) { toMetres(0.001f, &m->depth), swapBytes(4, &m->depth); }, ""}},
    {"millimetres as 32FC1",
     {[](Messages* m) {
        toMetres(1.0f, &m->depth);
        m->config.depth_scale = 0.001;
      },
      ""}},
    {"mono16", {[](Messages* m) { m->depth.encoding = "mono16"; }, ""}},
    {"8UC3", {[](Messages* m) { m->color.encoding = "8UC3"; }, "taken as bgr8"}},
    {"capitals", {[](Messages* m) { m->color.encoding = "BGR8"; }, ""}},
    {"bgra8", {[](Messages* m) { withAlpha("bgra8", &m->color); }, ""}},
    {"8UC4", {[](Messages* m) { withAlpha("8UC4", &m->color); }, "taken as bgra8"}},
    {"a camera_info without a size",
     {[](Messages* m) {
        m->color_info.width = m->color_info.height = m->depth_info.width = m->depth_info.height = 0;
      },
      ""}},
    {"no camera_info of depth", {[](Messages* m) { m->has_depth_info = false; }, ""}},
    {"binning of both",
     {[](Messages* m) { asPartOfSensor(2, 0, 0, &m->color_info), asPartOfSensor(2, 0, 0, &m->depth_info); },
      ""}},
    {"binning and region of colour", {[](Messages* m) { asPartOfSensor(3, 21, 14, &m->color_info); }, ""}},
    {"region of depth, to be rectified",
     {[](Messages* m) {
        asPartOfSensor(1, 10, 20, &m->depth_info);
        m->depth_info.roi.do_rectify = 1;
      },
      ""}},
    {"binning that was not done",
     {[](Messages* m) { m->color_info.binning_x = 2; }, "binning there is ignored"}},
    {"zeros in D", {[](Messages* m) { m->color_info.D.assign(9, 0.0); }, ""}},
    {"no P", {[](Messages* m) { m->color_info.P.fill(0.0); }, ""}},
    {"a rectified topic",
     {[](Messages* m) {
        m->config.color_topic = "/camera/color/image_rect_color/compressed";
        m->color_info.D = {-0.35, 0.15, 0.0, 0.0, 0.0};
      },
      "D of its camera_info is taken as 0"}},
    {"a rectified topic with any K",
     {[](Messages* m) {
        m->config.color_topic = "/left/image_rect";
        m->color_info.distortion_model = "fov";
        m->color_info.K[0] = 77.0;
      },
      ""}},
    {"leading slashes", {[](Messages* m) { m->depth.header.frame_id = "/color"; }, ""}},
    {"depth without a frame", {[](Messages* m) { m->depth.header.frame_id = ""; }, ""}},
    {"colour's frame by another name", {[](Messages* m) { m->depth.header.frame_id = "same"; }, ""}},
};

TEST(CameraReader, OneFrameIsTheSameHoweverItIsWritten) {
  const Outcome usual = read(usualMessages());
  EXPECT_TRUE(usual.notes.empty());
  EXPECT_EQ(usual.frame.camera, kCamera);
  EXPECT_GT(cv::countNonZero(usual.frame.depth), 1000);
  for (const auto& [name, way] : kSameFrame) {
    SCOPED_TRACE(name);
    Messages messages = usualMessages();
    way.first(&messages);
    const Outcome outcome = read(messages);
    EXPECT_EQ(outcome.frame.camera, kCamera);
    EXPECT_EQ(cv::norm(outcome.frame.color, usual.frame.color, cv::NORM_INF), 0.0);
    EXPECT_LE(cv::norm(outcome.frame.depth, usual.frame.depth, cv::NORM_INF), 1e-6);
    ASSERT_EQ(outcome.notes.size(), way.second.empty() ? 0u : 1u);
    for (const std::string& note : outcome.notes) EXPECT_TRUE(says(note, way.second));
  }
}

/// Messages that describe no frame, and words of the sentence.
const std::map<std::string, std::pair<Change, std::string>> kNoFrame{
    {"too few bytes", {[](Messages* m) { m->depth.data.pop_back(); }, "the depth image is truncated"}},
    {"rows too short", {[](Messages* m) { m->color.step = 190; }, "the colour image is truncated"}},
    {"grey", {[](Messages* m) { m->color = blankImage("mono8", 1); }, "has no colours"}},
    {"grey without a name", {[](Messages* m) { m->color = blankImage("8UC1", 1); }, "has no colours"}},
    {"depth as colour", {[](Messages* m) { m->color = blankImage("16UC1", 2); }, "a depth encoding"}},
    {"colour as depth",
     {[](Messages* m) { m->depth = blankImage("rgb8", 3); }, "expected 16UC1 [mm] or 32FC1"}},
    {"another size", {[](Messages* m) { m->color_info.width = 128; }, "but its camera_info says 128x48"}},
    {"another binning",
     {[](Messages* m) {
        asPartOfSensor(2, 0, 0, &m->color_info);
        m->color_info.binning_x = 3;
      },
      "with binning 3x2"}},
    {"no calibration",
     {[](Messages* m) { m->color_info.K.fill(0.0), m->color_info.P.fill(0.0); }, "focal length"}},
    {"unknown lens", {[](Messages* m) { m->color_info.distortion_model = "fov"; }, "model 'fov' is unknown"}},
    {"NaN in D", {[](Messages* m) { m->color_info.D[0] = NAN; }, "not finite"}},
    {"too many D",
     {[](Messages* m) {
        m->color_info.distortion_model = "equidistant";
        m->color_info.D.assign(5, 0.1);
      },
      "D has 5 coefficients"}},
    {"unknown frame", {[](Messages* m) { m->depth.header.frame_id = "elsewhere"; }, "/tf_static"}},
    {"other camera without camera_info",
     {[](Messages* m) {
        m->depth.header.frame_id = "depth";
        m->has_depth_info = false;
      },
      "depth_info:="}},
};

TEST(CameraReader, MessagesThatDescribeNoFrameAreRefusedWithASentence) {
  for (const auto& [name, way] : kNoFrame) {
    SCOPED_TRACE(name);
    Messages messages = usualMessages();
    way.first(&messages);
    EXPECT_TRUE(says(complaint([&] { read(messages); }), way.second));
  }
}

TEST(CameraReader, DepthInItsOwnFrameIsPlacedByTf) {
  Messages messages = usualMessages();
  messages.depth.header.frame_id = "/depth";
  const Outcome outcome = read(messages);
  ASSERT_TRUE(outcome.images.depth_camera);
  EXPECT_EQ(outcome.images.depth_camera->T_color_depth.translation().x(), 0.03);
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_TRUE(says(outcome.notes[0], "is registered here"));
}

TEST(CameraReader, DepthOfAnotherLensIsRegistered) {
  Messages messages = usualMessages();
  messages.depth_info = toMessage(Pinhole{64, 48, 50.0, 50.0, 32.0, 24.0});
  const Outcome outcome = read(messages);
  ASSERT_TRUE(outcome.images.depth_camera);
  EXPECT_TRUE(outcome.images.depth_camera->T_color_depth.isApprox(Eigen::Isometry3d::Identity()));
}

/// Zeros behind the coefficients of a fisheye lens, as drivers fill D up to 5 or 8.
TEST(CameraReader, ZerosAtTheEndOfDChangeNoLens) {
  const std::pair<std::string, std::vector<double>> lenses[] = {
      {"equidistant", {0.1, -0.02, 0.003, 0.001}},
      {"fisheye", {0.1}},
      {"plumb_bob", {-0.3, 0.1, 0.001, 0.002}},
      {"rational_polynomial", {0.5, -0.3, 0.0, 0.0, 0.01, 0.8, -0.2, 0.03}}};
  for (const auto& [model, D] : lenses) {
    Messages messages = usualMessages();
    messages.color_info.distortion_model = model;
    messages.color_info.D = D;
    const RgbdFrame expected = read(messages).frame;
    EXPECT_GT(cv::norm(expected.color, read(usualMessages()).frame.color, cv::NORM_INF), 0.0) << model;
    messages.color_info.D.resize(14, 0.0);
    EXPECT_EQ(cv::norm(read(messages).frame.color, expected.color, cv::NORM_INF), 0.0) << model;
  }
}

/// depth_image_proc registers depth to the rectified image.
TEST(CameraReader, RectifiedDepthIsNotRectifiedAgain) {
  Messages messages = usualMessages();
  const RgbdFrame usual = read(messages).frame;
  messages.color_info.D = {-0.3, 0.1, 0.0, 0.0, 0.0};
  messages.config.depth_topic = "/camera/depth_registered/image_rect";
  const RgbdFrame frame = read(messages).frame;
  EXPECT_EQ(cv::norm(frame.depth, usual.depth, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(frame.color, usual.color, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace softbody

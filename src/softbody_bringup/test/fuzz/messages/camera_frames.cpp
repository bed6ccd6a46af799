#include "fuzz/messages/camera_frames.h"

#include <cv_bridge/cv_bridge.h>

#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/ros/camera_reader.h"
#include "softbody_tracking/ros/conversions.h"
#include "softbody_virtual_camera/camera/camera_setup.h"
#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::fuzz {
namespace {

CameraFrame rectifiedFrame(const CameraFrame& raw) {
  CameraIngest ingest{CameraIngestConfig{}};
  CameraReader reader({topics::kCameraColor, topics::kCameraDepth}, nullptr, [](const std::string&) {});
  const RgbdFrame frame = ingest.process(reader.read({raw.color, &raw.depth, raw.info, nullptr}));
  CameraFrame result;
  result.color = *toMessage(frame.color, raw.color.header);
  result.depth = *toMessage(frame.depth, raw.color.header);
  result.info = toMessage(frame.camera);
  result.info.header = raw.color.header;
  return result;
}

/// As image_transport's plugins send them. @param skipped bytes before the PNG of a depth.
sensor_msgs::CompressedImage encoded(const sensor_msgs::Image& image, const char* extension,
                                     const char* format, std::size_t skipped) {
  sensor_msgs::CompressedImage result;
  cv::imencode(extension, cv_bridge::toCvCopy(image)->image, result.data);
  result.data.insert(result.data.begin(), skipped, 0);
  result.header = image.header;
  result.format = image.encoding + format;
  return result;
}

template <typename Good>
std::unique_ptr<Input> makeInput(DrivenNode* node, const std::string& topic, Good good) {
  return std::make_unique<TopicInput<decltype(good())>>(node, topic, good);
}

}  // namespace

const FrameTopics kRawTopics{topics::kCameraColor, topics::kCameraDepth, topics::kCameraColorInfo};
const FrameTopics kRectifiedTopics{topics::kRgbRect, topics::kDepthRect, topics::kRgbInfo};

CameraFrames::CameraFrames(const std::string& scene, int width, int height, const std::vector<double>& times,
                           bool rectified) {
  virtual_camera::CameraSetup setup;
  setup.scene = scene;
  setup.config_folder = CONFIG_DIR;
  setup.width = width;
  setup.height = height;
  setup.noise = virtual_camera::noNoise();
  virtual_camera::VirtualCamera camera = virtual_camera::makeCamera(setup);
  for (const double t : times) {
    const virtual_camera::Capture capture = camera.capture(static_cast<int>(frames_.size()), t);
    if (frames_.empty()) {
      T_camera_body_ = capture.T_camera_body;
      T_camera_tool_ = capture.T_camera_tool;
    }
    const auto messages = virtual_camera::toMessages(capture, camera.pinhole(), ros::Time(1.0), 0);
    CameraFrame raw;
    raw.color = *messages.color;
    raw.depth = *messages.depth;
    raw.info = *messages.info;
    raw.jpeg_color = encoded(raw.color, ".jpg", "; jpeg compressed bgr8", 0);
    raw.png_depth = encoded(raw.depth, ".png", "; compressedDepth png", 12);
    frames_.push_back(rectified ? rectifiedFrame(raw) : raw);
  }
}

CameraFrame CameraFrames::next() {
  CameraFrame frame = frames_[next_++ % frames_.size()];
  for (std_msgs::Header* header : {&frame.color.header, &frame.depth.header, &frame.info.header,
                                   &frame.jpeg_color.header, &frame.png_depth.header})
    header->stamp = LoneRos::instance().now();
  return frame;
}

FrameInput::FrameInput(DrivenNode* node, const FrameTopics& topics, CameraFrames* frames, Transport transport)
    : frames_(frames), info_(makeInput(node, topics.info, [this] { return frame_.info; })) {
  if (transport == Transport::kCompressed) {
    color_ = makeInput(node, topics.color + "/compressed", [this] { return frame_.jpeg_color; });
    depth_ = makeInput(node, topics.depth + "/compressedDepth", [this] { return frame_.png_depth; });
  } else {
    color_ = makeInput(node, topics.color, [this] { return frame_.color; });
    depth_ = makeInput(node, topics.depth, [this] { return frame_.depth; });
  }
}

int FrameInput::give(bool bad, Choice* choice) {
  frame_ = frames_->next();
  Input* inputs[] = {color_.get(), depth_.get(), info_.get()};
  for (std::size_t k = 2; k > 0; --k) std::swap(inputs[k], inputs[choice->below(k + 1)]);
  const std::size_t surely = choice->below(3);  // this one is mutated
  int mutated = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (choice->oneIn(30)) continue;  // lost
    mutated += inputs[k]->give(bad && (k == surely || choice->oneIn(10)), choice);
  }
  return mutated;
}

ros::Time FrameInput::giveGood() {
  LoneRos::instance().advance(0.033);
  frame_ = frames_->next();
  Choice none(0);
  for (Input* input : {info_.get(), color_.get(), depth_.get()}) input->give(false, &none);
  return frame_.color.header.stamp;
}

}  // namespace softbody::fuzz

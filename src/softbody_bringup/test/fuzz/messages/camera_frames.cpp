#include "fuzz/messages/camera_frames.h"

#include <utility>

#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/ros/conversions.h"
#include "softbody_virtual_camera/camera/camera_setup.h"
#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::fuzz {
namespace {

CameraFrame rectifiedFrame(const CameraFrame& raw) {
  CameraIngest ingest{CameraIngestConfig{}};
  const RgbdFrame frame = frameFromMessages(raw.color, &raw.depth, raw.info, &ingest);
  CameraFrame result{*toMessage(frame.color, raw.color.header), *toMessage(frame.depth, raw.color.header),
                     toMessage(frame.camera)};
  result.info.header = raw.color.header;
  return result;
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
    const CameraFrame raw{*messages.color, *messages.depth, *messages.info};
    frames_.push_back(rectified ? rectifiedFrame(raw) : raw);
  }
}

CameraFrame CameraFrames::next() {
  CameraFrame frame = frames_[next_++ % frames_.size()];
  frame.color.header.stamp = frame.depth.header.stamp = frame.info.header.stamp = LoneRos::instance().now();
  return frame;
}

FrameInput::FrameInput(DrivenNode* node, const FrameTopics& topics, CameraFrames* frames)
    : frames_(frames),
      color_(node, topics.color, [this] { return frame_.color; }),
      depth_(node, topics.depth, [this] { return frame_.depth; }),
      info_(node, topics.info, [this] { return frame_.info; }) {}

int FrameInput::give(bool bad, Choice* choice) {
  frame_ = frames_->next();
  Input* inputs[] = {&color_, &depth_, &info_};
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
  for (Input* input :
       {static_cast<Input*>(&info_), static_cast<Input*>(&color_), static_cast<Input*>(&depth_)})
    input->give(false, &none);
  return frame_.color.header.stamp;
}

}  // namespace softbody::fuzz

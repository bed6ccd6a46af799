#pragma once

#include <rosbag/view.h>

#include <filesystem>
#include <string>
#include <vector>

#include "softbody_virtual_camera/camera/camera_setup.h"
#include "softbody_virtual_camera/ros/bag_writer.h"

namespace softbody::test {

/// A scene before a small virtual camera.
inline void record(const std::string& scene, const std::filesystem::path& bag, int frames,
                   double rate_hz = 30.0, const std::string& camera_motion = "none") {
  virtual_camera::CameraSetup setup;
  setup.scene = scene;
  setup.camera_motion = camera_motion;
  setup.config_folder = CONFIG_DIR;
  setup.width = 320;
  setup.height = 240;
  virtual_camera::VirtualCamera camera = virtual_camera::makeCamera(setup);
  virtual_camera::writeBag(&camera, {bag, frames, rate_hz, false}, [](int) {});
}

template <typename Message>
std::vector<Message> messagesOf(const std::filesystem::path& bag, const std::string& topic) {
  const rosbag::Bag whole(bag);
  std::vector<Message> messages;
  for (const rosbag::MessageInstance& m : rosbag::View(whole, rosbag::TopicQuery(topic)))
    messages.push_back(*m.instantiate<Message>());
  return messages;
}

}  // namespace softbody::test

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "softbody_common/camera_topics.h"

namespace softbody {

/// --camera, --color, --depth, --color-info and --depth-info, of every tool that reads a camera's topics.
inline void addCameraOptions(CLI::App* app, CameraTopics* topics) {
  const auto add = [app](const char* name, const char* meaning, const auto& use) {
    return app->add_option_function<std::string>(name, use, meaning);
  };
  add("--camera", "namespace of the camera's topics, with the names of realsense2_camera",
      [topics](const std::string& camera) { *topics = CameraTopics(camera); })
      ->default_str("/camera");
  add("--color", "topic of the colour images; replaces --camera", [topics](const std::string& topic) {
    topics->color = topic;
    topics->color_info = infoTopicOf(topic);
  });
  add("--depth", "topic of the depth images; replaces --camera", [topics](const std::string& topic) {
    topics->depth = topic;
    topics->depth_info = infoTopicOf(topic);
  });
  add("--color-info", "topic of colour's camera_info; default: camera_info beside the images",
      [topics](const std::string& topic) { topics->color_info = topic; });
  add("--depth-info", "topic of depth's camera_info; default: camera_info beside the images",
      [topics](const std::string& topic) { topics->depth_info = topic; });
}

}  // namespace softbody

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "softbody_common/protocol/camera_topics.h"

namespace softbody {

/// --camera, --color, --depth, --color-info, --depth-info and --depth-scale, of every tool that reads a
/// camera's topics.
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
  app->add_option_function<double>(
         "--depth-scale", [topics](double scale) { topics->depth_scale = scale; },
         "metres per unit of depth; 0: 0.001 for 16UC1, 1 for 32FC1")
      ->check(CLI::Range(0.0, 1.0))
      ->default_str("0");
}

}  // namespace softbody

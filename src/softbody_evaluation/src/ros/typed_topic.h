#pragma once

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <stdexcept>
#include <string>

#include "softbody_recordings/ros/typed_message.h"

namespace softbody::evaluation {

/// @throw std::invalid_argument if the bag has no message on the topic.
inline void requireTopic(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() != 0) return;
  throw std::invalid_argument(
      fmt::format("{}: there is no message on {}; rosbag info lists its topics", bag.getFileName(), topic));
}

}  // namespace softbody::evaluation

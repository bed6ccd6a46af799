#pragma once

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <stdexcept>
#include <string>

namespace softbody::evaluation {

/// @throw std::invalid_argument if the bag has no message on the topic.
inline void requireTopic(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() != 0) return;
  throw std::invalid_argument(
      fmt::format("{}: there is no message on {}; rosbag info lists its topics", bag.getFileName(), topic));
}

/// The message of an instance. @throw std::invalid_argument if the instance has another type.
template <typename Message>
boost::shared_ptr<const Message> instantiate(const rosbag::MessageInstance& instance,
                                             const rosbag::Bag& bag) {
  const auto message = instance.instantiate<Message>();
  if (message) return message;
  const std::string expected = ros::message_traits::datatype<Message>();
  if (instance.getDataType() == expected) {
    throw std::invalid_argument(
        fmt::format("{}: {} has another version of {}; record or replay it again with this version",
                    bag.getFileName(), instance.getTopic(), expected));
  }
  throw std::invalid_argument(fmt::format("{}: {} is of type {} instead of {}", bag.getFileName(),
                                          instance.getTopic(), instance.getDataType(), expected));
}

}  // namespace softbody::evaluation

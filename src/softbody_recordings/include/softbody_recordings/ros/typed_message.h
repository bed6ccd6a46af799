#pragma once

#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <stdexcept>
#include <string>

namespace softbody {

/// A kind of message as this program knows it.
struct MessageType {
  std::string name, md5sum;
};

template <typename Message>
MessageType messageType() {
  return {ros::message_traits::datatype<Message>(), ros::message_traits::md5sum<Message>()};
}

/// Why messages of a bag cannot be read as this type, as in "is of type A instead of B"; empty: they can.
std::string typeFault(const std::string& type, const std::string& md5sum, const MessageType& expected);

/// The message. @throw std::invalid_argument with file, topic and both types if it has another type, or
/// another version of its definition.
template <typename Message>
boost::shared_ptr<const Message> instantiate(const rosbag::MessageInstance& instance,
                                             const rosbag::Bag& bag) {
  if (const auto message = instance.instantiate<Message>()) return message;
  throw std::invalid_argument(
      bag.getFileName() + ": " + instance.getTopic() + " " +
      typeFault(instance.getDataType(), instance.getMD5Sum(), messageType<Message>()));
}

}  // namespace softbody

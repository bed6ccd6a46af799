#pragma once

#include <rosbag/bag.h>

#include <filesystem>
#include <string>

namespace softbody {

/// A bag that appears under its name only when finish() is called. Without finish(), no new file remains, and
/// an earlier file stays unchanged.
class AtomicBag {
 public:
  /// @throw std::invalid_argument if the output is a folder; rosbag::BagException if it cannot be written.
  explicit AtomicBag(std::filesystem::path output,
                     rosbag::CompressionType compression = rosbag::compression::LZ4);
  ~AtomicBag();
  AtomicBag(const AtomicBag&) = delete;
  AtomicBag& operator=(const AtomicBag&) = delete;

  /// @param connection header of a copied message; may be null.
  template <typename Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message,
             const boost::shared_ptr<ros::M_string>& connection = {}) {
    bag_.write(topic, time, message, connection);
  }

  /// Writes to a latched topic, which players send again to late subscribers.
  template <typename Message>
  void writeLatched(const std::string& topic, const ros::Time& time, const Message& message) {
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["topic"] = topic;
    (*header)["type"] = ros::message_traits::DataType<Message>::value();
    (*header)["md5sum"] = ros::message_traits::MD5Sum<Message>::value();
    (*header)["message_definition"] = ros::message_traits::Definition<Message>::value();
    (*header)["latching"] = "1";
    bag_.write(topic, time, message, header);
  }

  void finish();

 private:
  std::filesystem::path output_, temporary_;
  rosbag::Bag bag_;
};

}  // namespace softbody

#pragma once

#include <rosbag/bag.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>

#include "softbody_common/files/staged_output.h"

namespace softbody {

/// A bag that appears under its name only when finish() is called. Without finish(), no new file remains, and
/// an earlier file stays unchanged.
class AtomicBag {
 public:
  /// @throw std::runtime_error if the output cannot be written, in every function.
  explicit AtomicBag(const std::filesystem::path& output,
                     rosbag::CompressionType compression = rosbag::compression::LZ4);
  ~AtomicBag();
  AtomicBag(const AtomicBag&) = delete;
  AtomicBag& operator=(const AtomicBag&) = delete;

  /// @param connection header of a copied message; may be null.
  template <typename Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message,
             const boost::shared_ptr<ros::M_string>& connection = {}) try {
    errno = 0;
    bag_->write(topic, time, message, connection);
  } catch (const rosbag::BagException& error) {
    fail(error, errno);
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
    write(topic, time, message, header);
  }

  void finish();

 private:
  [[noreturn]] void fail(const rosbag::BagException& error, int reason) const;

  StagedFile file_;
  std::unique_ptr<rosbag::Bag> bag_ = std::make_unique<rosbag::Bag>();
};

}  // namespace softbody

#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "softbody_recordings/ros/bag_transforms.h"
#include "softbody_tracking/known/followed_surface.h"

namespace softbody {

/// A surface whose topology and states a bag holds, such as another body that was tracked live. Its states
/// are in the order of their stamps, so one with a wrong stamp costs only itself, and so does a message that
/// cannot be used.
class RecordedSurface {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// @param bag must outlive the surface. @param name namespace of its topics, e.g. "/doll/surface".
  /// @throw std::invalid_argument if the bag has no topology or no state that can be used.
  RecordedSurface(const rosbag::Bag& bag, std::string name, const Warn& warn);

  /// The surface in the camera's frame; nothing if the bag does not say where it is.
  std::optional<KnownSurface> at(const RgbdFrame& frame, const std::string& camera_frame,
                                 const BagTransforms& transforms, const Warn& warn);

 private:
  using Message = std::shared_ptr<const rosbag::MessageInstance>;
  struct Entry {
    Nanoseconds stamp = 0;
    std::uint32_t revision = 0;
    std::string frame_id;
    Message message;
  };
  void follow(std::size_t end);

  std::string name_;
  std::unique_ptr<rosbag::View> topology_view_, state_view_;
  std::map<std::uint32_t, Message> topologies_;  ///< by revision
  std::vector<Entry> states_;                    ///< by stamp
  FollowedSurface surface_;
  std::optional<std::uint32_t> revision_;  ///< of the surface's topology
  std::size_t next_ = 0;                   ///< the first state that the surface has not got
  bool warned_ = false;                    ///< of an unknown place
};

}  // namespace softbody

#include "softbody_common/ros/node_diagnostics.h"

namespace softbody {
namespace {

constexpr double kPeriod_s = 1.0;  // [s] the usual rate of /diagnostics, 1 Hz

}  // namespace

NodeDiagnostics::NodeDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                 const std::string& task, const Report& report,
                                 const std::string& hardware_id)
    : updater_(handle, private_handle, private_handle.getNamespace()) {
  updater_.setHardwareID(hardware_id);
  updater_.add(task, report);
  // force_update() on a wall timer: update() uses ROS time, which stops or jumps back with a bag.
  timer_ = handle.createWallTimer(ros::WallDuration(kPeriod_s),
                                  [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

}  // namespace softbody

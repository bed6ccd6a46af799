#include <pluginlib/class_list_macros.hpp>

#include "softbody_common/ros/node_nodelet.h"
#include "softbody_recordings/ros/injector_node.h"
#include "softbody_recordings/ros/recorder_node.h"

namespace softbody {

class InjectorNodelet : public NodeNodelet<injection::InjectorNode> {};
class RecorderNodelet : public NodeNodelet<RecorderNode> {};

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::InjectorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(softbody::RecorderNodelet, nodelet::Nodelet)

#include <pluginlib/class_list_macros.hpp>

#include "softbody_bringup/injection/injector_node.h"
#include "softbody_common/node_nodelet.h"

namespace softbody {

class InjectorNodelet : public NodeNodelet<injection::InjectorNode> {};

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::InjectorNodelet, nodelet::Nodelet)

#pragma once

#include <softbody_msgs/Cut.h>
#include <softbody_msgs/CutHistory.h>
#include <softbody_msgs/LoadObject.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TetTopology.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

#include "fuzz/messages/mutation.h"
#include "softbody_sim/object/object_model.h"

/// Good messages around a small block, and what a good answer is.
namespace softbody::fuzz {

/// A small soft block of 48 tets, 100 x 50 x 25 mm, so that a step and a cut take little time.
struct Block {
  std::string yaml;  ///< its file
  ObjectModel model;
};
const Block& block();

/// Where the block is placed in the camera's frame.
Eigen::Isometry3d blockPose();

/// A cut through the block along a random plane.
softbody_msgs::Cut planeCut(std::uint32_t revision, std::uint32_t stroke, Choice* choice);

XmlRpc::XmlRpcValue simulatorParameters();

/// Names the block's file.
softbody_msgs::LoadObject::Request blockFile();

/// Targets at the middles of some tets, at rest in blockPose(), with the present time.
softbody_msgs::Targets blockTargets(const softbody_msgs::TetTopology& topology, bool reset, Choice* choice);

/// The edits after one more stroke, or without the last one.
softbody_msgs::CutHistory editedFurther(softbody_msgs::CutHistory history, Choice* choice);

/// What is wrong with a state of a body that rests in blockPose(); empty: nothing.
std::string whyOdd(const softbody_msgs::MeshState& state, const softbody_msgs::TetTopology& topology);

}  // namespace softbody::fuzz

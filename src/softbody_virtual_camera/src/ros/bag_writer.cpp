#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "softbody_common/protocol/topics.h"
#include "softbody_recordings/ros/atomic_bag.h"
#include "softbody_virtual_camera/ros/bag_writer.h"
#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::virtual_camera {
namespace {

const ros::Time kStart(1600000000, 0);

std::string absolute(const char* topic) { return std::string("/") + topic; }

void writeLatched(const VirtualCamera& camera, std::uint32_t revision, const ros::Time& stamp,
                  AtomicBag* bag) {
  bag->writeLatched("/tf_static", stamp, staticTransforms(camera.scene(), stamp));
  if (const auto& material = camera.scene().material)
    bag->writeLatched(absolute(kTruthMaterialTopic), stamp, materialMessage(*material));
  bag->writeLatched(absolute(kTruthTopologyTopic), stamp, topologyMessage(camera.topology(revision), stamp));
  if (const auto second = camera.secondTopology())
    bag->writeLatched(absolute(kSecondTopologyTopic), stamp, topologyMessage(*second, stamp, kSecondFrame));
}

void writeCuts(const VirtualCamera& camera, std::uint32_t last_revision, std::uint32_t revision,
               const ros::Time& stamp, AtomicBag* bag) {
  for (std::uint32_t made = last_revision; made < revision; ++made) {
    bag->write(absolute(kTruthCutTopic), stamp, cutMessage(camera.scene().edits.at(made), stamp));
  }
}

void writeFrame(const CaptureMessages& messages, const ros::Time& stamp, AtomicBag* bag) {
  bag->write("/tf", stamp, messages.transforms);
  bag->write(absolute(topics::kCameraColorInfo), stamp, messages.info);
  bag->write(absolute(topics::kCameraDepthInfo), stamp, messages.info);
  bag->write(absolute(topics::kCameraColor), stamp, messages.color);
  bag->write(absolute(topics::kCameraDepth), stamp, messages.depth);
  bag->write(absolute(kTruthStateTopic), stamp, messages.truth);
  bag->write(absolute(kTruthCameraPoseTopic), stamp, messages.camera);
  if (messages.second) bag->write(absolute(kSecondStateTopic), stamp, messages.second);
  if (messages.gripper_closed) bag->write(absolute(kGripperTopic), stamp, messages.gripper_closed);
  if (messages.forces) bag->write(absolute(kTruthForcesTopic), stamp, messages.forces);
  for (const auto& [name, wrench] : messages.wrenches)
    bag->write(absolute(kWrenchTopic) + name, stamp, wrench);
  for (const auto& [name, wrench] : messages.true_wrenches)
    bag->write(absolute(kTruthWrenchTopic) + name, stamp, wrench);
  if (messages.tool) bag->write(absolute(kTruthToolPoseTopic), stamp, messages.tool);
}

}  // namespace

void writeBag(VirtualCamera* camera, const BagOptions& options, const std::function<void(int)>& progress) {
  AtomicBag bag(options.path, options.small ? rosbag::compression::BZ2 : rosbag::compression::LZ4);
  const int frames_a_second = std::max(1, static_cast<int>(std::lround(options.rate_hz)));
  std::uint32_t last_revision = 0;
  for (int frame = 0; frame < options.frames; ++frame) {
    const double t = frame / options.rate_hz;
    const ros::Time stamp = kStart + ros::Duration(t);
    const CaptureMessages messages =
        toMessages(camera->capture(frame, t), camera->pinhole(), stamp, static_cast<std::uint32_t>(frame));
    const std::uint32_t revision = messages.truth->revision;
    if (frame % frames_a_second == 0 || revision != last_revision)
      writeLatched(*camera, revision, stamp, &bag);
    writeCuts(*camera, last_revision, revision, stamp, &bag);
    last_revision = revision;
    writeFrame(messages, stamp, &bag);
    if (options.labels) bag.write(absolute(kTruthLabelsTopic), stamp, messages.labels);
    progress(frame + 1);
  }
  bag.finish();
}

}  // namespace softbody::virtual_camera

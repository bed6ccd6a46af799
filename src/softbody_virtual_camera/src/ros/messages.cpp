#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>

#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/geometry_messages.h"
#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::virtual_camera {
namespace {

geometry_msgs::TransformStamped transformMessage(const std_msgs::Header& header, const char* child,
                                                 const Eigen::Isometry3d& T) {
  const geometry_msgs::Pose pose = toMessage(T);
  geometry_msgs::TransformStamped message;
  message.header = header;
  message.child_frame_id = child;
  message.transform.translation.x = pose.position.x;
  message.transform.translation.y = pose.position.y;
  message.transform.translation.z = pose.position.z;
  message.transform.rotation = pose.orientation;
  return message;
}

/// camera_link (x forward, z up) -> camera_color_optical_frame (z forward, y down).
Eigen::Isometry3d opticalFrame() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5).toRotationMatrix();
  return T;
}

void addGripper(const GripperState& gripper, const std_msgs::Header& header, CaptureMessages* messages) {
  auto& transforms = messages->transforms.transforms;
  transforms.push_back(transformMessage(header, kGripperFrame, gripper.T_camera_gripper));
  for (std::size_t i = 0; i < 2; ++i)
    transforms.push_back(transformMessage(header, kFingerFrames[i], gripper.T_camera_fingers[i]));
  messages->gripper_closed = boost::make_shared<std_msgs::Bool>();
  messages->gripper_closed->data = static_cast<unsigned char>(gripper.closed);
}

softbody_msgs::ForcesPtr forcesMessage(const std::vector<SurfaceForce>& forces,
                                       const std_msgs::Header& header) {
  auto message = boost::make_shared<softbody_msgs::Forces>();
  message->header = header;
  message->in_newtons = true;
  message->wrench_frame = header.frame_id;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  for (const SurfaceForce& force : forces) {
    softbody_msgs::PatchForce patch;
    patch.name = force.name;
    patch.place = pointMessage(force.place);
    patch.normal = vectorMessage(force.normal);
    patch.force = vectorMessage(force.force);
    message->patches.push_back(patch);
    sum += force.force;
    torque += force.place.cross(force.force);
  }
  message->wrench.force = vectorMessage(sum);
  message->wrench.torque = vectorMessage(torque);
  return message;
}

softbody_msgs::MeshStatePtr truthMessage(const MeshState& truth, const std_msgs::Header& header) {
  auto message = boost::make_shared<softbody_msgs::MeshState>(toMessage(truth));
  message->header = header;
  message->observed = header.stamp;
  return message;
}

/// The frames of a second body, of a robot and of other things.
void addOthers(const Capture& capture, const std_msgs::Header& header,
               std::vector<geometry_msgs::TransformStamped>* transforms) {
  if (capture.T_camera_second)
    transforms->push_back(transformMessage(header, kSecondFrame, *capture.T_camera_second));
  for (const LinkPose& link : capture.links)
    transforms->push_back(transformMessage(header, link.name.c_str(), link.T_camera_link));
  for (const FramePose& thing : capture.frames)
    transforms->push_back(transformMessage(header, thing.name.c_str(), thing.T_camera_frame));
}

std_msgs::Header headerOf(const ros::Time& stamp, const char* frame_id) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame_id;
  return header;
}

std::map<std::string, geometry_msgs::WrenchStamped> wrenchMessages(const std::vector<ContactWrench>& wrenches,
                                                                   const ros::Time& stamp) {
  std::map<std::string, geometry_msgs::WrenchStamped> messages;
  for (const ContactWrench& wrench : wrenches) {
    geometry_msgs::WrenchStamped& message = messages[wrench.name];
    message.header = headerOf(stamp, wrench.name.c_str());
    message.wrench.force = vectorMessage(wrench.force);
    message.wrench.torque = vectorMessage(wrench.torque);
  }
  return messages;
}

}  // namespace

CaptureMessages toMessages(const Capture& capture, const Pinhole& camera, const ros::Time& stamp,
                           std::uint32_t sequence) {
  std_msgs::Header header;
  header.seq = sequence;
  header.stamp = stamp;
  header.frame_id = kOpticalFrame;
  CaptureMessages messages;
  messages.color = cv_bridge::CvImage(header, sensor_msgs::image_encodings::RGB8, capture.color).toImageMsg();
  messages.depth =
      cv_bridge::CvImage(header, sensor_msgs::image_encodings::TYPE_16UC1, capture.depth_mm).toImageMsg();
  messages.labels =
      cv_bridge::CvImage(header, sensor_msgs::image_encodings::MONO8, capture.labels).toImageMsg();
  messages.info = boost::make_shared<sensor_msgs::CameraInfo>(toMessage(camera));
  messages.info->header = header;
  std_msgs::Header truth_header = header;
  if (capture.T_world_camera) truth_header.frame_id = kWorldFrame;
  messages.truth = truthMessage(capture.truth, truth_header);
  if (capture.second) messages.second = truthMessage(*capture.second, truth_header);
  messages.transforms.transforms.push_back(transformMessage(header, kBodyFrame, capture.T_camera_body));
  messages.camera = boost::make_shared<geometry_msgs::PoseStamped>();
  messages.camera->header = headerOf(stamp, kBodyFrame);
  messages.camera->pose = toMessage(capture.T_camera_body.inverse());
  addOthers(capture, header, &messages.transforms.transforms);
  if (capture.T_world_camera) {
    messages.transforms.transforms.push_back(transformMessage(
        headerOf(stamp, kWorldFrame), kCameraFrame, *capture.T_world_camera * opticalFrame().inverse()));
  }
  if (capture.forces) messages.forces = forcesMessage(*capture.forces, messages.truth->header);
  messages.wrenches = wrenchMessages(capture.wrenches, stamp);
  messages.true_wrenches = wrenchMessages(capture.true_wrenches, stamp);
  if (capture.gripper) addGripper(*capture.gripper, header, &messages);
  if (capture.T_camera_tool) {
    messages.tool = boost::make_shared<geometry_msgs::PoseStamped>();
    messages.tool->header = header;
    messages.tool->pose = toMessage(*capture.T_camera_tool);
  }
  return messages;
}

void setStamp(const ros::Time& stamp, CaptureMessages* messages) {
  for (std_msgs::Header* header :
       {&messages->color->header, &messages->depth->header, &messages->labels->header,
        &messages->info->header, &messages->truth->header}) {
    header->stamp = stamp;
  }
  messages->truth->observed = stamp;
  messages->camera->header.stamp = stamp;
  for (geometry_msgs::TransformStamped& transform : messages->transforms.transforms) {
    transform.header.stamp = stamp;
  }
  for (auto* wrenches : {&messages->wrenches, &messages->true_wrenches}) {
    for (auto& [name, wrench] : *wrenches) wrench.header.stamp = stamp;
  }
  if (messages->second) messages->second->header.stamp = messages->second->observed = stamp;
  if (messages->forces) messages->forces->header.stamp = stamp;
  if (messages->tool) messages->tool->header.stamp = stamp;
}

softbody_msgs::MeshTopology topologyMessage(const MeshTopology& topology, const ros::Time& stamp,
                                            const char* frame_id) {
  softbody_msgs::MeshTopology message = toMessage(topology);
  message.header.stamp = stamp;
  message.header.frame_id = frame_id;
  return message;
}

softbody_msgs::Cut cutMessage(const Edit& edit, const ros::Time& stamp) {
  MeshTopology patch;
  patch.rest_vertices = edit.patch.vertices;
  patch.triangles = edit.patch.triangles;
  const softbody_msgs::MeshTopology arrays = toMessage(patch);
  softbody_msgs::Cut message;
  message.header.stamp = stamp;
  message.header.frame_id = kBodyFrame;
  message.revision = message.stroke = edit.topology.revision;
  message.kind = softbody_msgs::Cut::CUT;
  message.patch_vertices = arrays.rest_vertices;
  message.patch_triangles = arrays.triangles;
  return message;
}

std_msgs::String materialMessage(const TrueMaterial& material) {
  std_msgs::String message;
  message.data = materialText(material);
  return message;
}

tf2_msgs::TFMessage staticTransforms(const Scene& scene, const ros::Time& stamp) {
  tf2_msgs::TFMessage message;
  if (scene.has_weight && !scene.state(0.0).T_world_camera) {
    message.transforms.push_back(transformMessage(headerOf(stamp, kWorldFrame), kCameraFrame,
                                                  scene.T_camera_world.inverse() * opticalFrame().inverse()));
  }
  message.transforms.push_back(
      transformMessage(headerOf(stamp, kCameraFrame), kOpticalFrame, opticalFrame()));
  return message;
}

}  // namespace softbody::virtual_camera

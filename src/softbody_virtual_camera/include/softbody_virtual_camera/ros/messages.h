#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <softbody_msgs/Cut.h>
#include <softbody_msgs/Forces.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <std_msgs/Bool.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <string>

#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {

constexpr char kCameraFrame[] = "camera_link";
constexpr char kOpticalFrame[] = "camera_color_optical_frame";
constexpr char kBodyFrame[] = "ground_truth_softbody";
constexpr char kWorldFrame[] = "world";  ///< only with a moving camera, or if the body has weight

/// As a robot would publish them.
constexpr char kGripperFrame[] = "gripper";
constexpr const char* kFingerFrames[] = {"left_finger", "right_finger"};
constexpr char kGripperTopic[] = "gripper/closed";

constexpr char kTruthTopologyTopic[] = "ground_truth/surface/topology";
constexpr char kTruthStateTopic[] = "ground_truth/surface/state";
/// Of a second soft body, in scenes with one.
constexpr char kSecondFrame[] = "ground_truth_second";
constexpr char kSecondTopologyTopic[] = "ground_truth/second/surface/topology";
constexpr char kSecondStateTopic[] = "ground_truth/second/surface/state";
constexpr char kTruthLabelsTopic[] = "ground_truth/labels";
constexpr char kTruthCameraPoseTopic[] = "ground_truth/camera_pose";
constexpr char kTruthToolPoseTopic[] = "ground_truth/tool/pose";
constexpr char kTruthForcesTopic[] = "ground_truth/forces";  ///< only in scenes that know them
/// Followed by the name of the thing; as its sensor says it, and without the sensor's errors.
constexpr char kWrenchTopic[] = "wrench/";
constexpr char kTruthWrenchTopic[] = "ground_truth/wrench/";
constexpr char kTruthMaterialTopic[] = "ground_truth/material";  ///< only in scenes with a solver
constexpr char kTruthCutTopic[] = "ground_truth/cut";

/// The messages of one frame, all with the same stamp.
struct CaptureMessages {
  sensor_msgs::ImagePtr color, depth;  ///< rgb8; 16UC1 [mm], registered to colour
  sensor_msgs::CameraInfoPtr info;     ///< of both images
  sensor_msgs::ImagePtr labels;        ///< mono8, as in pixel_labels.h
  softbody_msgs::MeshStatePtr truth;   ///< in the optical frame, or in the world if the camera moves
  softbody_msgs::MeshStatePtr second;  ///< the truth of a second soft body; null without one
  /// optical frame -> ground_truth_softbody, ground_truth_second, links of a robot, gripper and its fingers,
  /// clamp and other things that hold or touch the body;
  /// with a moving camera also world -> camera_link
  tf2_msgs::TFMessage transforms;
  geometry_msgs::PoseStampedPtr camera;  ///< optical frame in the frame of the body at rest
  geometry_msgs::PoseStampedPtr tool;    ///< of the tool in the optical frame; null without a tool
  softbody_msgs::ForcesPtr forces;       ///< in the frame of the truth; null if the scene does not know them
  std_msgs::BoolPtr gripper_closed;      ///< null without a gripper
  /// What the body does to things with a sensor, by the name of the thing; in its frame.
  std::map<std::string, geometry_msgs::WrenchStamped> wrenches, true_wrenches;
};

CaptureMessages toMessages(const Capture& capture, const Pinhole& camera, const ros::Time& stamp,
                           std::uint32_t sequence);

/// Sets the stamp of all messages of a frame.
void setStamp(const ros::Time& stamp, CaptureMessages* messages);

/// The truth's topology in the body's frame.
softbody_msgs::MeshTopology topologyMessage(const MeshTopology& topology, const ros::Time& stamp,
                                            const char* frame_id = kBodyFrame);

/// The cut of an edit, in the body's frame. Each cut is a separate stroke.
softbody_msgs::Cut cutMessage(const Edit& edit, const ros::Time& stamp);

/// The material of a scene's solver, as YAML.
std_msgs::String materialMessage(const TrueMaterial& material);

/// camera_link (x forward, z up) -> camera_color_optical_frame (z forward, y down). If the body has weight
/// and the camera stands still, also world -> camera_link.
tf2_msgs::TFMessage staticTransforms(const Scene& scene, const ros::Time& stamp);

}  // namespace softbody::virtual_camera

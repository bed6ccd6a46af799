#include <fmt/format.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/PointCloud2.h>

#include "fuzz/messages/camera_frames.h"
#include "fuzz/messages/target.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_tracking/ros/nodes.h"

namespace softbody::fuzz {
namespace {

constexpr int kGoodFrames = 60;  // two seconds at 30 Hz: time that has leapt must be found again

XmlRpc::XmlRpcValue cameraParameters(Transport transport) {
  XmlRpc::XmlRpcValue parameters;
  if (transport == Transport::kRaw) return parameters;
  parameters["color_transport"] = std::string("compressed");
  parameters["depth_transport"] = std::string("compressedDepth");
  return parameters;
}

class CameraTarget : public Target {
 public:
  explicit CameraTarget(Transport transport)
      : frames_("bend", 64, 48, {0.0, 1.0, 2.0}, false),
        node_("camera_ingest", cameraParameters(transport),
              [](const auto& handle, const auto& own) { return makeCameraIngest(handle, own); }),
        color_(&node_, topics::kRgbRect),
        depth_(&node_, topics::kDepthRect),
        info_(&node_, topics::kRgbInfo),
        points_(&node_, topics::kPoints) {
    auto input = std::make_unique<FrameInput>(&node_, kRawTopics, &frames_, transport);
    input_ = input.get();
    inputs.push_back({std::move(input), 3});
    depth_info_ = add<sensor_msgs::CameraInfo>(&node_, topics::kCameraDepthInfo, 1,
                                               [this] { return frames_.next().info; });
  }

  std::string check() override {
    depth_info_->send(boost::make_shared<sensor_msgs::CameraInfo>(frames_.next().info));
    int complete = 0;
    for (int i = 0; i < kGoodFrames; ++i) {
      const ros::Time stamp = input_->giveGood();
      const bool came = color_.hasStamp(stamp) && depth_.hasStamp(stamp) && info_.hasStamp(stamp) &&
                        points_.hasStamp(stamp);
      complete = came ? complete + 1 : 0;
    }
    constexpr int kFewest = 10;
    return complete >= kFewest
               ? ""
               : fmt::format("only the last {} of {} frames are passed on", complete, kGoodFrames);
  }

 private:
  CameraFrames frames_;
  DrivenNode node_;
  Newest<sensor_msgs::Image> color_, depth_;
  Newest<sensor_msgs::CameraInfo> info_;
  Newest<sensor_msgs::PointCloud2> points_;
  FrameInput* input_;
  TopicInput<sensor_msgs::CameraInfo>* depth_info_;
};

XmlRpc::XmlRpcValue toolParameters() {
  XmlRpc::XmlRpcValue parameters;
  parameters["tool"] = std::string(CONFIG_DIR "/knife.yaml");
  return parameters;
}

class ToolTarget : public Target {
 public:
  ToolTarget()
      : frames_("cut", 240, 180, {0.5}, true),
        node_("tool_tracker", toolParameters(),
              [](const auto& handle, const auto& own) { return makeToolTracker(handle, own); }),
        pose_(&node_, topics::kToolPose) {
    auto input = std::make_unique<FrameInput>(&node_, kRectifiedTopics, &frames_);
    input_ = input.get();
    inputs.push_back({std::move(input), 1});
  }

  std::string check() override {
    ros::Time stamp;
    for (int i = 0; i < kGoodFrames / 2; ++i) stamp = input_->giveGood();
    if (!pose_.hasStamp(stamp)) return "the tool is not found";
    const auto& p = pose_.get()->pose.pose.position;
    const double error = (Eigen::Vector3d(p.x, p.y, p.z) - frames_.toolPose()->translation()).norm();
    constexpr double kFarthest_m = 0.03;  // the image is small
    return error < kFarthest_m ? "" : fmt::format("the tool is {:.3f} m away", error);
  }

 private:
  CameraFrames frames_;
  DrivenNode node_;
  Newest<geometry_msgs::PoseWithCovarianceStamped> pose_;
  FrameInput* input_;
};

}  // namespace

std::unique_ptr<Target> makeCameraTarget() { return std::make_unique<CameraTarget>(Transport::kRaw); }
std::unique_ptr<Target> makeCompressedCameraTarget() {
  return std::make_unique<CameraTarget>(Transport::kCompressed);
}
std::unique_ptr<Target> makeToolTarget() { return std::make_unique<ToolTarget>(); }

}  // namespace softbody::fuzz

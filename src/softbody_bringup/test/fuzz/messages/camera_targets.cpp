#include <fmt/format.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Trigger.h>

#include "fuzz/messages/camera_frames.h"
#include "fuzz/messages/target.h"
#include "fuzz/scratch_files.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_recordings/ros/injector_node.h"
#include "softbody_scanning/ros/nodes.h"
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
    parameters_ = addParameters(&node_);
    depth_info_ = add<sensor_msgs::CameraInfo>(&node_, topics::kCameraDepthInfo, 1,
                                               [this] { return frames_.next().info; });
  }

  std::string check() override {
    parameters_->sendGood();
    depth_info_->sendGood();
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
  ParameterInput* parameters_;
};

class InjectorTarget : public Target {
 public:
  InjectorTarget()
      : frames_("bend", 64, 48, {0.0, 1.0, 2.0}, false),
        node_("injector", {},
              [](const auto& handle, const auto& own) {
                return std::make_shared<injection::InjectorNode>(handle, own);
              }),
        color_(&node_, "camera_faulty/color/image_raw"),
        depth_(&node_, "camera_faulty/aligned_depth_to_color/image_raw"),
        info_(&node_, "camera_faulty/color/camera_info") {
    auto input = std::make_unique<FrameInput>(&node_, kRawTopics, &frames_);
    input_ = input.get();
    inputs.push_back({std::move(input), 3});
    add<sensor_msgs::CameraInfo>(&node_, topics::kCameraDepthInfo, 1, [this] { return frames_.next().info; });
  }

  std::string check() override {
    ros::Time stamp;
    for (int i = 0; i < 2; ++i) stamp = input_->giveGood();  // time that jumps back starts the faults again
    const bool came = color_.hasStamp(stamp) && depth_.hasStamp(stamp) && info_.hasStamp(stamp);
    return came ? "" : "a frame does not pass";
  }

 private:
  CameraFrames frames_;
  DrivenNode node_;
  Newest<sensor_msgs::Image> color_, depth_;
  Newest<sensor_msgs::CameraInfo> info_;
  FrameInput* input_;
};

XmlRpc::XmlRpcValue scannerParameters() {
  XmlRpc::XmlRpcValue parameters;
  parameters["sheet"] = std::string(CONFIG_DIR "/sheet.yaml");
  parameters["output"] = (scratch() / "scanned").string();
  return parameters;
}

class ScannerTarget : public Target {
 public:
  ScannerTarget()
      : frames_("walk", 320, 240, {0.0}, true), node_("scanner", scannerParameters(), scanning::makeScanner) {
    auto input = std::make_unique<FrameInput>(&node_, kRectifiedTopics, &frames_);
    input_ = input.get();
    inputs.push_back({std::move(input), 30});
    add<geometry_msgs::PointStamped>(&node_, "clicked_point", 5, [] {
      geometry_msgs::PointStamped point;
      point.header.frame_id = "scan";
      return point;
    });
    const auto add_trigger = [this](const char* name) {
      return addService<std_srvs::Trigger>(&node_, name, [] { return std_srvs::Trigger::Request(); });
    };
    start_ = add_trigger("start");
    finish_ = add_trigger("finish");
    discard_ = add_trigger("discard");
  }

  /// Its synchroniser keeps the last frames by their stamps, so frames that claim to be from the future keep
  /// good ones out; the services answer.
  std::string check() override {
    start_->sendGood();
    for (int i = 0; i < kGoodFrames / 10; ++i) input_->giveGood();
    const std::string said = finish_->sendGood().message;
    discard_->sendGood();
    return said.empty() ? "the scanner does not say why there is no model" : "";
  }

 private:
  CameraFrames frames_;
  DrivenNode node_;
  FrameInput* input_;
  ServiceInput<std_srvs::Trigger>*start_, *finish_, *discard_;
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
std::unique_ptr<Target> makeInjectorTarget() { return std::make_unique<InjectorTarget>(); }
std::unique_ptr<Target> makeScannerTarget() { return std::make_unique<ScannerTarget>(); }
std::unique_ptr<Target> makeToolTarget() { return std::make_unique<ToolTarget>(); }

}  // namespace softbody::fuzz

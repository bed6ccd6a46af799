#include "nodes/scanner_node.h"

#include <fmt/format.h>
#include <std_msgs/String.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <sstream>

#include "scan/preview.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_scanning/output/scanned_model.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody::scanning {
namespace {

constexpr char kFrame[] = "scan";  // of the growing surface, child of the camera's on /tf

constexpr double kPreviewPeriod_s = 2.0;
constexpr std::size_t kFewestFrames = 6;  // for a preview

ToolDescription loadSheet(const ScannerOptions& options) {
  return loadToolWithMarkers(options.sheet, fileScope(options.allow_outside));
}

Preview tryPreview(const PosedRecording& recording) {
  try {
    return {previewOf(recording), ""};
  } catch (const std::invalid_argument& error) {
    return {std::nullopt, error.what()};
  }
}

}  // namespace

ScannerNode::ScannerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : ScannerNode(handle, private_handle, readOptions(private_handle, scannerParameters())) {}

ScannerNode::ScannerNode(ros::NodeHandle handle, ros::NodeHandle private_handle,
                         const ScannerOptions& options)
    : sheet_(loadSheet(options)),
      output_(options.output),
      motion_(sheet_),
      clicked_(handle, kFrame),
      color_(handle, topics::kRgbRect, 3),
      depth_(handle, topics::kDepthRect, 3),
      info_(handle, topics::kRgbInfo, 3),
      images_(color_, depth_, info_, 6) {
  topology_ = handle.advertise<softbody_msgs::MeshTopology>("scan/topology", 1, true);
  state_ = handle.advertise<softbody_msgs::MeshState>("scan/state", 1, true);
  progress_ = handle.advertise<std_msgs::String>("scan/progress", 1, true);
  start_ = private_handle.advertiseService("start", &ScannerNode::start, this);
  finish_ = private_handle.advertiseService("finish", &ScannerNode::finish, this);
  discard_ = private_handle.advertiseService("discard", &ScannerNode::discard, this);
  images_.registerCallback(&ScannerNode::onFrame, this);
  timer_ =
      handle.createWallTimer(ros::WallDuration(kPreviewPeriod_s), [this](const auto&) { showProgress(); });
}

void ScannerNode::onFrame(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth,
                          const sensor_msgs::CameraInfoConstPtr& info) try {
  RgbdFrame frame = frameFromRectified(*color, *depth, *info);
  frame.placed = false;
  frame.stamp = toNanoseconds(color->header.stamp);
  const auto pose = motion_.poseOf(frame);
  last_error_ = motion_.reason();
  if (pose) place(color->header, pose->T_camera_model);
  if (!running_) return;
  ++frames_;
  if (!pose) return;
  ++posed_;
  cv::Mat1f depth_m = frame.depth.clone();  // the message belongs to others, too
  cv::patchNaNs(depth_m, 0.0);
  choice_.add({frame.stamp, frame.camera, frame.color.clone(), depth_m, pose->T_camera_model,
               sharpnessOf(frame.color)});
} catch (const std::exception& error) {
  last_error_ = error.what();
  ROS_ERROR_STREAM_THROTTLE(5.0, "frame " << color->header.stamp << " cannot be used: " << error.what());
}

void ScannerNode::place(const std_msgs::Header& header, const Eigen::Isometry3d& T_camera_model) {
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_camera_model);
  transform.header = header;
  transform.child_frame_id = kFrame;
  transforms_.sendTransform(transform);
}

std::string ScannerNode::progressText() const {
  std::string text = fmt::format("{}: {} frames, the sheet in {}, {} views",
                                 running_ ? "scanning" : "stopped", frames_, posed_, choice_.chosen().size());
  if (!object_.empty())
    text += fmt::format("; the object{}: {}, {:.0f} % of the surface seen",
                        clicked_.point() ? " as clicked" : "", object_, 1e2 * seen_);
  for (const std::string& reason : {last_error_, problem_, clicked_.reason()})
    if (!reason.empty()) text += "; " + reason;
  return text;
}

void ScannerNode::showProgress() {
  if (preview_.valid() && preview_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    show(preview_.get());
  std_msgs::String text;
  text.data = progressText();
  progress_.publish(text);
  if (!running_ || preview_.valid() || choice_.chosen().size() < kFewestFrames) return;
  preview_ = std::async(std::launch::async, [recording = recording()] { return tryPreview(recording); });
}

PosedRecording ScannerNode::recording() {
  return {"scan", choice_.chosen(), motion_.modelFrame(nullptr).region, clicked_.point()};
}

void ScannerNode::show(const Preview& preview) {
  problem_ = preview.problem;
  object_ = preview.surface ? sizeAndPlaceOf(preview.surface->mesh) : "";
  if (preview.surface) publish(*preview.surface);
}

void ScannerNode::publish(const RegisteredSurface& surface) {
  MeshTopology topology;
  topology.revision = ++revision_;
  topology.rest_vertices = surface.mesh.vertices;
  topology.triangles = surface.mesh.triangles;
  topology.vertex_parents.assign(static_cast<std::size_t>(surface.mesh.vertices.rows()), -1);
  topology.triangle_pieces.assign(static_cast<std::size_t>(surface.mesh.triangles.rows()), 0);
  topology.cut.assign(static_cast<std::size_t>(surface.mesh.triangles.rows()), false);
  MeshState state;
  state.revision = revision_;
  state.vertices = surface.mesh.vertices;
  state.confidence = surface.seen;
  seen_ = static_cast<double>(std::count_if(surface.seen.begin(), surface.seen.end(), isSeen)) /
          static_cast<double>(surface.seen.size());
  softbody_msgs::MeshTopology topology_message = toMessage(topology);
  softbody_msgs::MeshState state_message = toMessage(state);
  topology_message.header.frame_id = state_message.header.frame_id = kFrame;
  topology_message.header.stamp = state_message.header.stamp = state_message.observed = ros::Time::now();
  topology_.publish(topology_message);
  state_.publish(state_message);
}

/// And the choice of the object: another one may stand there next.
void ScannerNode::dropViews() {
  choice_.take();
  preview_ = {};  // waits for a running one
  frames_ = posed_ = 0;
  object_.clear();
  problem_.clear();
  clicked_.forget();
}

bool ScannerNode::start(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  dropViews();
  running_ = true;
  response.success = true;
  response.message = "scanning; earlier views are dropped";
  return true;
}

bool ScannerNode::discard(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  dropViews();
  running_ = false;
  response.success = true;
  response.message = "stopped; the views are dropped, and nothing was written";
  return true;
}

bool ScannerNode::finish(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) try {
  running_ = false;
  CheckedScan scan = scanAndCheck({recording()}, {});
  const std::string report = progressText() + "\n" + reportOf(scan);
  std::ostringstream output;
  writeModel(
      std::move(scan), report, output_, [](double) {}, output);
  response.success = true;
  response.message = fmt::format("{}\n{}written to {}", progressText(), report, output_);
  ROS_INFO_STREAM(response.message);
  return true;
} catch (const std::exception& error) {
  running_ = true;  // more views may mend it
  response.success = false;
  response.message = std::string(error.what()) + "; the scan goes on";
  ROS_ERROR_STREAM(response.message);
  return true;
}

}  // namespace softbody::scanning

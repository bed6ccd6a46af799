#pragma once

#include <std_msgs/Header.h>

#include <string>

#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/atomic_bag.h"

namespace softbody {

/// What is written only on demand.
struct ResultBagExtras {
  bool timing = false;  ///< wall-clock times of the stages
  bool labels = false;  ///< label images
};

/// Writes the messages of one body's graph into a bag. The record time is the header stamp, so the same input
/// gives the same bytes.
class ResultBag {
 public:
  /// @param bag which the results of other bodies can share; must outlive this object.
  /// @param topic_namespace of the output topics, e.g. "/softbody"; the frames follow it.
  ResultBag(AtomicBag* bag, std::string topic_namespace, const ResultBagExtras& extras = {});

  /// Writes both topologies, latched. Call it before the first state of a revision, and again every second.
  /// Their stamp stays that of the revision's first frame.
  void writeTopologies(const TetTopology& volume, const MeshTopology& surface, const ros::Time& stamp);
  /// @param frame_id of targets and states; empty (default): the frame of the images.
  void setOutputFrame(std::string frame_id) { output_frame_ = std::move(frame_id); }
  /// @param blade of the tracked tool, in the tool's frame [m].
  void setBlade(Points blade) { blade_ = std::move(blade); }
  /// The output of a frame without a tracked body. @param header of the colour image, as below.
  void writeStatus(const TrackingStatus& status, const std_msgs::Header& header);
  void writeTool(const ToolObservation& tool, const std_msgs::Header& header);
  /// All outputs of one frame. One that is predicted has no status, because nothing is tracked.
  void writeFrame(const FrameOutput& frame, const std_msgs::Header& header);

 private:
  std::string topic(const char* name) const { return namespace_ + "/" + name; }
  template <typename Message>
  void write(const std::string& topic, Message message, const std_msgs::Header& header);
  void writeReaction(const NamedReaction& reaction, const std_msgs::Header& header);
  void writeTransform(const Eigen::Isometry3d& pose, const std::string& child,
                      const std_msgs::Header& header);

  std::string namespace_, body_frame_, output_frame_;
  Points blade_;
  ResultBagExtras extras_;
  ros::Time revision_stamp_;  ///< of the first frame with these topologies
  std::uint32_t revision_ = 0;
  AtomicBag* bag_;
};

}  // namespace softbody

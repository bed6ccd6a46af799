#pragma once

#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "softbody_common/pinhole.h"
#include "softbody_common/types.h"
#include "softbody_evaluation/measures/pose_error.h"
#include "softbody_evaluation/measures/stage_times.h"

namespace softbody::evaluation {

/// A deforming surface out of a bag.
struct SurfaceRecord {
  std::string frame_id;                              ///< of the states
  std::map<std::uint32_t, MeshTopology> topologies;  ///< by revision
  std::map<Nanoseconds, MeshState> states;           ///< by stamp
  std::vector<std::string> notes;                    ///< what was left out, in sentences
};

/// States that are not finite, or of a topology that the bag does not hold, are left out: frames without an
/// answer.
/// @throw std::invalid_argument with path and topic if a topic is missing or malformed, no state is usable,
/// or the states are in more than one frame.
SurfaceRecord readSurface(const std::string& path, const std::string& topology_topic,
                          const std::string& state_topic);

/// Each once.
void addNotes(const std::vector<std::string>& more, std::vector<std::string>* notes);

/// Moves the surface's states into another frame by the /tf and /tf_static of these bags, at each state's
/// stamp. States without a transform are left out, with a note.
/// @param states what the note calls them. @throw std::invalid_argument if no state has a transform.
void expressIn(const std::string& frame_id, const std::vector<std::string>& paths, SurfaceRecord* surface,
               const std::string& states = "states");

/// The same for a tool's poses, but none may be left.
void expressIn(const std::string& frame_id, const std::vector<std::string>& paths, ToolRecord* tool);

/// PoseStamped or PoseWithCovarianceStamped; empty if the topic is not there.
/// @throw std::invalid_argument if it is of another type.
ToolRecord readPoses(const std::string& path, const std::string& topic);

/// StageTiming; empty if the topic is not there.
StageTimes readStageTimes(const std::string& path, const std::string& topic);

/// TrackingStatus: frames by the name of their state; empty if the topic is not there.
/// @throw std::invalid_argument if it is of another type, or holds an unknown state.
std::map<std::string, std::size_t> readTrackingStates(const std::string& path, const std::string& topic);

/// A colour image and its depth, without distortion.
struct RecordedFrame {
  Nanoseconds stamp = 0;  ///< of the colour image
  std::string frame_id;
  Pinhole camera;
  cv::Mat3b color;  ///< b, g, r
  cv::Mat1f depth;  ///< registered to colour [m]; 0: none. Empty where no depth image came
};

/// Calls `use` for every colour image in order. @param camera namespace of the camera's topics, e.g.
/// "/camera".
/// @throw std::invalid_argument with path and topic if a topic is missing or an image cannot be used.
void readRecording(const std::string& path, const std::string& camera,
                   const std::function<void(const RecordedFrame&)>& use);

/// frame_id of the first colour image. @throw std::invalid_argument if there is none.
std::string recordingFrame(const std::string& path, const std::string& camera);

/// Whether the bag holds the camera's colour and depth.
bool hasRecording(const std::string& path, const std::string& camera);

}  // namespace softbody::evaluation

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identification/material_question.h"
#include "identification/shape_question.h"
#include "softbody_common/protocol/camera_topics.h"
#include "softbody_recordings/ros/graph_config.h"

namespace softbody {

/// A topic of geometry_msgs/WrenchStamped, and the pin region or obstacle at which it is measured.
struct WrenchTopic {
  std::string topic, at;
};

/// A known weight that lies on the body: an obstacle.
struct LaidWeight {
  std::string obstacle;
  double mass_kg = 0.0;
};

/// A recording of a body that is held, and what is known of the forces on it.
struct RecordingQuestion {
  MaterialQuestion material;  ///< its simulator is that of the parameters
  std::string recording, parameters;
  CameraTopics camera = "/camera";
  std::vector<std::string>
      pins;  ///< REGION or REGION@FRAME, the region as boxOf() reads it; also the object's
  std::vector<WrenchTopic> wrenches;
  std::vector<LaidWeight> weights;
  double wrench_std_n = 0.0;  ///< least deviation of a component of a measured force
  std::string frame;          ///< in which the body is simulated, z up; empty: of the parameters, or world
  std::string gripper;        ///< as in ReplayOptions
  double from_s = 0.0, to_s = 1e9;  ///< the used part, from the beginning of the recording
};

/// What was found, and how.
struct RecordingAnswer {
  MaterialAnswer answer;
  std::string sentences;  ///< which images were used, what a sensor does; a line each
};

/// @param warn called with warnings. @throw std::exception with what cannot be used, and what to do.
RecordingAnswer answer(const RecordingQuestion& question, const ObjectDescription& description,
                       const ObjectModel& model, const std::function<void(const std::string&)>& warn,
                       const std::function<void(double)>& progress);

}  // namespace softbody

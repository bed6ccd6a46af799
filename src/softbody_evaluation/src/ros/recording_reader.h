#pragma once

#include <functional>
#include <string>

#include "records/recorded_frame.h"
#include "softbody_common/protocol/camera_topics.h"

namespace softbody::evaluation {

/// Calls `use` with every colour image in the order of the stamps.
/// @throw std::invalid_argument with path and topic if a topic is missing or an image cannot be used.
void readRecording(const std::string& path, const CameraTopics& camera,
                   const std::function<void(const RecordedFrame&)>& use);

/// frame_id of the first colour image. @throw std::invalid_argument if there is no image.
std::string recordingFrame(const std::string& path, const CameraTopics& camera);

/// Whether the bag holds the camera's colour and depth.
bool hasRecording(const std::string& path, const CameraTopics& camera);

}  // namespace softbody::evaluation

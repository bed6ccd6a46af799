#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "softbody_common/types.h"
#include "softbody_recordings/validation/registration_shift.h"

namespace softbody::validation {

/// The contents of one topic.
struct StreamFacts {
  std::string topic, type;                    ///< the type is empty if the topic is missing
  std::vector<Nanoseconds> stamps, received;  ///< header stamps and record times, in the bag's order
  std::set<std::string> frame_ids;
  std::map<std::string, std::size_t> encodings;      ///< images by encoding
  std::map<std::pair<int, int>, std::size_t> sizes;  ///< images by (width, height) [px]
  std::size_t malformed = 0;                         ///< images with a wrong number of bytes

  bool present() const { return !type.empty(); }
};

/// A CameraInfo without its header.
struct CameraFacts {
  int width = 0, height = 0;                      ///< [px]
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< of K [px]
  std::string distortion_model;
  std::vector<double> distortion;
};

bool operator==(const CameraFacts& a, const CameraFacts& b);

/// Statistics of depth images at equal intervals, in the unit of the encoding.
struct DepthFacts {
  std::size_t images = 0;
  double valid_share = 0.0;  ///< of the pixels, 0..1
  double median = 0.0;       ///< of the valid pixels: millimetres if 16UC1, metres if 32FC1
};

/// The contents of a recording's camera topics.
struct RecordingFacts {
  std::string path;
  std::map<std::string, std::string> topics;  ///< all topics of the bag, with their types
  StreamFacts color, color_info, depth, depth_info;
  std::vector<CameraFacts> color_cameras, depth_cameras;  ///< different ones, in order of appearance
  DepthFacts depth_values;
  std::optional<RegistrationShift> shift;
};

}  // namespace softbody::validation

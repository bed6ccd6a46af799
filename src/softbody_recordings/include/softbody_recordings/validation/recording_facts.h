#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_recordings/validation/registration_shift.h"

namespace softbody::validation {

/// The contents of one topic.
struct StreamFacts {
  std::string topic, type;                    ///< the type is empty if the topic is missing
  std::vector<Nanoseconds> stamps, received;  ///< header stamps and record times, in the bag's order
  std::set<std::string> frame_ids;
  std::map<std::string, std::size_t> encodings;      ///< images by encoding
  std::map<std::pair<int, int>, std::size_t> sizes;  ///< images by (width, height) [px]
  std::string type_fault;                            ///< why its messages cannot be read; empty: they can

  bool present() const { return !type.empty(); }
};

/// A camera as it is used: without binning and region of interest.
struct CameraFacts {
  int width = 0, height = 0;                      ///< [px]
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< of the raw images [px]
};

bool operator==(const CameraFacts& a, const CameraFacts& b);

/// Statistics of depth images at equal intervals.
struct DepthFacts {
  std::size_t images = 0;
  double valid_share = 0.0;   ///< of the pixels, 0..1
  double usable_share = 0.0;  ///< of the pixels: in the range of camera_ingest
  double median = 0.0;        ///< of the valid pixels, in the unit of the encoding
  double unit_m = 0.001;      ///< [m]
};

/// Frames or images that cannot be used for one reason.
struct Unusable {
  int count = 0;
  int first = 0;  ///< its number, from 0
};

/// What replay and evaluate make of the recording.
struct FrameFacts {
  int frames = 0;                            ///< colour images that make a frame, usable or not
  int with_depth = 0;                        ///< usable ones with depth
  std::map<std::string, Unusable> unusable;  ///< by reason
  std::vector<std::string> notes;            ///< what is unusual about the camera
};

/// What the tracker makes of the recording with an object.
struct TrialFacts {
  std::string object;  ///< the object's file
  int frames = 0;      ///< given to the tracker, the last of them with the body
  bool found = false;
  double found_after_s = 0.0;            ///< after the first frame
  std::string first_reason;              ///< why the first frame does not show the body; empty: it does
  double unit_m = 0.0;                   ///< of depth [m]
  std::optional<double> fitting_unit_m;  ///< unit in which the first frame shows the body [m]
};

/// The contents of a recording's camera topics.
struct RecordingFacts {
  std::string path;
  std::map<std::string, std::string> topics;  ///< all topics of the bag, with their types
  StreamFacts color, color_info, depth, depth_info;
  std::vector<CameraFacts> color_cameras, depth_cameras;  ///< different ones, in order of appearance
  FrameFacts frames;
  DepthFacts depth_values;
  std::optional<RegistrationShift> shift;
  std::optional<TrialFacts> trial;  ///< nothing: no object is known
};

}  // namespace softbody::validation

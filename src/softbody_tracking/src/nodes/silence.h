#pragma once

#include <ros/time.h>

#include <cmath>
#include <sstream>
#include <string>

namespace softbody {

constexpr double kSilence_s = 2.0;

/// Whether no frame has come for over kSilence_s, or since a bag started again; in ROS time, which a bag that
/// is held holds too. By when frames came, not by their stamps: the camera's clock may be another.
inline bool isSilent(const ros::Time& last_arrival) {
  return last_arrival.isZero() || std::abs((ros::Time::now() - last_arrival).toSec()) > kSilence_s;
}

inline std::string silenceInWords() {
  std::ostringstream words;
  words << "no frame from camera_ingest for over " << kSilence_s << " s";
  return words.str();
}

}  // namespace softbody

#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <string>

namespace softbody::evaluation {

/// Pictures of a report, by file name.
using Pictures = std::map<std::string, cv::Mat3b>;

}  // namespace softbody::evaluation

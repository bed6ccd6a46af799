#include "softbody_tracking/tool/marker_absence.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "tool/borderless_markers.h"
#include "tool/marker_dictionary.h"

namespace softbody {
namespace {

constexpr double kSmallestPerimeter = 0.005;  // of the image's larger side, when small markers are looked for
/// With the largest dictionary of each kind, those with many bits first: they are never found by chance.
constexpr const char* kOthers[] = {"DICT_7X7_1000",      "DICT_APRILTAG_36h11", "DICT_APRILTAG_36h10",
                                   "DICT_6X6_1000",      "DICT_5X5_1000",       "DICT_ARUCO_ORIGINAL",
                                   "DICT_APRILTAG_25h9", "DICT_APRILTAG_16h5",  "DICT_4X4_250"};

struct Found {
  int id;
  double side_px;
};

std::vector<Found> found(const cv::Mat1b& gray, const aruco::Detector& detector,
                         const aruco::Options& options = {}) {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  detector.detect(gray, &corners, &ids, options);
  std::vector<Found> markers;
  for (std::size_t i = 0; i < ids.size(); ++i)
    markers.push_back({ids[i], cv::arcLength(corners[i], true) / 4.0});
  return markers;
}

/// Looks for one tool's markers in one image.
class Search {
 public:
  Search(const ToolDescription& tool, const cv::Mat1b& gray)
      : dictionary_name_(tool.dictionary),
        dictionary_(uprightDictionary(tool.dictionary)),
        detector_(dictionary_),
        gray_(gray) {
    for (const ToolMarker& marker : tool.markers) ids_.insert(marker.id);
    cv::bitwise_not(gray, inverted_);
  }

  std::string cause() const {
    for (const auto& look : {&Search::faint, &Search::inverted, &Search::mirrored, &Search::withoutMargin,
                             &Search::small, &Search::otherIds, &Search::otherDictionary}) {
      const std::string sentence = (this->*look)();
      if (!sentence.empty()) return sentence;
    }
    return {};
  }

 private:
  /// One of the tool's own among the markers, or a marker with id -1.
  template <typename Marker>
  Found own(const std::vector<Marker>& markers) const {
    for (const Marker& marker : markers) {
      if (ids_.count(marker.id) > 0) return {marker.id, marker.side_px};
    }
    return {-1, 0.0};
  }

  std::string faint() const {
    const Found marker = own(found(gray_, detector_));
    if (marker.id < 0) return {};
    return fmt::format(
        "marker {} is recognized, but its sides cannot be measured: they are covered, blurred, or have too "
        "little contrast to what is around them; leave a white margin around the marker",
        marker.id);
  }

  std::string inverted() const {
    Found marker = own(found(inverted_, detector_));
    if (marker.id < 0) marker = own(borderlessMarkers(inverted_, dictionary_));
    if (marker.id < 0) return {};
    return fmt::format("marker {} is printed inverted, with black and white exchanged; print it again",
                       marker.id);
  }

  std::string mirrored() const {
    cv::Mat1b flipped;
    cv::flip(gray_, flipped, 1);
    const Found marker = own(found(flipped, detector_));
    if (marker.id < 0) return {};
    return fmt::format(
        "marker {} is mirrored: print it again, or switch off the mirroring of the camera's image",
        marker.id);
  }

  std::string withoutMargin() const {
    const Found marker = own(borderlessMarkers(gray_, dictionary_));
    if (marker.id < 0) return {};
    return fmt::format(
        "marker {} has no white margin: leave a margin around it that is as wide as one of its squares",
        marker.id);
  }

  std::string small() const {
    cv::Mat1b larger;
    cv::resize(gray_, larger, {}, 2.0, 2.0, cv::INTER_CUBIC);
    const Found marker = own(found(larger, detector_, {0, kSmallestPerimeter}));
    if (marker.id < 0) return {};
    return fmt::format(
        "marker {} is only {:.0f} pixels wide: bring the camera nearer, print it larger, or use a higher "
        "resolution",
        marker.id, 0.5 * marker.side_px);
  }

  std::string otherIds() const {
    std::set<int> others;
    for (const Found& marker : found(gray_, detector_)) others.insert(marker.id);
    if (others.empty()) return {};
    return fmt::format("the image shows marker {} of {}, but the tool YAML names {}", fmt::join(others, ", "),
                       dictionary_name_, fmt::join(ids_, ", "));
  }

  std::string otherDictionary() const {
    for (const char* name : kOthers) {
      const std::vector<Found> markers = found(gray_, aruco::Detector(uprightDictionary(name)));
      if (markers.empty()) continue;
      return fmt::format("the image shows marker {} of {}, but the dictionary in the tool YAML is {}",
                         markers[0].id, name, dictionary_name_);
    }
    return {};
  }

  std::string dictionary_name_;
  aruco::Dictionary dictionary_;
  aruco::Detector detector_;
  cv::Mat1b gray_, inverted_;
  std::set<int> ids_;  ///< of the tool's markers
};

}  // namespace

std::string whyMarkersAreMissed(const ToolDescription& tool, const cv::Mat3b& color) {
  cv::Mat1b gray;
  cv::cvtColor(color, gray, cv::COLOR_BGR2GRAY);
  return Search(tool, gray).cause();
}

}  // namespace softbody

#pragma once

#include <opencv2/core.hpp>
#include <vector>

// OpenCV 4.7 moved markers from the contrib module aruco to objdetect, and changed their functions.
#define SOFTBODY_ARUCO_IN_OBJDETECT (CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7))
#if SOFTBODY_ARUCO_IN_OBJDETECT
#include <opencv2/objdetect/aruco_detector.hpp>
#else
#include <opencv2/aruco.hpp>
#endif

/// OpenCV's markers, the same for every version.
namespace softbody::aruco {

using cv::aruco::Dictionary;

/// @param number e.g. cv::aruco::DICT_4X4_50.
inline Dictionary predefinedDictionary(int number) {
#if SOFTBODY_ARUCO_IN_OBJDETECT
  return cv::aruco::getPredefinedDictionary(number);
#else
  return *cv::aruco::getPredefinedDictionary(number);
#endif
}

/// The marker with its border, `side` pixels wide.
inline cv::Mat1b markerImage(const Dictionary& dictionary, int id, int side) {
  cv::Mat1b image;
#if SOFTBODY_ARUCO_IN_OBJDETECT
  cv::aruco::generateImageMarker(dictionary, id, side, image);
#else
  cv::aruco::drawMarker(cv::makePtr<Dictionary>(dictionary), id, side, image);
#endif
  return image;
}

/// With OpenCV's default, the edge of a bright plate around a marker can suppress the marker.
constexpr double kMinMarkerDistanceRate = 0.02;

/// How markers are looked for.
struct Options {
  int window_px = 0;  ///< side of the adaptive threshold's window, odd; 0: OpenCV's three windows in turn
  double min_perimeter_rate = 0.03;  ///< as in cv::aruco::DetectorParameters, OpenCV's default
};

class Detector {
 public:
  explicit Detector(const Dictionary& dictionary) : dictionary_(cv::makePtr<Dictionary>(dictionary)) {}

  void detect(const cv::Mat1b& gray, std::vector<std::vector<cv::Point2f>>* corners, std::vector<int>* ids,
              const Options& options = {}) const {
    cv::aruco::DetectorParameters parameters;
    parameters.minMarkerDistanceRate = kMinMarkerDistanceRate;
    parameters.minMarkerPerimeterRate = options.min_perimeter_rate;
    if (options.window_px > 0)
      parameters.adaptiveThreshWinSizeMin = parameters.adaptiveThreshWinSizeMax = options.window_px;
#if SOFTBODY_ARUCO_IN_OBJDETECT
    cv::aruco::ArucoDetector(*dictionary_, parameters).detectMarkers(gray, *corners, *ids);
#else
    cv::aruco::detectMarkers(gray, dictionary_, *corners, *ids,
                             cv::makePtr<cv::aruco::DetectorParameters>(parameters));
#endif
  }

 private:
  cv::Ptr<Dictionary> dictionary_;
};

}  // namespace softbody::aruco

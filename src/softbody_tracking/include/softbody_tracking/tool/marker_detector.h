#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace softbody {

/// One square marker in an image.
struct MarkerDetection {
  int id = 0;
  /// 2 by 4 [px], clockwise on the print, starting at its top left. Pixel centres have integer coordinates.
  Eigen::Matrix<double, 2, 4> corners;
};

/// Names of OpenCV's predefined dictionaries, such as "DICT_4X4_50".
std::vector<std::string> dictionaryNames();

/// Number of markers in a dictionary.
/// @param dictionary a predefined name, or a file in OpenCV's format (YAML with nmarkers, markersize,
/// marker_0, ...).
/// @throw std::invalid_argument with the known names if it is neither.
int markersInDictionary(const std::string& dictionary);

/// Cells of a marker (bits and black border, without white margin), from the top row: black 0, white 255.
cv::Mat1b markerCells(const std::string& dictionary, int id);

/// Detects ArUco and AprilTag markers of one dictionary. Corners have sub-pixel precision.
class MarkerDetector {
 public:
  /// @throw std::invalid_argument as markersInDictionary.
  explicit MarkerDetector(const std::string& dictionary);
  ~MarkerDetector();

  /// Cells along a marker's side, with the black border.
  int cells() const;

  /// @param region part of the image to search; empty: the whole image. @param window_px side of the window
  /// of the adaptive threshold, odd; 0: three windows one after the other, which takes three times as long.
  std::vector<MarkerDetection> detect(const cv::Mat1b& gray, const cv::Rect& region = {},
                                      int window_px = 0) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody

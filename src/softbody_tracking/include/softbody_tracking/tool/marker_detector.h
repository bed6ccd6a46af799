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
  /// 2 by 4 [px], clockwise on the print from its top left; pixel centres at whole numbers.
  Eigen::Matrix<double, 2, 4> corners;
};

/// Names of OpenCV's predefined dictionaries, "DICT_4X4_50" and so on.
std::vector<std::string> dictionaryNames();

/// @param dictionary a predefined name, or a file of one's own in OpenCV's format (YAML with nmarkers,
/// markersize, marker_0, ...). @throw std::invalid_argument with the known names if it is neither.
int markersInDictionary(const std::string& dictionary);

/// Cells of a marker without margin, black 0 and white 255: bits plus the black border, row by row from the
/// top.
cv::Mat1b markerCells(const std::string& dictionary, int id);

/// Finds ArUco and AprilTag markers of one dictionary, with corners at sub-pixel precision.
class MarkerDetector {
 public:
  /// @throw std::invalid_argument as markersInDictionary.
  explicit MarkerDetector(const std::string& dictionary);
  ~MarkerDetector();

  /// @param region searched part of the image, clipped to it; empty: all.
  std::vector<MarkerDetection> detect(const cv::Mat1b& gray, const cv::Rect& region = {}) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody

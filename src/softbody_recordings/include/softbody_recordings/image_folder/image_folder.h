#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_common/types.h"

namespace softbody {

/// The camera of a folder of images: a YAML file with image_width, image_height, K (nine numbers, row by row)
/// and, optionally, D (plumb_bob, or rational_polynomial with eight), distortion_model, depth.unit (mm, m) or
/// depth.scale (units a metre).
struct FolderCamera {
  Pinhole camera;
  std::string distortion_model = "plumb_bob";
  std::vector<double> distortion;
  double depth_units_per_m = 1000.0;
  std::vector<std::string> warnings;  ///< unknown keys
};

struct ImageFile {
  Nanoseconds stamp = 0;
  std::filesystem::path path;
};

/// Colour and depth files in the order of their stamps.
struct ImageFolder {
  FolderCamera camera;
  std::vector<ImageFile> color, depth;
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// Stamp of file number 0; fixed, so that the same folder always gives the same bag.
constexpr Nanoseconds kFolderStart = 1'600'000'000'000'000'000;

/// @throw std::runtime_error naming file and key.
FolderCamera readFolderCamera(const std::filesystem::path& file);

/// Lists DIR/color and DIR/depth, where file k is stamped kFolderStart + k / rate, or a folder of the TUM
/// RGB-D kind (rgb.txt and depth.txt; nearest stamps within 20 ms make a pair, stamped as its colour image).
/// @param camera_file empty: DIR/camera.yaml; a TUM folder without one gets the published fr1 values and a
/// warning.
/// @throw std::runtime_error naming the file.
ImageFolder readImageFolder(const std::filesystem::path& directory, const std::filesystem::path& camera_file,
                            double rate_hz);

/// @throw std::runtime_error naming the file if it is not an 8-bit image of the camera's size.
cv::Mat3b readColor(const std::filesystem::path& file, const Pinhole& camera);

/// CV_16UC1 [mm] where the files are in millimetres, otherwise CV_32FC1 [m]; 0: none.
/// @throw std::runtime_error naming the file if it is not a 16-bit image of the camera's size.
cv::Mat readDepth(const std::filesystem::path& file, const FolderCamera& camera);

}  // namespace softbody

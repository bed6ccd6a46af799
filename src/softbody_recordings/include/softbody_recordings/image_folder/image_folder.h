#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// The camera of a folder of images, from a YAML file. Required keys: image_width, image_height, K (nine
/// numbers, row by row). Optional keys: D (plumb_bob, or rational_polynomial with eight numbers),
/// distortion_model, depth.unit (mm, m) or depth.scale (units per metre).
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

/// Colour and depth files, in the order of their stamps.
struct ImageFolder {
  FolderCamera camera;
  std::vector<ImageFile> color, depth;
  std::vector<std::string> warnings;  ///< to be shown to the user
};

/// Stamp of file number 0. It is constant, so that a folder always gives the same bag.
constexpr Nanoseconds kFolderStart = 1'600'000'000'000'000'000;

/// @throw std::runtime_error with file and key.
FolderCamera readFolderCamera(const std::filesystem::path& file);

/// Lists the images of DIR/color and DIR/depth; file k gets the stamp kFolderStart + k / rate. Or lists a
/// folder of the TUM RGB-D benchmark (rgb.txt and depth.txt): the nearest stamps within 20 ms make a pair,
/// with the stamp of the colour image.
/// @param camera_file if empty, DIR/camera.yaml. A TUM folder without this file gets the published fr1 values
/// and a warning.
/// @param scope where the images and DIR/camera.yaml may be. @throw std::runtime_error with the file.
ImageFolder readImageFolder(const std::filesystem::path& directory, const std::filesystem::path& camera_file,
                            double rate_hz, FileScope scope = FileScope::kOwnFolder);

/// Reads an image as b, g, r.
/// @throw std::runtime_error with the file if it is not an 8-bit image of the camera's size.
cv::Mat3b readColor(const std::filesystem::path& file, const Pinhole& camera);

/// Reads depth as CV_16UC1 [mm] if the files are in millimetres, otherwise as CV_32FC1 [m]; 0: not measured.
/// @throw std::runtime_error with the file if it is not a 16-bit image of the camera's size.
cv::Mat readDepth(const std::filesystem::path& file, const FolderCamera& camera);

}  // namespace softbody

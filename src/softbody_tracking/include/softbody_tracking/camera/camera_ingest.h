#pragma once

#include <memory>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_tracking/camera/camera_images.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

struct CameraIngestConfig {
  double min_depth_m = 0.1, max_depth_m = 5.0;  ///< depth outside of this range is removed
  bool keep_all_depth = false;                  ///< neither range nor edges remove depth (evaluation)
};

const ParameterTable<CameraIngestConfig>& cameraIngestParameters();

/// Makes a rectified RgbdFrame without flying pixels from raw colour and registered depth.
class CameraIngest {
 public:
  explicit CameraIngest(const CameraIngestConfig& config);
  ~CameraIngest();

  /// The frame shares the memory of the colour image if this is already rectified. Depth is NaN where nothing
  /// was measured.
  /// @throw std::invalid_argument if the sizes, the types or the distortion are wrong.
  RgbdFrame process(const CameraImages& images);

  /// The frame's colour alone. @throw std::invalid_argument as process().
  cv::Mat3b color(const CameraImages& images);
  /// The frame's depth alone; the colour image may be empty. @param depth its memory is used if it has the
  /// size of the rectified camera. @throw std::invalid_argument as process().
  void depth(const CameraImages& images, cv::Mat1f* depth);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody

#pragma once

#include <optional>
#include <vector>

#include "picture/picture_fit.h"
#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// A pose, and how the body's picture fits there.
struct PicturedPose {
  PoseHypothesis pose;
  PictureFit fit;
};

/// Compares the body's picture with one frame. The meshes must have a picture, and outlive it.
class PictureJudge {
 public:
  PictureJudge(const RgbdFrame& frame, const SearchMeshes& meshes)
      : frame_(colorFrame(frame)), meshes_(meshes) {}

  PictureFit fitAt(const Eigen::Isometry3d& pose) const {
    return pictureFit(colorPatches(frame_, meshes_.full, meshes_.picture, pose));
  }
  /// The same for all, the one with the most evidence first.
  std::vector<PicturedPose> judged(const std::vector<PoseHypothesis>& poses) const;

 private:
  RgbdFrame frame_;
  const SearchMeshes& meshes_;
};

/// Where the picture is seen.
struct PicturedPlace {
  /// The pose with the most evidence. FoundPose::alike counts those in its place that are nearly as likely.
  std::optional<FoundPose> body;
  bool several = false;  ///< in several places: nothing tells the body from its twin
};

/// @param judged all of them agree with the depth; the most evidence first. @param tried poses of the search.
PicturedPlace picturedPlace(const SearchMeshes& meshes, const std::vector<PicturedPose>& judged, int tried);

}  // namespace softbody

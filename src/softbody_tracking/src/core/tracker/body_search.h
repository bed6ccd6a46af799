#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"
#include "registration/rough_pose.h"
#include "search_report/search_report.h"
#include "softbody_common/time/stage_timer.h"
#include "softbody_common/time/time.h"
#include "softbody_tracking/tracker_config.h"
#include "tracker/backoff.h"
#include "tracker/frame_observer.h"

namespace softbody {

/// Decides when to search for the body, and where: at the start and after a loss, while no prediction exists.
/// At the start: near the pose of the object's file or of the user; anywhere only without one, or if `search`
/// says so. After a loss: where features are recognised, then anywhere; but far from the last place features
/// must confirm the pose.
class BodySearch {
 public:
  enum class Outcome {
    kNotFound,
    kFound,   ///< by a search in this frame
    kPlaced,  ///< without a search, see placeAt()
    kTracked  ///< no search was necessary: the body was found before and is not lost
  };

  /// @param picture of the body: blue, green, red; empty: not known.
  BodySearch(const RegistrationConfig& config, cv::Mat3b picture)
      : config_(config), picture_(std::move(picture)) {}

  /// Of another body; its meshes follow. Empty: not known.
  void setPicture(cv::Mat3b picture) { picture_ = std::move(picture); }

  /// Forgets where the body is.
  void reset();
  /// After reset(): searches near this pose instead of the object file's. @param rough_pose in the fixed
  /// frame.
  void startNear(const Eigen::Isometry3d& rough_pose);
  /// After reset(): the body is there in the next frame, without a search. @param pose in the fixed frame.
  void placeAt(const Eigen::Isometry3d& pose);
  /// Call it when the body is edited: a frame after a cut does not wait for meshes that only a search needs.
  void forgetMeshes() { meshes_.reset(); }
  /// Call it when the models come: the first frame does not wait for the meshes that its search needs.
  void prepareMeshes(const MeshTopology& surface);

  /// Searches for the body if it is not tracked and a search is due.
  /// @param observer gives the models, features and colours, and tests poses by features.
  Outcome locate(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer);

  /// Call it after each frame in which the body was tracked. After kLongestGap without it the search begins.
  void noteLoss(bool lost, Nanoseconds stamp);
  /// Sets the pose from tracking. A later search starts there.
  void setPose(const Eigen::Isometry3d& pose) { pose_ = pose; }

  /// Pose of the rest shape in the fixed frame.
  const Eigen::Isometry3d& pose() const { return pose_; }
  /// Whether the body was lost and has not been tracked since.
  bool recovering() const { return recovering_; }
  /// The last search that failed; a default one: none has.
  const SearchReport& report() const { return report_; }
  int alike() const { return alike_; }               ///< see FoundPose, of the last search
  Nanoseconds foundAt() const { return found_at_; }  ///< stamp of the frame of that search

 private:
  void takeInitialPose(const RgbdFrame& frame, const TetTopology& volume);
  std::optional<FoundPose> searchByFeatures(const RgbdFrame& frame, FrameObserver* observer,
                                            StageTimer* timer);
  std::optional<FoundPose> searchByDepth(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer);
  SearchOutcome searchByDepthNow(const RgbdFrame& frame, const SearchMeshes& meshes,
                                 FrameObserver* observer) const;
  RoughPose lastPose(const RgbdFrame& frame) const;
  bool searchesAnywhere() const { return recovering_ || !given_ || config_.anywhere; }
  SearchReport explained(const RgbdFrame& frame, const SearchMeshes& meshes, const FrameObserver& observer,
                         const SearchOutcome& outcome);
  const SearchMeshes& meshesOf(const MeshTopology& surface);
  void startTracking(const RgbdFrame& frame, const FoundPose& found);

  RegistrationConfig config_;
  cv::Mat3b picture_;
  std::unique_ptr<SearchMeshes> meshes_;  ///< after an edit made at the next search
  bool first_frame_ = true;               ///< no frame since the last reset
  bool placed_ = false;                   ///< by placeAt(), and no frame since then
  bool tracked_ = false;
  bool recovering_ = false;
  int alike_ = 1;
  std::optional<Eigen::Isometry3d> given_;  ///< rough pose of the object's file or the user, fixed frame
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  Nanoseconds found_at_ = 0;
  std::optional<Nanoseconds> lost_since_;  ///< stamp of the first frame without the tracked body
  Nanoseconds last_seen_ = 0;              ///< stamp of the last frame with it
  Backoff depth_search_, feature_search_;
  Backoff scale_search_{kLatestTime};
  std::optional<double> fitting_scale_;  ///< see fittingScale()
  SearchReport report_;
};

}  // namespace softbody

#include "softbody_recordings/ros/object_trial.h"

#include "softbody_common/images/object_texture.h"
#include "softbody_common/time/time.h"
#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_tracking/depth_unit/depth_unit.h"

namespace softbody {

validation::TrialFacts tryObject(const std::string& path, const BagFramesConfig& config,
                                 const std::string& object, FileScope scope,
                                 const std::function<void(double)>& progress) {
  PipelineConfig defaults;
  try {
    defaults.picture = readObjectTexture(object, scope);
  } catch (const std::invalid_argument&) {  // it is searched for without the picture, as replay does
  }
  Pipeline pipeline(buildObjectModel(loadObjectDescription(object, scope)), defaults);
  BodyTracker tracker(defaults.tracker, defaults.picture);
  tracker.setTopologies(pipeline.volumeTopology(), pipeline.surfaceTopology());
  CameraIngest ingest{CameraIngestConfig()};
  StageTimer timer;
  validation::TrialFacts trial;
  trial.object = object;
  CameraImages first;  // with depth
  BagFramesUse use;
  use.frame = [&](const CameraImages& images, const std_msgs::Header&, double share) {
    if (trial.found) return;
    const TrackingResult result = tracker.track(ingest.process(images), nullptr, &timer);
    if (trial.frames++ == 0) first = images, first.depth = images.depth.clone();
    trial.found = result.has_targets;
    trial.found_after_s = seconds(images.stamp - first.stamp);
    trial.unit_m = unitOf(images);
    progress(share);
    if (!trial.found && trial.frames == 1) trial.first_reason = result.status.reason;
  };
  use.enough = [&trial] { return trial.found; };
  readBagImages(openBag(path), config, use);
  // As replay does: a body that comes into view later is no matter of the unit.
  if (!trial.found && trial.frames > 0)
    trial.fitting_unit_m = depthUnitThatFits(first, &ingest, defaults.tracker, pipeline.volumeTopology(),
                                             pipeline.surfaceTopology());
  return trial;
}

}  // namespace softbody

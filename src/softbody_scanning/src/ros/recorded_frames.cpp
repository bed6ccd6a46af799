#include "softbody_scanning/ros/recorded_frames.h"

#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_scanning/key_frames/key_frame_choice.h"

namespace softbody::scanning {

RecordedFrames readFrames(const std::string& bag, const CameraTopics& camera, CameraMotion* motion,
                          const std::function<void(double)>& progress) {
  const rosbag::Bag input = openBag(bag);
  RecordedFrames recorded;
  KeyFrameChoice choice;
  CameraIngest ingest({});
  const auto use = [&](RgbdFrame frame, const std_msgs::Header&, double share) {
    progress(share);
    ++recorded.frames;
    if (frame.depth.empty()) {
      ++recorded.without_depth;
      return;
    }
    frame.placed = false;
    const auto pose = motion->poseOf(frame);
    if (!pose) {
      ++recorded.unposed[motion->reason()];
      return;
    }
    ++recorded.posed;
    choice.add({frame.stamp, frame.camera, frame.color, frame.depth, pose->T_camera_model,
                sharpnessOf(frame.color)});
  };
  readBagFrames(input, {camera, {}}, &ingest, use);
  recorded.key_frames = choice.take();
  return recorded;
}

}  // namespace softbody::scanning

#include "softbody_scanning/ros/recording_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "key_frames/key_frame_choice.h"
#include "markerless/markerless_motion.h"
#include "motion/sheet_depth.h"
#include "motion/sheet_motion.h"
#include "ros/transform_motion.h"
#include "softbody_common/ros/time.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/input_bag.h"

namespace softbody::scanning {
namespace {

constexpr int kLookFrames = 90, kLookEvery = 10;  // of the beginning
constexpr double kLargestScaleError = 0.05;       // beyond any camera's calibration and any printer

/// Reads the frames and keeps the key frames.
class Reader {
 public:
  Reader(CameraMotion* motion, RecordingReport* report) : motion_(motion), report_(report) {}

  void add(RgbdFrame frame) {
    ++report_->frames;
    cv::patchNaNs(frame.depth, 0.0);
    if (frame.depth.empty() || cv::countNonZero(frame.depth) == 0) {
      ++report_->unposed["no depth"];
      return;
    }
    frame.placed = false;
    const auto pose = motion_->poseOf(frame);
    if (!pose) {
      ++report_->unposed[motion_->reason()];
      return;
    }
    ++report_->posed;
    variance_ += pose->covariance.topLeftCorner<3, 3>().trace();
    choice_.add({frame.stamp, frame.camera, frame.color, frame.depth, pose->T_camera_model,
                 sharpnessOf(frame.color)});
  }

  std::vector<KeyFrame> finish() {
    std::vector<KeyFrame> frames = choice_.take();
    report_->key_frames = static_cast<int>(frames.size());
    if (report_->posed > 0) report_->position_std_m = std::sqrt(variance_ / report_->posed);
    return frames;
  }

 private:
  CameraMotion* motion_;
  RecordingReport* report_;
  KeyFrameChoice choice_;
  double variance_ = 0.0;
};

/// ", mostly because ..." of the frames without a pose; empty: there are none.
std::string commonReason(const RecordingReport& report) {
  std::string reason;
  int most = 0;
  for (const auto& [why, frames] : report.unposed)
    if (frames > most) reason = ", mostly because " + why, most = frames;
  return reason;
}

void requireFrames(const RecordingReport& report) {
  if (report.key_frames > 0) return;
  if (report.unposed.count("no depth") > 0 && report.unposed.at("no depth") == report.frames)
    throw std::invalid_argument(fmt::format(
        "no frame has depth between {} and {} m; record the depth images, too, and set their unit "
        "(--depth-scale)",
        CameraIngestConfig().min_depth_m, CameraIngestConfig().max_depth_m));
  throw std::invalid_argument(
      fmt::format("the camera's pose is known in none of {} frames{}", report.frames, commonReason(report)));
}

void requireScale(double scale) {
  if (scale == 0.0 || std::abs(scale - 1.0) <= kLargestScaleError) return;
  throw std::invalid_argument(
      fmt::format("depth shows the sheet {:.3g} times as far as its printed size does; set the unit of depth "
                  "(--depth-scale), or, "
                  "if the sheet was not printed at 100 %, measure its ruler and print it again",
                  scale));
}

/// What the beginning of a recording shows.
struct Beginning {
  int looked_at = 0, with_sheet = 0;
  std::vector<Nanoseconds> stamps;
};

/// Looks at frames of the first seconds, a few in each.
Beginning lookAtBeginning(const rosbag::Bag& bag, const CameraTopics& camera, SheetMotion* sheet,
                          TransformMotion* transforms) {
  Beginning beginning;
  int frames = 0;
  CameraIngest ingest({});
  BagFramesUse use;
  use.frame = [&](const CameraImages& images, const std_msgs::Header& header, double) {
    transforms->setCameraFrame(header.frame_id);
    beginning.stamps.push_back(toNanoseconds(header.stamp));
    if (frames++ % kLookEvery != 0) return;
    ++beginning.looked_at;
    RgbdFrame frame = ingest.process(images);
    frame.placed = false;
    if (sheet->poseOf(frame)) ++beginning.with_sheet;
  };
  use.enough = [&] { return frames >= kLookFrames; };
  readBagImages(bag, {camera, {}}, use);
  return beginning;
}

/// The motion that a recording's beginning tells of.
MotionSource sourceOf(const RecordingOptions& options, const rosbag::Bag& bag) {
  if (options.motion != MotionSource::kAuto) return options.motion;
  SheetMotion sheet(options.sheet);
  TransformMotion transforms(options.bag, options.fixed_frame);
  const Beginning beginning = lookAtBeginning(bag, options.camera, &sheet, &transforms);
  if (2 * beginning.with_sheet > beginning.looked_at) return MotionSource::kSheet;
  if (transforms.moves(beginning.stamps)) return MotionSource::kTransforms;
  return MotionSource::kNone;
}

std::unique_ptr<CameraMotion> motionOf(const RecordingOptions& options, MotionSource source) {
  if (source == MotionSource::kSheet) return std::make_unique<SheetMotion>(options.sheet);
  if (source == MotionSource::kTransforms)
    return std::make_unique<TransformMotion>(options.bag, options.fixed_frame);
  return std::make_unique<MarkerlessMotion>();
}

}  // namespace

const char* nameOf(MotionSource source) {
  switch (source) {
    case MotionSource::kAuto:
      return "auto";
    case MotionSource::kSheet:
      return "sheet";
    case MotionSource::kTransforms:
      return "tf";
    default:
      return "none";
  }
}

PosedRecording readRecording(const RecordingOptions& options, const std::function<void(double)>& progress,
                             RecordingReport* report) {
  const rosbag::Bag input = openBag(options.bag);
  PosedRecording recording{std::filesystem::path(options.bag).filename().string(), {}, {}};
  try {
    report->motion = sourceOf(options, input);
    const std::unique_ptr<CameraMotion> motion = motionOf(options, report->motion);
    Reader reader(motion.get(), report);
    CameraIngest ingest({});
    readBagFrames(input, {options.camera, {}}, &ingest,
                  [&](const RgbdFrame& frame, const std_msgs::Header& header, double share) {
                    progress(share);
                    if (auto* transforms = dynamic_cast<TransformMotion*>(motion.get()))
                      transforms->setCameraFrame(header.frame_id);
                    reader.add(frame);
                  });
    recording.frames = reader.finish();
    requireFrames(*report);
    recording.region = motion->modelFrame(&recording.frames).region;
    if (report->motion == MotionSource::kSheet)
      report->depth_scale = depthScale(recording.frames, recording.region);
    requireScale(report->depth_scale);
  } catch (const std::invalid_argument& error) {
    const std::string sentence = error.what();
    throw std::invalid_argument(sentence.rfind(options.bag, 0) == 0 ? sentence
                                                                    : options.bag + ": " + sentence);
  }
  return recording;
}

}  // namespace softbody::scanning

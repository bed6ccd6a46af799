#include <rosbag/bag.h>

#include <filesystem>

#include "fuzz/messages/camera_frames.h"
#include "fuzz/messages/target.h"
#include "fuzz/scratch_files.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/facts_reader.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/validation/checks.h"

namespace softbody::fuzz {
namespace {

constexpr int kFrames = 4;

/// A bag of some frames, which is validated, and read as a replay reads it.
class BagInput : public Input {
 public:
  int give(bool bad, Choice* choice) override {
    const std::string path = (scratch() / "recording.bag").string();
    const int mutated = write(path, bad, choice);
    const validation::RecordingFacts facts = validation::readFacts(path, BagFramesConfig(), [](double) {});
    validation::toText(facts, validation::check(facts));
    const rosbag::Bag bag = openBag(path);
    CameraIngest ingest{CameraIngestConfig()};
    read_ = 0;
    try {
      readBagFrames(bag, BagFramesConfig(), &ingest, [this](const auto&, const auto&, double) { ++read_; });
    } catch (const std::invalid_argument&) {
    }
    return mutated;
  }

  /// Frames of the last bag.
  int framesRead() const { return read_; }

 private:
  int write(const std::string& path, bool bad, Choice* choice) {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    int mutated = 0;
    const auto write = [&](const char* topic, auto message) {
      if (bad && choice->oneIn(kFrames)) {
        mutate(&message, choice);
        ++mutated;
      }
      bag.write(std::string("/") + topic, LoneRos::instance().now(), message);
    };
    for (int k = 0; k < kFrames; ++k) {
      LoneRos::instance().advance(0.033);
      const CameraFrame frame = frames_.next();
      write(topics::kCameraColor, frame.color);
      write(topics::kCameraColorInfo, frame.info);
      write(topics::kCameraDepth, frame.depth);
      write(topics::kCameraDepthInfo, frame.info);
    }
    return mutated;
  }

  CameraFrames frames_{"bend", 16, 12, {0.0, 1.0}, false};
  int read_ = 0;
};

class RecordingTarget : public Target {
 public:
  RecordingTarget() {
    auto bag = std::make_unique<BagInput>();
    bag_ = bag.get();
    inputs.push_back({std::move(bag), 1});
  }

  std::string check() override {
    Choice none(0);
    bag_->give(false, &none);
    return bag_->framesRead() == kFrames ? "" : "a good bag is not read";
  }

 private:
  BagInput* bag_;
};

}  // namespace

std::unique_ptr<Target> makeRecordingTarget() { return std::make_unique<RecordingTarget>(); }

}  // namespace softbody::fuzz

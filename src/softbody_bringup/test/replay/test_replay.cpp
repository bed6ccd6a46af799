#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "softbody_common/files/input_file.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/atomic_bag.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/replay.h"
#include "softbody_recordings/ros/result_bag.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

const std::string kBag = ROSBAGS_DIR "/bend_small.bag";
const std::string kObject = CONFIG_DIR "/sponge.yaml";

class ReplayTest : public ::testing::Test {
 protected:
  /// Replays the small bag into a file and returns what went by.
  std::vector<FrameOutput> replay(const fs::path& output) {
    const ObjectModel model = buildObjectModel(loadObjectDescription(kObject));
    Pipeline pipeline(model, PipelineConfig());
    CameraIngest ingest{CameraIngestConfig()};
    const rosbag::Bag input(kBag, rosbag::bagmode::Read);
    AtomicBag bag(output);
    ResultBag result(&bag, "/softbody");
    std::vector<FrameOutput> frames;
    const auto use = [&](const RgbdFrame& frame, const std_msgs::Header& header, double) {
      if (frames.empty())
        result.writeTopologies(pipeline.volumeTopology(), pipeline.surfaceTopology(), header.stamp);
      frames.push_back(pipeline.process(frame));
      result.writeFrame(frames.back(), header);
    };
    readBagFrames(input, BagFramesConfig(), &ingest, use);
    bag.finish();
    return frames;
  }

  void expectNothingIncomplete() const {
    for (const auto& entry : fs::directory_iterator(fs::path(folder_)))
      EXPECT_FALSE(says(entry.path().string(), ".part")) << entry.path();
  }

  const test::ScratchFolder folder_;
};

TEST_F(ReplayTest, AnswersEveryFrameAndGivesTheSameBytesTwice) {
  const std::vector<FrameOutput> frames = replay(folder_ / "first.bag");
  ASSERT_EQ(frames.size(), 45u);
  for (const FrameOutput& frame : frames) {
    ASSERT_TRUE(frame.surface.has_value());
    EXPECT_EQ(frame.surface->vertices.rows(), 522);
    EXPECT_EQ(frame.volume->vertices.rows(), 132);
    EXPECT_TRUE(frame.surface->vertices.allFinite());
    EXPECT_EQ(frame.tracking.status.state, TrackingState::kTracking) << frame.tracking.status.reason;
  }
  replay(folder_ / "second.bag");
  EXPECT_TRUE(readFile(folder_ / "first.bag") == readFile(folder_ / "second.bag"));
  expectNothingIncomplete();
}

/// Building the simulator counts as its initialization, as in the live graph. Its first step does not.
TEST_F(ReplayTest, EveryStageIsInitializedOnce) {
  std::map<std::string, int> initialized, steps;
  const std::vector<FrameOutput> frames = replay(folder_ / "result.bag");
  for (const FrameOutput& frame : frames) {
    for (const StageTime& time : frame.times) ++(time.initialization ? initialized : steps)[time.stage];
  }
  EXPECT_EQ(initialized, (std::map<std::string, int>{{"Feature-Point Tracking", 1},
                                                     {"Model Registration", 1},
                                                     {"Resolution Enhancement", 1},
                                                     {"Soft-body Simulation", 1},
                                                     {"Tracker Preparation", 1}}));
  EXPECT_EQ(steps["Soft-body Simulation"], static_cast<int>(frames.size()));
}

TEST_F(ReplayTest, LeavesAnEarlierResultAloneWhenItDoesNotFinish) {
  const fs::path output = folder_ / "result.bag";
  std::ofstream(output) << "an earlier result";
  { const AtomicBag unfinished(output); }
  EXPECT_EQ(readFile(output), "an earlier result");
  expectNothingIncomplete();
}

/// The small bag, played a number of times, with one frame's images stamped differently.
std::string bagWithStamp(const fs::path& path, int passes, int frame, const ros::Time& stamp) {
  rosbag::Bag in(kBag), out(path, rosbag::bagmode::Write);
  ros::Duration played;
  for (int pass = 0; pass < passes; ++pass) {
    rosbag::View view(in);
    std::map<std::string, int> images;
    for (const rosbag::MessageInstance& message : view) {
      auto image = message.instantiate<sensor_msgs::Image>();
      if (image && images[message.getTopic()]++ == frame) image->header.stamp = stamp;
      if (image)
        out.write(message.getTopic(), message.getTime() + played, image);
      else
        out.write(message.getTopic(), message.getTime() + played, message, message.getConnectionHeader());
    }
    played += view.getEndTime() - view.getBeginTime() + ros::Duration(0.1);
  }
  out.close();
  return path;
}

TEST_F(ReplayTest, OneOddStampCostsItsOwnFrame) {
  ReplayOptions options;
  options.objects = {kObject};
  options.output = folder_ / "result.bag";
  const auto quiet = [](const auto&) {};
  for (const ros::Time& stamp : {ros::Time(4294967295, 0), ros::Time(1, 0), ros::Time()}) {
    options.input = bagWithStamp(folder_ / "odd.bag", 1, 20, stamp);
    const ReplaySummary summary = softbody::replay(options, quiet, quiet);
    EXPECT_EQ(summary.bodies.front().states, 44) << stamp;
    EXPECT_EQ(summary.read.unpaired.outliers + summary.read.unpaired.unstamped, 2) << stamp;
  }
}

/// Stamps of the label images in a result.
std::vector<ros::Time> stampsOfLabels(const fs::path& path) {
  const rosbag::Bag bag(path);
  std::vector<ros::Time> stamps;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/softbody/labels"))) {
    const auto image = message.instantiate<sensor_msgs::Image>();
    EXPECT_EQ(image->encoding, "mono8");
    EXPECT_EQ(image->header.frame_id, "camera_color_optical_frame");
    EXPECT_EQ(image->header.stamp, message.getTime());
    stamps.push_back(image->header.stamp);
  }
  return stamps;
}

TEST_F(ReplayTest, WritesALabelImageForEachFrameWhenAsked) {
  ReplayOptions options;
  options.input = kBag;
  options.objects = {kObject};
  options.output = folder_ / "result.bag";
  const auto quiet = [](const auto&) {};
  softbody::replay(options, quiet, quiet);
  EXPECT_TRUE(stampsOfLabels(options.output).empty());
  options.labels = true;
  softbody::replay(options, quiet, quiet);
  const std::vector<ros::Time> stamps = stampsOfLabels(options.output);
  EXPECT_EQ(std::set<ros::Time>(stamps.begin(), stamps.end()).size(), 45u);
}

TEST_F(ReplayTest, ARecordingThatLoopsLosesNoFrame) {
  ReplayOptions options;
  options.objects = {kObject};
  options.output = folder_ / "result.bag";
  options.input = bagWithStamp(folder_ / "twice.bag", 2, -1, {});
  const auto quiet = [](const auto&) {};
  const ReplaySummary summary = softbody::replay(options, quiet, quiet);
  EXPECT_EQ(summary.bodies.front().states, 90);
  EXPECT_EQ(summary.bodies.front().frames_by_state.at(TrackingState::kTracking), 90);
}

TEST_F(ReplayTest, SaysInWhichFramesTheToolIsNotSeen) {
  ReplayOptions options;
  options.input = kBag;
  options.objects = {kObject};
  options.tool = CONFIG_DIR "/knife.yaml";
  options.output = folder_ / "result.bag";
  const auto quiet = [](const auto&) {};
  EXPECT_EQ(softbody::replay(options, quiet, quiet).bodies.front().tool_missed,
            "45 frames: no marker of the tool is seen");
  options.tool.clear();
  EXPECT_EQ(softbody::replay(options, quiet, quiet).bodies.front().tool_missed, "");
}

TEST_F(ReplayTest, NamesTheMissingTopicAndWhatIsThere) {
  const rosbag::Bag input(kBag, rosbag::bagmode::Read);
  CameraIngest ingest{CameraIngestConfig()};
  BagFramesConfig config;
  config.camera = "/other";
  const std::string said = complaint([&] {
    readBagFrames(input, config, &ingest, [](const RgbdFrame&, const std_msgs::Header&, double) {});
  });
  EXPECT_TRUE(says(said, "/other/color/image_raw"));
  EXPECT_TRUE(says(said, "/camera/color/image_raw"));
}

}  // namespace
}  // namespace softbody

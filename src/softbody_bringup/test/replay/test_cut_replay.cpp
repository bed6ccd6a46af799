#include <geometry_msgs/PoseStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/imgproc.hpp>

#include "replay/recordings.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_evaluation/ros/surface_reader.h"
#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/replay.h"
#include "softbody_sim/cutting/patch/cut_shapes.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

/// A knife goes through a sponge before a small virtual camera.
class CutReplay : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    // Up to when the blade is at its lowest, and a moment more.
    test::record("cut", folder_ / "cut.bag", 84);
  }

  /// The recording again, with the true pose of the knife on tf, as a robot sends it.
  static void addToolToTf(const std::string& frame) {
    const rosbag::Bag recording(folder_ / "cut.bag");
    rosbag::Bag with_tf(folder_ / "cut_tf.bag", rosbag::bagmode::Write);
    for (const rosbag::MessageInstance& message : rosbag::View(recording)) {
      with_tf.write(message.getTopic(), message.getTime(), message);
      const auto pose = message.getTopic() == "/ground_truth/tool/pose"
                            ? message.instantiate<geometry_msgs::PoseStamped>()
                            : nullptr;
      if (!pose) continue;
      tf2_msgs::TFMessage transforms;
      transforms.transforms.resize(1);
      transforms.transforms[0].header = pose->header;
      transforms.transforms[0].child_frame_id = frame;
      transforms.transforms[0].transform.rotation = pose->pose.orientation;
      transforms.transforms[0].transform.translation.x = pose->pose.position.x;
      transforms.transforms[0].transform.translation.y = pose->pose.position.y;
      transforms.transforms[0].transform.translation.z = pose->pose.position.z;
      with_tf.write("/tf", message.getTime(), transforms);
    }
  }

  static ReplaySummary run(const std::string& output, const std::string& tool, const std::string& journal,
                           const std::string& blade_frame = "") {
    ReplayOptions options;
    options.input = folder_ / (blade_frame.empty() ? "cut.bag" : "cut_tf.bag");
    options.blade_frame = blade_frame;
    options.objects = {CONFIG_DIR "/sponge.yaml"};
    options.output = folder_ / output;
    options.tool = tool;
    options.journal = journal.empty() ? "" : (folder_ / journal).string();
    return replay(
        options, [](const std::string& warning) { ADD_FAILURE() << warning; }, [](double) {});
  }

  static MeshTopology lastTopology(const std::string& result) {
    return evaluation::readSurface(folder_ / result, "/softbody/surface/topology", "/softbody/surface/state")
        .topologies.rbegin()
        ->second;
  }

  static inline const test::ScratchFolder folder_;
};

TEST_F(CutReplay, AToolCutsTheBodyInTwoAndItsJournalDoesItAgain) {
  const std::string knife = CONFIG_DIR "/knife.yaml";
  const ReplaySummary summary = run("first.bag", knife, "");
  const BodySummary& first = summary.bodies.front();
  EXPECT_EQ(first.pieces, 2u);
  EXPECT_GT(first.cuts, 1);
  EXPECT_GT(first.tools, 40);
  EXPECT_EQ(first.states, summary.read.frames);
  const MeshTopology by_blade = lastTopology("first.bag");
  EXPECT_EQ(by_blade.revision, static_cast<std::uint32_t>(first.cuts));
  EXPECT_TRUE(isClosed(by_blade.triangles));

  run("second.bag", knife, "");
  EXPECT_TRUE(readFile(folder_ / "first.bag") == readFile(folder_ / "second.bag"));

  const BodySummary again = run("again.bag", "", "first.bag").bodies.front();
  EXPECT_EQ(again.cuts, first.cuts);
  EXPECT_EQ(again.pieces, 2u);
  EXPECT_EQ(again.tools, 0);
  const MeshTopology by_journal = lastTopology("again.bag");
  EXPECT_EQ(by_journal.revision, by_blade.revision);
  EXPECT_EQ(by_journal.rest_vertices, by_blade.rest_vertices);
  EXPECT_EQ(by_journal.triangles, by_blade.triangles);
  EXPECT_EQ(by_journal.vertex_parents, by_blade.vertex_parents);
  EXPECT_EQ(by_journal.triangle_pieces, by_blade.triangle_pieces);
  EXPECT_EQ(by_journal.cut, by_blade.cut);
}

TEST_F(CutReplay, ABladeThatAFrameOfTfCarriesCuts) {
  addToolToTf("robot_tool");
  const std::string knife = CONFIG_DIR "/knife.yaml";
  const ReplaySummary summary = run("carried.bag", knife, "", "robot_tool");
  const BodySummary& carried = summary.bodies.front();
  EXPECT_EQ(carried.pieces, 2u);
  EXPECT_EQ(carried.tools, summary.read.frames) << carried.tool_missed;
  EXPECT_EQ(carried.tool_missed, "");
  EXPECT_TRUE(isClosed(lastTopology("carried.bag").triangles));
  EXPECT_EQ(run("nowhere.bag", knife, "", "unknown").bodies.front().tools, 0);
}

/// Frames of the virtual sponge at rest, and frames in which nothing is to be seen.
class CutPipeline : public ::testing::Test {
 protected:
  static virtual_camera::VirtualCamera makeStill() {
    virtual_camera::CameraSetup setup;
    setup.scene = "still";
    setup.config_folder = CONFIG_DIR;
    return virtual_camera::makeCamera(setup);
  }

  FrameOutput process(bool body_in_view, const std::vector<Cut>& cuts = {}) {
    const virtual_camera::Capture capture = camera_.capture(frame_, 0.0);
    const Nanoseconds stamp = 1'000'000'000 + 33'333'333 * static_cast<Nanoseconds>(frame_++);
    cv::Mat3b color(capture.color.size(), cv::Vec3b(90, 90, 90));
    cv::Mat1w depth_mm(color.size(), static_cast<std::uint16_t>(0));
    if (body_in_view) {
      cv::cvtColor(capture.color, color, cv::COLOR_RGB2BGR);
      depth_mm = capture.depth_mm;
    }
    return pipeline_.process(ingest_.process({color, depth_mm, Distortion{}, camera_.pinhole(), stamp}),
                             cuts);
  }

  static Cut middleCut(std::uint32_t revision) {
    const MeshTopology body = buildObjectModel(loadObjectDescription(CONFIG_DIR "/sponge.yaml")).visual;
    return {revision, 1, CutKind::kCut,
            planePatch({0.0123, 0.0, 0.0}, Eigen::Vector3d::UnitX(), body.rest_vertices)};
  }

  int frame_ = 0;
  virtual_camera::VirtualCamera camera_ = makeStill();
  CameraIngest ingest_{CameraIngestConfig()};
  Pipeline pipeline_{buildObjectModel(loadObjectDescription(CONFIG_DIR "/sponge.yaml")), PipelineConfig()};
};

TEST_F(CutPipeline, ACutBeforeTheBodyIsFoundIsMadeOnceItIs) {
  for (const bool with_cut : {true, false}) {
    const FrameOutput blind = process(false, with_cut ? std::vector<Cut>{middleCut(1)} : std::vector<Cut>{});
    ASSERT_FALSE(blind.tracking.has_targets);
    EXPECT_TRUE(blind.cuts.empty());
    EXPECT_EQ(pipeline_.waitingCuts(), 1u);
  }
  FrameOutput seen = process(true);
  for (int k = 0; k < 20 && !seen.tracking.has_targets; ++k) seen = process(true);
  ASSERT_TRUE(seen.tracking.has_targets) << seen.tracking.status.reason;
  EXPECT_EQ(seen.cuts.size(), 1u);
  EXPECT_TRUE(seen.warnings.empty()) << seen.warnings.front();
  EXPECT_EQ(pipeline_.waitingCuts(), 0u);
  EXPECT_EQ(pipeline_.surfaceTopology().revision, 1u);
}

TEST_F(CutPipeline, ACutThatCannotBeMadeIsAWarning) {
  EXPECT_TRUE(process(true).surface.has_value());
  Cut torn = middleCut(1);
  torn.patch.triangles.row(1) = torn.patch.triangles.row(0);
  const FrameOutput output = process(true, {torn, middleCut(7)});
  EXPECT_TRUE(output.cuts.empty());
  ASSERT_EQ(output.warnings.size(), 2u);
  EXPECT_TRUE(says(output.warnings[1], "revision 7"));
  EXPECT_TRUE(output.surface.has_value());
  EXPECT_EQ(process(true, {middleCut(1)}).cuts.size(), 1u);
}

/// Where features are bound, by their ids. Each gives two targets, for the two directions across its ray.
std::map<int, MaterialPoint> boundFeatures(const TrackingResult& tracking) {
  std::map<int, MaterialPoint> places;
  std::size_t next = 0;
  for (const Target& target : tracking.targets.targets) {
    if (target.kind == TargetKind::kFeature) places[tracking.features.at(next++ / 2).id] = target.place;
  }
  EXPECT_EQ(next, 2 * tracking.features.size());
  return places;
}

TEST_F(CutPipeline, FiveCutsTakenBackLeaveModelsAndBindingsAsTheyWereBitByBit) {
  std::map<int, MaterialPoint> before;
  for (int k = 0; k < 15; ++k) before.merge(boundFeatures(process(true).tracking));
  const TetTopology volume = pipeline_.volumeTopology();
  const MeshTopology surface = pipeline_.surfaceTopology();
  for (std::uint32_t k = 1; k <= 5; ++k) {
    const Eigen::Vector3d normal(std::cos(0.6 * k), std::sin(0.6 * k), 0.05 * k);
    const Cut cut{k, k, CutKind::kCut,
                  planePatch({0.0123 + 0.011 * k - 0.04, 0.003, 0.0}, normal, surface.rest_vertices)};
    ASSERT_EQ(process(true, {cut}).cuts.size(), 1u) << "cut " << k;
  }
  EXPECT_GT(pipeline_.volumeTopology().tets.rows(), volume.tets.rows());
  for (std::uint32_t k = 6; k <= 10; ++k)
    ASSERT_EQ(process(true, {{k, 5, CutKind::kUndo, {}}}).cuts.size(), 1u) << "undo " << k;
  const FrameOutput output = process(true);

  EXPECT_EQ(pipeline_.volumeTopology().rest_vertices, volume.rest_vertices);
  EXPECT_EQ(pipeline_.volumeTopology().tets, volume.tets);
  EXPECT_EQ(pipeline_.volumeTopology().surface, volume.surface);
  EXPECT_EQ(pipeline_.volumeTopology().tet_pieces, volume.tet_pieces);
  EXPECT_EQ(pipeline_.surfaceTopology().rest_vertices, surface.rest_vertices);
  EXPECT_EQ(pipeline_.surfaceTopology().triangles, surface.triangles);
  EXPECT_EQ(pipeline_.surfaceTopology().vertex_parents, surface.vertex_parents);
  EXPECT_EQ(pipeline_.surfaceTopology().triangle_pieces, surface.triangle_pieces);
  EXPECT_EQ(pipeline_.surfaceTopology().cut, surface.cut);
  EXPECT_EQ(output.tracking.targets.revision, 10u);
  int again = 0;
  for (const auto& [id, place] : boundFeatures(output.tracking)) {
    const auto known = before.find(id);
    if (known == before.end()) continue;
    ++again;
    EXPECT_EQ(place.tet, known->second.tet) << "feature " << id;
    EXPECT_EQ(place.barycentric, known->second.barycentric) << "feature " << id;
  }
  EXPECT_GT(again, 100);
}

}  // namespace
}  // namespace softbody

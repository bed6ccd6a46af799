#include "softbody_virtual_camera/ros/bag_writer.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <softbody_msgs/Cut.h>
#include <softbody_msgs/Forces.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core/utility.hpp>
#include <sstream>

#include "softbody_common/images/pixel_labels.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

namespace softbody::virtual_camera {
namespace {

std::string write(const std::string& name, std::uint64_t seed, const NoiseOptions& noise = {},
                  bool labels = false) {
  CameraSetup setup;
  setup.body = std::string(CONFIG_DIR) + "/sponge.obj";
  setup.seed = seed;
  setup.width = 80;
  setup.height = 60;
  setup.noise = noise;
  VirtualCamera camera = makeCamera(setup);
  const std::string path = testing::TempDir() + name;
  writeBag(&camera, {path, 35, 30.0, labels}, [](int) {});
  return path;
}

std::string bytes(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

TEST(BagWriter, SameSeedSameBytesOtherSeedOtherBytes) {
  const std::string first = bytes(write("first.bag", 4));
  EXPECT_TRUE(first == bytes(write("second.bag", 4)));
  EXPECT_FALSE(first == bytes(write("third.bag", 5)));
  EXPECT_FALSE(first == bytes(write("clean.bag", 4, noNoise())));
}

TEST(BagWriter, TheDollsBytesDoNotDependOnTheNumberOfThreads) {
  const int threads = cv::getNumThreads();
  const auto recorded = [](const std::string& name, int number) {
    cv::setNumThreads(number);
    CameraSetup setup;
    setup.scene = "doll_shake";
    setup.config_folder = CONFIG_DIR;
    setup.width = 160;
    setup.height = 120;
    VirtualCamera camera = makeCamera(setup);
    const std::string path = testing::TempDir() + name;
    writeBag(&camera, {path, 6, 5.0}, [](int) {});
    return bytes(path);
  };
  const std::string one = recorded("one.bag", 1);
  EXPECT_TRUE(one == recorded("three.bag", 3));
  cv::setNumThreads(threads);
}

TEST(BagWriter, HoldsTheContractsTopicsWithOneStampAFrame) {
  rosbag::Bag bag(write("topics.bag", 1));
  std::map<std::string, int> count;
  std::map<ros::Time, int> stamps;
  for (const rosbag::MessageInstance& m : rosbag::View(bag)) {
    ++count[m.getTopic()];
    if (const auto image = m.instantiate<sensor_msgs::Image>()) {
      EXPECT_EQ(image->header.stamp, m.getTime());
      EXPECT_EQ(image->header.frame_id, "camera_color_optical_frame");
      EXPECT_EQ(image->encoding, m.getTopic() == "/camera/color/image_raw" ? "rgb8" : "16UC1");
      ++stamps[image->header.stamp];
    }
    if (const auto state = m.instantiate<softbody_msgs::MeshState>()) ++stamps[state->header.stamp];
  }
  for (const char* topic :
       {"/camera/color/image_raw", "/camera/color/camera_info", "/camera/aligned_depth_to_color/image_raw",
        "/camera/aligned_depth_to_color/camera_info", "/ground_truth/surface/state",
        "/ground_truth/camera_pose", "/tf"}) {
    EXPECT_EQ(count[topic], 35) << topic;
  }
  EXPECT_EQ(count["/ground_truth/surface/topology"], 2);
  EXPECT_EQ(count["/tf_static"], 2);
  EXPECT_EQ(stamps.size(), 35u);
  for (const auto& [stamp, images] : stamps) EXPECT_EQ(images, 3);
}

TEST(BagWriter, TheCamerasPoseIsTheInverseOfTheBodysPose) {
  rosbag::Bag bag(write("camera.bag", 1));
  std::map<ros::Time, Eigen::Vector3d> body, camera;
  for (const rosbag::MessageInstance& m : rosbag::View(bag)) {
    if (const auto pose = m.instantiate<geometry_msgs::PoseStamped>()) {
      EXPECT_EQ(pose->header.frame_id, "ground_truth_softbody");
      const auto& [p, q] = std::pair(pose->pose.position, pose->pose.orientation);
      // Where the body's origin is in the camera's frame.
      camera[pose->header.stamp] =
          Eigen::Quaterniond(q.w, q.x, q.y, q.z).conjugate() * -Eigen::Vector3d(p.x, p.y, p.z);
    }
    const auto transforms = m.getTopic() == "/tf" ? m.instantiate<tf2_msgs::TFMessage>() : nullptr;
    if (!transforms) continue;
    const auto& transform = transforms->transforms.at(0);
    const auto& p = transform.transform.translation;
    body[transform.header.stamp] = {p.x, p.y, p.z};
  }
  ASSERT_EQ(camera.size(), 35u);
  for (const auto& [stamp, place] : body) EXPECT_TRUE(camera.at(stamp).isApprox(place, 1e-9));
}

TEST(BagWriter, WritesLabelsWhenAskedWithTheStampOfTheImages) {
  const auto labelsIn = [](const rosbag::Bag& bag) {
    std::vector<sensor_msgs::ImageConstPtr> images;
    for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery("/ground_truth/labels")))
      images.push_back(m.instantiate<sensor_msgs::Image>());
    return images;
  };
  EXPECT_TRUE(labelsIn(rosbag::Bag(write("plain.bag", 1))).empty());
  rosbag::Bag bag(write("labels.bag", 1, {}, true));
  std::vector<ros::Time> stamps;
  for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery("/camera/color/image_raw")))
    stamps.push_back(m.getTime());
  const auto images = labelsIn(bag);
  ASSERT_EQ(images.size(), stamps.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(images[i]->header.stamp, stamps[i]);
    EXPECT_EQ(images[i]->header.frame_id, "camera_color_optical_frame");
    EXPECT_EQ(images[i]->encoding, "mono8");
    EXPECT_EQ(std::count(images[i]->data.begin(), images[i]->data.end(), labels::kBody) > 100, true);
  }
}

TEST(BagWriter, WritesTheForcesThatASceneKnows) {
  CameraSetup setup;
  setup.scene = "stamp";
  setup.config_folder = CONFIG_DIR;
  setup.width = 80;
  setup.height = 60;
  VirtualCamera camera = makeCamera(setup);
  const std::string path = testing::TempDir() + "forces.bag";
  writeBag(&camera, {path, 3, 0.4}, [](int) {});  // at 0, 2.5 and 5 s
  rosbag::Bag bag(path);
  std::vector<softbody_msgs::ForcesConstPtr> found;
  for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery("/ground_truth/forces")))
    found.push_back(m.instantiate<softbody_msgs::Forces>());
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0]->patches.empty());
  EXPECT_TRUE(found[2]->patches.empty());
  ASSERT_EQ(found[1]->patches.size(), 2u);
  EXPECT_TRUE(found[1]->in_newtons);
  EXPECT_EQ(found[1]->header.frame_id, "camera_color_optical_frame");
  EXPECT_EQ(found[1]->patches[0].name, "stamp");
  EXPECT_EQ(found[1]->patches[1].name, "table");
  EXPECT_GT(found[1]->patches[0].force.y, 3.0);  // down
  EXPECT_NEAR(found[1]->wrench.force.y, 0.0, 1e-4);
  rosbag::Bag other(write("no_forces.bag", 1));
  EXPECT_EQ(rosbag::View(other, rosbag::TopicQuery("/ground_truth/forces")).size(), 0u);
}

TEST(BagWriter, WritesWhatASensorAtTheClampSaysAndTheTruthAboutIt) {
  CameraSetup setup;
  setup.scene = "sag";
  setup.config_folder = CONFIG_DIR;
  setup.width = 80;
  setup.height = 60;
  setup.density_kg_m3 = 80.0;
  setup.noise.wrench.bias_n = {0.0, 1.0, 0.0};
  VirtualCamera camera = makeCamera(setup);
  const std::string path = testing::TempDir() + "wrench.bag";
  writeBag(&camera, {path, 3, 0.5}, [](int) {});  // at 0, 2 and 4 s
  rosbag::Bag bag(path);
  std::vector<geometry_msgs::WrenchStampedConstPtr> sensed, truth;
  for (const rosbag::MessageInstance& m : rosbag::View(bag)) {
    if (m.getTopic() == "/wrench/clamp") sensed.push_back(m.instantiate<geometry_msgs::WrenchStamped>());
    if (m.getTopic() == "/ground_truth/wrench/clamp")
      truth.push_back(m.instantiate<geometry_msgs::WrenchStamped>());
    if (m.getTopic() == "/ground_truth/material") {
      EXPECT_NE(m.instantiate<std_msgs::String>()->data.find("density_kg_m3: 80\n"), std::string::npos);
    }
  }
  ASSERT_EQ(truth.size(), 3u);
  ASSERT_EQ(sensed.size(), 3u);
  EXPECT_EQ(truth[2]->header.frame_id, "clamp");
  EXPECT_NEAR(truth[2]->wrench.force.z, -9.81 * 80.0 * 8e-4, 1e-4);
  EXPECT_NEAR(sensed[2]->wrench.force.y - truth[2]->wrench.force.y, 1.0, 0.25);
  EXPECT_NE(sensed[1]->wrench.force.z, truth[1]->wrench.force.z);
  // The world is known, because the body has weight: z of the clamp is up.
  std::map<std::string, std::string> parents;
  for (const rosbag::MessageInstance& m :
       rosbag::View(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "/tf_static"}))) {
    const auto message = m.instantiate<tf2_msgs::TFMessage>();
    for (const auto& transform : message->transforms)
      parents[transform.child_frame_id] = transform.header.frame_id;
  }
  EXPECT_EQ(parents["camera_link"], "world");
  EXPECT_EQ(parents["clamp"], "camera_color_optical_frame");
}

TEST(BagWriter, WritesWideImagesAtSixtyHertz) {
  CameraSetup setup;
  setup.scene = "shake";
  setup.config_folder = CONFIG_DIR;
  setup.width = 848;
  setup.rate_hz = 60.0;
  VirtualCamera camera = makeCamera(setup);
  const std::string path = testing::TempDir() + "wide.bag";
  writeBag(&camera, {path, 4, 60.0}, [](int) {});
  rosbag::Bag bag(path);
  ros::Time last;
  for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery("/camera/color/image_raw"))) {
    const auto image = m.instantiate<sensor_msgs::Image>();
    EXPECT_EQ(image->width, 848u);
    EXPECT_EQ(image->height, 480u);
    if (!last.isZero()) {
      EXPECT_NEAR((m.getTime() - last).toSec(), 1.0 / 60.0, 1e-8);
    }
    last = m.getTime();
  }
  EXPECT_EQ(camera.pinhole().cx, 424.0);
}

TEST(BagWriter, TheTruthsTopologyHasTheStampOfTheFirstStateOfItsRevision) {
  CameraSetup setup;
  setup.scene = "cut";
  setup.config_folder = CONFIG_DIR;
  setup.width = 80;
  setup.height = 60;
  VirtualCamera camera = makeCamera(setup);
  const std::string path = testing::TempDir() + "cut.bag";
  writeBag(&camera, {path, 30, 10.0}, [](int) {});
  rosbag::Bag bag(path);
  std::map<std::uint32_t, std::size_t> vertices;
  std::map<std::uint32_t, ros::Time> topology_stamps, state_stamps;  // the earliest
  std::map<std::uint32_t, ros::Time> cut_stamps;
  for (const rosbag::MessageInstance& m : rosbag::View(bag)) {
    if (const auto cut = m.instantiate<softbody_msgs::Cut>()) {
      EXPECT_EQ(cut->kind, softbody_msgs::Cut::CUT);
      EXPECT_EQ(cut->patch_vertices.size(), 4u);
      EXPECT_TRUE(cut_stamps.emplace(cut->revision, m.getTime()).second);
    }
    if (const auto topology = m.instantiate<softbody_msgs::MeshTopology>()) {
      vertices[topology->revision] = topology->rest_vertices.size();
      topology_stamps.emplace(topology->revision, m.getTime());
    }
  }
  for (const rosbag::MessageInstance& m : rosbag::View(bag)) {
    if (const auto state = m.instantiate<softbody_msgs::MeshState>()) {
      EXPECT_EQ(state->vertices.size(), vertices[state->revision]);
      state_stamps.emplace(state->revision, m.getTime());
    }
  }
  EXPECT_EQ(vertices.size(), 2u);
  EXPECT_EQ(topology_stamps, state_stamps);
  EXPECT_EQ(cut_stamps, (std::map<std::uint32_t, ros::Time>{{1, state_stamps[1]}}));
  EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery("/ground_truth/tool/pose")).size(), 30u);
}

TEST(BagWriter, TheTruthIsTheMeshFileVertexByVertex) {
  rosbag::Bag bag(write("truth.bag", 1));
  rosbag::View view(bag, rosbag::TopicQuery("/ground_truth/surface/topology"));
  const MeshTopology topology = fromMessage(*view.begin()->instantiate<softbody_msgs::MeshTopology>());
  std::ifstream file(std::string(CONFIG_DIR) + "/sponge.obj");
  Eigen::Index i = 0;
  for (std::string line; std::getline(file, line);) {
    Eigen::RowVector3d p;
    if (line.rfind("v ", 0) != 0) continue;
    std::istringstream(line.substr(2)) >> p.x() >> p.y() >> p.z();
    EXPECT_LT((topology.rest_vertices.row(i) - p).norm(), 1e-7);
    EXPECT_EQ(topology.vertex_parents[static_cast<std::size_t>(i)], i);
    ++i;
  }
  EXPECT_EQ(i, 522);
  EXPECT_EQ(topology.triangles.rows(), 1040);
}

TEST(BagWriter, LeavesAnEarlierFileAloneOnFailure) {
  const std::string path = write("kept.bag", 1), before = bytes(path);
  CameraSetup setup;
  setup.body = std::string(CONFIG_DIR) + "/sponge.obj";
  setup.width = 80;
  setup.height = 60;
  VirtualCamera camera = makeCamera(setup);
  const auto interrupt = [](int frame) {
    if (frame == 3) throw std::runtime_error("stop");
  };
  EXPECT_THROW(writeBag(&camera, {path, 10, 30.0}, interrupt), std::runtime_error);
  EXPECT_TRUE(bytes(path) == before);
}

}  // namespace
}  // namespace softbody::virtual_camera

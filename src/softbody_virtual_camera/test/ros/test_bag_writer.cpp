#include "softbody_virtual_camera/ros/bag_writer.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <softbody_msgs/Cut.h>
#include <softbody_msgs/Forces.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <std_msgs/String.h>
#include <test_support/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core/utility.hpp>
#include <sstream>

#include "softbody_common/files/input_file.h"
#include "softbody_common/images/pixel_labels.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

namespace softbody::virtual_camera {
namespace {

/// A small camera. @param scene empty: the usual one.
CameraSetup smallCamera(const std::string& scene = "", int width = 80, int height = 60) {
  CameraSetup setup;
  setup.config_folder = CONFIG_DIR;
  if (!scene.empty()) setup.scene = scene;
  setup.width = width;
  setup.height = height;
  return setup;
}

/// Writes a bag. @return its path.
std::string write(const std::string& name, const CameraSetup& setup, BagOptions options) {
  options.path = testing::TempDir() + name;
  VirtualCamera camera = makeCamera(setup);
  writeBag(&camera, options, [](int) {});
  return options.path;
}

std::string write(const std::string& name, std::uint64_t seed, const NoiseOptions& noise = {},
                  bool labels = false) {
  CameraSetup setup = smallCamera();
  setup.body = std::string(CONFIG_DIR) + "/sponge.obj";
  setup.seed = seed;
  setup.noise = noise;
  return write(name, setup, {"", 35, 30.0, labels});
}

template <typename Message>
std::vector<boost::shared_ptr<const Message>> messagesOf(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<boost::shared_ptr<const Message>> messages;
  for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery(topic)))
    messages.push_back(m.instantiate<Message>());
  return messages;
}

TEST(BagWriter, SameSeedSameBytesOtherSeedOtherBytes) {
  const std::string first = readFile(write("first.bag", 4));
  EXPECT_TRUE(first == readFile(write("second.bag", 4)));
  EXPECT_FALSE(first == readFile(write("third.bag", 5)));
  EXPECT_FALSE(first == readFile(write("clean.bag", 4, noNoise())));
}

TEST(BagWriter, TheDollsBytesDoNotDependOnTheNumberOfThreads) {
  const int threads = cv::getNumThreads();
  const auto recorded = [](const std::string& name, int number) {
    cv::setNumThreads(number);
    return readFile(write(name, smallCamera("doll_shake", 160, 120), {"", 6, 5.0}));
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
  const std::string topic = "/ground_truth/labels";
  EXPECT_TRUE(messagesOf<sensor_msgs::Image>(rosbag::Bag(write("plain.bag", 1)), topic).empty());
  const rosbag::Bag bag(write("labels.bag", 1, {}, true));
  const auto images = messagesOf<sensor_msgs::Image>(bag, topic),
             colors = messagesOf<sensor_msgs::Image>(bag, "/camera/color/image_raw");
  ASSERT_EQ(images.size(), colors.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(images[i]->header.stamp, colors[i]->header.stamp);
    EXPECT_EQ(images[i]->header.frame_id, "camera_color_optical_frame");
    EXPECT_EQ(images[i]->encoding, "mono8");
    EXPECT_EQ(std::count(images[i]->data.begin(), images[i]->data.end(), labels::kBody) > 100, true);
  }
}

TEST(BagWriter, WritesTheForcesThatASceneKnows) {
  const rosbag::Bag bag(write("forces.bag", smallCamera("stamp"), {"", 3, 0.4}));  // at 0, 2.5 and 5 s
  const auto found = messagesOf<softbody_msgs::Forces>(bag, "/ground_truth/forces");
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
  const rosbag::Bag other(write("no_forces.bag", 1));
  EXPECT_TRUE(messagesOf<softbody_msgs::Forces>(other, "/ground_truth/forces").empty());
}

TEST(BagWriter, WritesWhatASensorAtTheClampSaysAndTheTruthAboutIt) {
  CameraSetup setup = smallCamera("sag");
  setup.density_kg_m3 = 80.0;
  setup.noise.wrench.bias_n = {0.0, 1.0, 0.0};
  const rosbag::Bag bag(write("wrench.bag", setup, {"", 3, 0.5}));  // at 0, 2 and 4 s
  const auto sensed = messagesOf<geometry_msgs::WrenchStamped>(bag, "/wrench/clamp"),
             truth = messagesOf<geometry_msgs::WrenchStamped>(bag, "/ground_truth/wrench/clamp");
  const auto material = messagesOf<std_msgs::String>(bag, "/ground_truth/material");
  ASSERT_FALSE(material.empty());
  EXPECT_TRUE(says(material.front()->data, "density_kg_m3: 80\n"));
  ASSERT_EQ(truth.size(), 3u);
  ASSERT_EQ(sensed.size(), 3u);
  EXPECT_EQ(truth[2]->header.frame_id, "clamp");
  EXPECT_NEAR(truth[2]->wrench.force.z, -9.81 * 80.0 * 8e-4, 1e-4);
  EXPECT_NEAR(sensed[2]->wrench.force.y - truth[2]->wrench.force.y, 1.0, 0.25);
  EXPECT_NE(sensed[1]->wrench.force.z, truth[1]->wrench.force.z);
  // The world is known, because the body has weight: z of the clamp is up.
  std::map<std::string, std::string> parents;
  for (const char* topic : {"/tf_static", "/tf"}) {
    for (const auto& message : messagesOf<tf2_msgs::TFMessage>(bag, topic)) {
      for (const auto& transform : message->transforms)
        parents[transform.child_frame_id] = transform.header.frame_id;
    }
  }
  EXPECT_EQ(parents["camera_link"], "world");
  EXPECT_EQ(parents["clamp"], "camera_color_optical_frame");
}

TEST(BagWriter, WritesWideImagesAtSixtyHertz) {
  CameraSetup setup = smallCamera("shake", 848, 480);
  setup.rate_hz = 60.0;
  const rosbag::Bag bag(write("wide.bag", setup, {"", 4, 60.0}));
  ros::Time last;
  for (const auto& image : messagesOf<sensor_msgs::Image>(bag, "/camera/color/image_raw")) {
    EXPECT_EQ(image->width, 848u);
    EXPECT_EQ(image->height, 480u);
    if (!last.isZero()) {
      EXPECT_NEAR((image->header.stamp - last).toSec(), 1.0 / 60.0, 1e-8);
    }
    last = image->header.stamp;
  }
  EXPECT_EQ(makeCamera(setup).pinhole().cx, 424.0);
}

TEST(BagWriter, TheTruthsTopologyHasTheStampOfTheFirstStateOfItsRevision) {
  const rosbag::Bag bag(write("cut.bag", smallCamera("cut"), {"", 30, 10.0}));
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
  const MeshTopology topology =
      fromMessage(*messagesOf<softbody_msgs::MeshTopology>(bag, "/ground_truth/surface/topology").front());
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
  const std::string path = write("kept.bag", 1), before = readFile(path);
  VirtualCamera camera = makeCamera(smallCamera());
  const auto interrupt = [](int frame) {
    if (frame == 3) throw std::runtime_error("stop");
  };
  EXPECT_THROW(writeBag(&camera, {path, 10, 30.0}, interrupt), std::runtime_error);
  EXPECT_TRUE(readFile(path) == before);
}

}  // namespace
}  // namespace softbody::virtual_camera

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "softbody_virtual_camera/camera/camera_setup.h"
#include "softbody_virtual_camera/ros/bag_writer.h"

namespace softbody {
namespace {

/// Four frames of the sponge in a small image, with truth.
std::string recordSponge() {
  virtual_camera::CameraSetup setup;
  setup.body = std::string(CONFIG_DIR) + "/sponge.obj";
  setup.width = 160;
  setup.height = 120;
  virtual_camera::VirtualCamera camera = makeCamera(setup);
  const std::string path = testing::TempDir() + "drawn_recording.bag";
  writeBag(&camera, {path, 4, 4.0}, [](int) {});
  return path;
}

/// The true surface of a recording as if it were a result, in another frame than the images.
std::string resultInWorldFrame(const std::string& recording) {
  const std::string path = testing::TempDir() + "drawn.bag";
  const rosbag::Bag in(recording);
  rosbag::Bag out(path, rosbag::bagmode::Write);
  rosbag::View view(in, rosbag::TopicQuery(std::vector<std::string>{"/ground_truth/surface/topology",
                                                                    "/ground_truth/surface/state"}));
  for (const rosbag::MessageInstance& m : view) {
    if (const auto topology = m.instantiate<softbody_msgs::MeshTopology>())
      out.write("/softbody/surface/topology", m.getTime(), topology);
    if (const auto state = m.instantiate<softbody_msgs::MeshState>()) {
      state->header.frame_id = "world";
      out.write("/softbody/surface/state", m.getTime(), state);
    }
  }
  return path;
}

TEST(DrawCut, AResultInAnotherFrameThanTheImagesIsRefused) {
  const std::string recording = recordSponge(), result = resultInWorldFrame(recording);
  const std::string picture = testing::TempDir() + "refused.png", words = testing::TempDir() + "refused.txt";
  const int status = std::system(fmt::format("'{}' '{}' --recording '{}' --output '{}' 2> '{}'", DRAW_CUT,
                                             result, recording, picture, words)
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  std::stringstream said;
  said << std::ifstream(words).rdbuf();
  EXPECT_NE(said.str().find("the surface is in frame 'world'"), std::string::npos) << said.str();
  EXPECT_FALSE(std::filesystem::exists(picture));
}

}  // namespace
}  // namespace softbody

#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <set>
#include <sstream>

#include "ros/bags/camera_bag.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/image_folder/image_folder.h"

namespace fs = std::filesystem;

namespace softbody {
namespace {

/// A folder that goes away with the test.
class ImageFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(directory_ / "color");
    fs::create_directories(directory_ / "depth");
    directory_.write("camera.yaml", "image_width: 8\nimage_height: 6\nK: [10, 0, 4, 0, 11, 3, 0, 0, 1]\n");
  }

  cv::Mat3b addColor(const std::string& name) {
    cv::Mat3b image(6, 8);
    cv::randu(image, 0, 255);
    cv::imwrite((directory_ / name).string(), image);
    return image;
  }
  cv::Mat1w addDepth(const std::string& name) {
    cv::Mat1w image(6, 8);
    cv::randu(image, 0, 9000);
    cv::imwrite((directory_ / name).string(), image);
    return image;
  }
  /// The sentence that reading the folder fails with.
  std::string failure(const fs::path& camera = {}) {
    return complaint<std::runtime_error>([&] { readImageFolder(directory_, camera, 30.0); });
  }

  const test::ScratchFolder directory_;
};

TEST_F(ImageFolderTest, StampsComeFromTheNumbersSoThatMissingFilesAreDroppedFrames) {
  for (const char* number : {"0", "3", "10"}) addColor(std::string("color/frame-") + number + ".color.png");
  for (const char* number : {"00", "02", "10"}) addDepth(std::string("depth/") + number + ".png");
  const ImageFolder folder = readImageFolder(directory_, "", 25.0);
  ASSERT_EQ(folder.color.size(), 3u);
  ASSERT_EQ(folder.depth.size(), 3u);
  EXPECT_EQ(folder.color[1].stamp, kFolderStart + 3 * 40'000'000LL);
  EXPECT_EQ(folder.color[2].stamp, kFolderStart + 10 * 40'000'000LL);
  EXPECT_EQ(folder.depth[2].stamp, folder.color[2].stamp);
  EXPECT_EQ(folder.warnings.size(), 2u);
}

TEST_F(ImageFolderTest, PixelsSurviveReadingInEveryDepthUnit) {
  const cv::Mat3b color = addColor("color/1.png");
  const cv::Mat1w depth = addDepth("depth/1.png");
  const ImageFolder folder = readImageFolder(directory_, "", 30.0);
  EXPECT_EQ(cv::norm(readColor(folder.color[0].path, folder.camera.camera), color, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(readDepth(folder.depth[0].path, folder.camera), depth, cv::NORM_INF), 0.0);
  FolderCamera fine = folder.camera;
  fine.depth_units_per_m = 5000.0;
  cv::Mat1f metres;
  depth.convertTo(metres, CV_32F, 1.0 / 5000.0);
  EXPECT_LT(cv::norm(readDepth(folder.depth[0].path, fine), metres, cv::NORM_INF), 1e-6);
}

TEST_F(ImageFolderTest, FailuresNameTheFile) {
  EXPECT_TRUE(says(failure(), "color: the folder has no image"));
  addColor("color/1.png");
  addDepth("depth/1.png");
  EXPECT_EQ(failure(), "");
  EXPECT_TRUE(says(failure(directory_ / "other.yaml"), "other.yaml"));
  addColor("color/01.png");
  EXPECT_TRUE(says(failure(), "01.png"));
  fs::remove(directory_ / "color/01.png");
  addColor("color/last.png");
  EXPECT_TRUE(says(failure(), "last.png"));
  fs::remove_all(directory_ / "color");
  EXPECT_TRUE(says(failure(), "color/"));
}

TEST_F(ImageFolderTest, ImagesOfWrongSizeOrTypeAreRefused) {
  const Pinhole camera{8, 6, 10.0, 10.0, 4.0, 3.0};
  FolderCamera folder;
  folder.camera = camera;
  addColor("color/1.png");
  addDepth("depth/1.png");
  directory_.write("color/broken.png", "not an image");
  EXPECT_THROW(readColor(directory_ / "depth/1.png", camera), std::runtime_error);
  EXPECT_THROW(readDepth(directory_ / "color/1.png", folder), std::runtime_error);
  EXPECT_THROW(readColor(directory_ / "color/broken.png", camera), std::runtime_error);
  EXPECT_THROW(readColor(directory_ / "color/absent.png", camera), std::runtime_error);
  EXPECT_THROW(readColor(directory_ / "color/1.png", Pinhole{9, 6, 10.0, 10.0, 4.0, 3.0}),
               std::runtime_error);
}

TEST_F(ImageFolderTest, CameraFilesAreChecked) {
  const auto refused = [this](const std::string& text) {
    directory_.write("camera.yaml", text);
    EXPECT_THROW(readFolderCamera(directory_ / "camera.yaml"), std::runtime_error) << text;
  };
  const std::string size = "image_width: 8\nimage_height: 6\n", K = "K: [10, 0, 4, 0, 11, 3, 0, 0, 1]\n";
  refused("");
  refused("[");
  refused(size);
  refused(K);
  refused(size + "K: [1, 2]\n");
  refused(size + "K: [0, 0, 4, 0, 11, 3, 0, 0, 1]\n");
  refused(size + "K: [.nan, 0, 4, 0, 11, 3, 0, 0, 1]\n");
  refused("image_width: -8\nimage_height: 6\n" + K);
  refused(size + K + "depth: {unit: inch}\n");
  refused(size + K + "depth: {scale: 0}\n");
  directory_.write("camera.yaml", size + K + "D: [1, 2, 3, 4, 5, 6, 7, 8]\ndepth: {unit: m}\n");
  const FolderCamera camera = readFolderCamera(directory_ / "camera.yaml");
  EXPECT_EQ(camera.camera, (Pinhole{8, 6, 10.0, 11.0, 4.0, 3.0}));
  EXPECT_EQ(camera.distortion_model, "rational_polynomial");
  EXPECT_EQ(camera.depth_units_per_m, 1.0);
}

TEST_F(ImageFolderTest, TumPairsAreOneToOneWithinTheTolerance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.03, 0.03);
  std::ostringstream color, depth;
  color << std::fixed << "# color images\n";
  depth << std::fixed << "# depth maps\n";
  for (int k = 0; k < 200; ++k) {
    color << 1305031102.175304 + k / 30.0 << " rgb/" << k << ".png\n";
    depth << 1305031102.175304 + k / 30.0 + jitter(random) << " depth/" << k << ".png\n";
  }
  directory_.write("rgb.txt", color.str());
  directory_.write("depth.txt", depth.str());
  const ImageFolder folder = readImageFolder(directory_, "", 30.0);
  ASSERT_EQ(folder.color.size(), folder.depth.size());
  EXPECT_GT(folder.color.size(), 100u);
  EXPECT_EQ(folder.camera.camera.width, 8);
  EXPECT_EQ(folder.camera.depth_units_per_m, 5000.0);
  std::set<fs::path> used;
  for (std::size_t i = 0; i < folder.color.size(); ++i) {
    EXPECT_EQ(folder.color[i].stamp, folder.depth[i].stamp);
    EXPECT_TRUE(used.insert(folder.depth[i].path).second);
    EXPECT_TRUE(i == 0 || folder.color[i].stamp > folder.color[i - 1].stamp);
  }
  fs::remove(directory_ / "camera.yaml");
  EXPECT_TRUE(says(readImageFolder(directory_, "", 30.0).warnings.back(), "517.3"));
  directory_.write("rgb.txt", "1305031102.175304\n");
  EXPECT_TRUE(says(failure(), "rgb.txt, line 1"));
}

TEST_F(ImageFolderTest, TheSameImagesGiveTheSameBag) {
  const cv::Mat3b color = addColor("color/1.png");
  const cv::Mat1w depth = addDepth("depth/1.png");
  const auto write_bag = [&](const fs::path& file) {
    CameraBag bag(file, toMessage(Pinhole{8, 6, 10.0, 10.0, 4.0, 3.0}));
    bag.writeOpticalFrame(kFolderStart);
    bag.writeColor(kFolderStart, color);
    bag.writeDepth(kFolderStart, depth);
    bag.finish();
  };
  write_bag(directory_ / "a.bag");
  write_bag(directory_ / "b.bag");
  EXPECT_EQ(readFile(directory_ / "a.bag"), readFile(directory_ / "b.bag"));

  rosbag::Bag bag((directory_ / "a.bag").string());
  rosbag::View view(bag, rosbag::TopicQuery("/camera/aligned_depth_to_color/image_raw"));
  ASSERT_EQ(view.size(), 1u);
  const auto image = view.begin()->instantiate<sensor_msgs::Image>();
  EXPECT_EQ(image->encoding, "16UC1");
  EXPECT_EQ(image->header.frame_id, "camera_color_optical_frame");
  EXPECT_EQ(std::memcmp(image->data.data(), depth.data, image->data.size()), 0);
}

TEST_F(ImageFolderTest, AnUnfinishedBagLeavesTheEarlierFile) {
  directory_.write("out.bag", "earlier");
  {
    CameraBag bag(directory_ / "out.bag", sensor_msgs::CameraInfo());
    bag.writeOpticalFrame(kFolderStart);
  }
  EXPECT_EQ(readFile(directory_ / "out.bag"), "earlier");
  const auto is_part = [](const auto& entry) {
    return entry.path().string().find(".part") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(fs::directory_iterator(directory_), fs::directory_iterator(), is_part), 0);
}

TEST_F(ImageFolderTest, ImagesOutsideOfTheFolderNeedAllowance) {
  const fs::path other = fs::path(directory_).string() + "_other";
  fs::create_directories(other);
  cv::imwrite((other / "0.png").string(), cv::Mat3b(6, 8));
  cv::imwrite((other / "d.png").string(), cv::Mat1w(6, 8));
  const std::string camera = "image_width: 8\nimage_height: 6\nK: [10, 0, 4, 0, 11, 3, 0, 0, 1]\n";
  directory_.write("camera.yaml", camera);
  directory_.write("rgb.txt", "1.0 ../" + other.filename().string() + "/0.png\n");
  directory_.write("depth.txt", "1.0 " + (other / "d.png").string() + "\n");
  EXPECT_TRUE(says(complaint<std::runtime_error>([&] { readImageFolder(directory_, "", 30.0); }),
                   "0.png is outside of the folder"));
  EXPECT_EQ(readImageFolder(directory_, "", 30.0, FileScope::kAnywhere).color.size(), 1u);
  fs::remove(directory_ / "rgb.txt");
  fs::remove_all(directory_ / "color");
  fs::create_directory_symlink(other, directory_ / "color");
  EXPECT_THROW(readImageFolder(directory_, "", 30.0), std::runtime_error);
  fs::remove_all(other);
}

}  // namespace
}  // namespace softbody

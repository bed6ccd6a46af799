#include <fmt/format.h>
#include <sensor_msgs/CompressedImage.h>
#include <test_support/gtest.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "fixtures/validation_bag.h"
#include "validation/intrinsics_checks.h"

namespace softbody::validation {
namespace {

TEST(ValidateBag, AGoodBagHasNoFinding) {
  const RecordingFacts recording = facts(writeBag(nothing));
  EXPECT_TRUE(check(recording).empty()) << toText(recording, check(recording));
  EXPECT_TRUE(says(toText(recording, {}), "usable, 0 errors, 0 warnings, 60 colour and 60 depth images"));
  EXPECT_EQ(toJson(recording, {})["usable"], true);
}

TEST(ValidateBag, AMissingTopicIsNamedWithWhatThereIs) {
  expectOne(writeBag(nothing, [](std::string t) { return t == kColorInfo ? "" : t; }), Severity::kError,
            "topics", kColorInfo,
            "is not in the bag (expected sensor_msgs/CameraInfo); of that type the bag has " + kDepthInfo);
  expectOne(writeBag(nothing, [](std::string t) { return t == kDepth ? "/kinect" + t : t; }),
            Severity::kError, "topics", kDepth, "/kinect" + kDepth);
  const std::string registered = writeBag(nothing, [](std::string t) { return t == kDepthInfo ? "" : t; });
  EXPECT_TRUE(check(facts(registered)).empty()) << "registered depth needs no camera_info";
}

/// As image_transport's plugins record them.
sensor_msgs::CompressedImage compressedCopy(const sensor_msgs::Image& image, int type, const char* format,
                                            std::size_t header) {
  const cv::Mat pixels(kHeight, kWidth, type, const_cast<std::uint8_t*>(image.data.data()));
  sensor_msgs::CompressedImage compressed;
  compressed.header = image.header;
  compressed.format = format;
  cv::imencode(".png", pixels, compressed.data);
  compressed.data.insert(compressed.data.begin(), header, 0);
  return compressed;
}

TEST(ValidateBag, CompressedImagesAreRead) {
  const std::string path =
      writeBag(nothing, [](std::string t) { return t == kColor || t == kDepth ? "" : t; });
  {
    rosbag::Bag bag(path, rosbag::bagmode::Append);
    for (int k = 0; k < kFrames; ++k) {
      const Frame frame = goodFrame(k);
      const ros::Time time = frame.color.header.stamp;
      bag.write(kColor + "/compressed", time,
                compressedCopy(frame.color, CV_8UC3, "rgb8; png compressed bgr8", 0));
      bag.write(kDepth + "/compressedDepth", time,
                compressedCopy(frame.depth, CV_16UC1, "16UC1; compressedDepth png", 12));
    }
  }
  const RecordingFacts recording = facts(path);
  EXPECT_TRUE(check(recording).empty()) << toText(recording, check(recording));
  EXPECT_EQ(recording.depth_values.median, 600.0);
}

TEST(ValidateBag, CompressedImagesThatAreDamagedAreCounted) {
  const std::string path = writeBag(nothing, [](std::string t) { return t == kColor ? "" : t; });
  rosbag::Bag(path, rosbag::bagmode::Append)
      .write(kColor + "/compressed", ros::Time(1.6e9), sensor_msgs::CompressedImage());
  const RecordingFacts recording = facts(path);
  EXPECT_TRUE(says(toText(recording, check(recording)), "a compressed image of format '' cannot be decoded"));
  EXPECT_FALSE(usable(check(recording)));
}

TEST(ValidateBag, AWrongTypeIsNamed) {
  const std::string path = writeBag(nothing, [](std::string t) { return t == kColor ? "" : t; });
  rosbag::Bag(path, rosbag::bagmode::Append).write(kColor, ros::Time(1.6e9), sensor_msgs::CompressedImage());
  expectOne(path, Severity::kError, "types", kColor, "is of type sensor_msgs/CompressedImage instead of");
}

TEST(ValidateBag, AnotherVersionOfADefinitionIsNamedWithBothSums) {
  const std::string path = writeBag(nothing, [](std::string t) { return t == kDepth ? "" : t; });
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["topic"] = kDepth;
  (*header)["type"] = "sensor_msgs/Image";
  (*header)["md5sum"] = "0123456789abcdef0123456789abcdef";
  (*header)["message_definition"] = "uint8 other";
  rosbag::Bag(path, rosbag::bagmode::Append).write(kDepth, ros::Time(1.6e9), goodFrame(0).depth, header);
  expectOne(
      path, Severity::kError, "types", kDepth,
      "its md5sum is 0123456789abcdef0123456789abcdef in the bag, and 060021388200f6f0f447d0fcd9c64743 here");
}

TEST(ValidateBag, ImagesThatCannotBeUsedAreCounted) {
  expectOne(writeBag([](Frame* f, int) { f->color.encoding = "8UC3"; }), Severity::kWarning, "camera", "",
            "has encoding '8UC3', which does not name its colours: taken as bgr8");
  expectOne(writeBag([](Frame* f, int k) {
              if (k < 7) f->depth.encoding = "16SC1";
            }),
            Severity::kWarning, "frames", kColor,
            "7 of 60 frames that cannot be used, the first is number 0");
  expectOne(writeBag([](Frame* f, int) { f->depth.encoding = "16SC1"; }), Severity::kError, "frames", kColor,
            "the depth image's encoding is '16SC1'");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 3) f->color.data.resize(10);
            }),
            Severity::kWarning, "frames", kColor, "the first is number 3: the colour image is truncated");
}

TEST(ValidateBag, ImagesOfAnotherSizeThanTheirCameraInfo) {
  const std::string path = writeBag([](Frame* f, int k) {
    if (k == 3) halve(&f->color);
  });
  const Findings findings = check(facts(path));
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_TRUE(says(findings[0].sentence, "64x24 pixels, but its camera_info says 64x48"));
  EXPECT_TRUE(says(findings[1].sentence, "1 of 64x24, 59 of 64x48"));
  EXPECT_TRUE(usable(findings)) << "59 frames are left";
}

TEST(ValidateBag, DepthThatIsNotRegistered) {
  const auto elsewhere = [](Frame* f) { f->depth.header.frame_id = "camera_depth_optical_frame"; };
  expectOne(writeBag([&](Frame* f, int) { elsewhere(f); }), Severity::kError, "frames", kColor,
            "tf does not say where the one is in the other");
  expectOne(writeBag([](Frame* f, int) { f->depth_info.K[0] = f->depth_info.K[4] = 50.0; }),
            Severity::kWarning, "camera", "", "is registered here");
  const auto half = [](Frame* f, int) {
    halve(&f->depth);
    f->depth_info.height /= 2;
    f->depth_info.K[5] /= 2.0;
  };
  expectOne(writeBag(half), Severity::kWarning, "camera", "", "is registered here");
  expectOne(writeBag(half, [](std::string t) { return t == kDepthInfo ? "" : t; }), Severity::kError,
            "frames", kColor, "depth's camera_info is missing");
}

TEST(ValidateBag, DamagedBagsAreRefusedByName) {
  const std::string whole = writeBag([](Frame*, int) {});
  std::ifstream stream(whole, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::string scribbled = bytes;
  for (std::size_t k = 5000; k < bytes.size() / 2; k += 500) scribbled.replace(k, 20, 20, '\7');
  const std::string path = testing::TempDir() + "damaged.bag";
  for (const std::string& damaged : {std::string(), bytes.substr(0, bytes.size() / 2), scribbled}) {
    std::ofstream(path, std::ios::binary) << damaged;
    const std::string said = complaint<std::exception>([&] { facts(path); });
    EXPECT_EQ(said.find(path), 0u) << said;
  }
}

TEST(ValidateBag, DepthScale) {
  expectOne(writeBag([](Frame* f, int) { fill<std::uint16_t>(60, "16UC1", &f->depth); }), Severity::kError,
            "depth scale", kDepth, "median depth of 60, that is 0.06 m");
  expectOne(writeBag([](Frame* f, int) { fill<float>(600.0f, "32FC1", &f->depth); }), Severity::kError,
            "depth scale", kDepth, "if its unit is 0.001 m, set depth_scale (--depth-scale 0.001)");
  expectOne(writeBag([](Frame* f, int) { fill<std::uint16_t>(5000, "16UC1", &f->depth); }),
            Severity::kWarning, "depth scale", kDepth, "median depth of 5.00 m");
  expectOne(writeBag([](Frame* f, int) { fill<float>(std::nanf(""), "32FC1", &f->depth); }), Severity::kError,
            "depth", kDepth, "is zero everywhere");
  expectOne(writeBag([](Frame* f, int) {
              std::fill(f->depth.data.begin() + 1000, f->depth.data.end(), std::uint8_t(0));
            }),
            Severity::kWarning, "depth", kDepth, "at only 16 % of the pixels");
}

TEST(ValidateBag, Intrinsics) {
  using Info = sensor_msgs::CameraInfo;
  // Depth's stays right, so that colour's is the only fault.
  const auto only = [](const std::function<void(Info*)>& change) {
    return writeBag([change](Frame* f, int) { change(&f->color_info); });
  };
  expectOne(only([](Info* i) { i->distortion_model = "fov"; }), Severity::kError, "frames", kColor,
            "distortion model 'fov'");
  expectOne(only([](Info* i) { i->width = 128; }), Severity::kError, "frames", kColor,
            "its camera_info says 128x48");
  expectOne(only([](Info* i) { i->K.fill(0.0); }), Severity::kError, "frames", kColor,
            "is the camera calibrated?");
  expectOne(writeBag([](Frame* f, int k) {
              if (k >= 30) f->color_info.K[2] += 1.0;
            }),
            Severity::kWarning, "intrinsics", kColorInfo, "changes 1 times");

  RecordingFacts recording = facts(writeBag(nothing));
  const auto sentence = [&recording](double fx, double fy, double cx) {
    recording.color_cameras[0].fx = fx;
    recording.color_cameras[0].fy = fy;
    recording.color_cameras[0].cx = cx;
    const Findings findings = checkIntrinsics(recording);
    return findings.size() == 1 ? findings[0].sentence : fmt::format("{} findings", findings.size());
  };
  EXPECT_TRUE(says(sentence(600.0, 600.0, 31.5), "sees 6 degrees"));
  EXPECT_TRUE(says(sentence(60.0, 40.0, 31.5), "fy 40.0"));
  EXPECT_TRUE(says(sentence(60.0, 60.0, 2.0), "centre at (2.0, 23.5)"));
}

}  // namespace
}  // namespace softbody::validation

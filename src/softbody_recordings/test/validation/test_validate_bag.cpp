#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "softbody_recordings/ros/facts_reader.h"
#include "softbody_recordings/validation/checks.h"
#include "validation/intrinsics_checks.h"

namespace softbody::validation {
namespace {

constexpr int kFrames = 60, kWidth = 64, kHeight = 48;
const std::string kColor = "/camera/color/image_raw", kColorInfo = "/camera/color/camera_info",
                  kDepth = "/camera/aligned_depth_to_color/image_raw",
                  kDepthInfo = "/camera/aligned_depth_to_color/camera_info";

/// One frame of a recording without fault, to be spoilt by a test.
struct Frame {
  sensor_msgs::Image color, depth;
  sensor_msgs::CameraInfo color_info, depth_info;
  bool has_color = true, has_depth = true;
  ros::Duration delay;  ///< of the record time
};

sensor_msgs::Image image(const std_msgs::Header& header, const std::string& encoding, std::uint32_t bytes) {
  sensor_msgs::Image result;
  result.header = header;
  result.encoding = encoding;
  result.width = kWidth;
  result.height = kHeight;
  result.step = kWidth * bytes;
  result.data.assign(result.step * kHeight, 100);
  return result;
}

template <typename T>
void fill(T value, const std::string& encoding, sensor_msgs::Image* depth) {
  *depth = image(depth->header, encoding, sizeof(T));
  for (std::size_t i = 0; i < kWidth * kHeight; ++i)
    std::memcpy(&depth->data[i * sizeof(T)], &value, sizeof(T));
}

void halve(sensor_msgs::Image* image) {
  image->height /= 2;
  image->data.resize(image->step * image->height);
}

Frame goodFrame(int number) {
  Frame frame;
  std_msgs::Header header;
  header.stamp = ros::Time(1.6e9) + ros::Duration(number / 30.0);
  header.frame_id = "camera_color_optical_frame";
  frame.color = image(header, "rgb8", 3);
  frame.depth.header = header;
  fill<std::uint16_t>(600, "16UC1", &frame.depth);
  frame.color_info.header = header;
  frame.color_info.width = kWidth;
  frame.color_info.height = kHeight;
  frame.color_info.distortion_model = "plumb_bob";
  frame.color_info.D.assign(5, 0.0);
  frame.color_info.K = {60.0, 0.0, 31.5, 0.0, 60.0, 23.5, 0.0, 0.0, 1.0};
  frame.depth_info = frame.color_info;
  return frame;
}

using Spoil = std::function<void(Frame*, int)>;
using Topics = std::function<std::string(std::string)>;

std::string writeBag(
    const Spoil& spoil, const Topics& rename = [](std::string topic) { return topic; }) {
  const std::string path = testing::TempDir() + "validate.bag";
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  for (int k = 0; k < kFrames; ++k) {
    Frame frame = goodFrame(k);
    const ros::Time time = frame.color.header.stamp;
    spoil(&frame, k);
    const auto write = [&](const std::string& topic, const auto& message) {
      if (!rename(topic).empty()) bag.write(rename(topic), time + frame.delay, message);
    };
    if (frame.has_color) write(kColorInfo, frame.color_info);
    if (frame.has_color) write(kColor, frame.color);
    if (frame.has_depth) write(kDepthInfo, frame.depth_info);
    if (frame.has_depth) write(kDepth, frame.depth);
  }
  return path;
}

RecordingFacts facts(const std::string& path) {
  return readFacts(path, "/camera", [](double) {});
}

void nothing(Frame*, int) {}

/// Exactly one finding, of this check, on this topic, whose sentence holds these words.
void expectOne(const std::string& path, Severity severity, const std::string& check_name,
               const std::string& topic, const std::string& words) {
  const RecordingFacts recording = facts(path);
  const Findings findings = check(recording);
  ASSERT_EQ(findings.size(), 1u) << toText(recording, findings);
  EXPECT_EQ(findings[0].severity, severity) << findings[0].sentence;
  EXPECT_EQ(findings[0].check, check_name) << findings[0].sentence;
  EXPECT_EQ(findings[0].topic, topic);
  EXPECT_NE(findings[0].sentence.find(words), std::string::npos) << findings[0].sentence;
  EXPECT_EQ(usable(findings), severity == Severity::kWarning);
}

TEST(ValidateBag, AGoodBagHasNoFinding) {
  const RecordingFacts recording = facts(writeBag(nothing));
  EXPECT_TRUE(check(recording).empty()) << toText(recording, check(recording));
  EXPECT_NE(toText(recording, {}).find("usable, 0 errors, 0 warnings, 60 colour and 60 depth images"),
            std::string::npos);
  EXPECT_EQ(toJson(recording, {})["usable"], true);
}

TEST(ValidateBag, AMissingTopicIsNamedWithWhatThereIs) {
  expectOne(writeBag(nothing, [](std::string t) { return t == kColorInfo ? "" : t; }), Severity::kError,
            "topics", kColorInfo,
            "is not in the bag (expected sensor_msgs/CameraInfo); of that type the bag has " + kDepthInfo);
  expectOne(writeBag(nothing, [](std::string t) { return t == kDepth ? "/kinect" + t : t; }),
            Severity::kError, "topics", kDepth, "/kinect" + kDepth);
  expectOne(writeBag(nothing, [](std::string t) { return t == kDepthInfo ? "" : t; }), Severity::kWarning,
            "topics", kDepthInfo, "is not in the bag");
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
  EXPECT_NE(toText(recording, check(recording)).find("1 images with a wrong number of bytes"),
            std::string::npos);
}

TEST(ValidateBag, AWrongTypeIsNamed) {
  const std::string path = writeBag(nothing, [](std::string t) { return t == kColor ? "" : t; });
  rosbag::Bag(path, rosbag::bagmode::Append).write(kColor, ros::Time(1.6e9), sensor_msgs::CompressedImage());
  expectOne(path, Severity::kError, "types", kColor, "is of type sensor_msgs/CompressedImage instead of");
}

TEST(ValidateBag, EncodingsAndSizes) {
  expectOne(writeBag([](Frame* f, int) { f->color.encoding = "8UC3"; }), Severity::kError, "encodings",
            kColor, "60 images of encoding '8UC3'; convert them to rgb8");
  expectOne(writeBag([](Frame* f, int k) {
              if (k < 7) f->depth.encoding = "16SC1";
            }),
            Severity::kError, "encodings", kDepth, "7 images of encoding '16SC1'");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 3) f->color.data.resize(10);
            }),
            Severity::kError, "sizes", kColor, "1 images with a wrong number of bytes");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 3) halve(&f->color);
            }),
            Severity::kError, "sizes", kColor, "1 of 64x24, 59 of 64x48");
}

TEST(ValidateBag, DepthThatIsNotRegistered) {
  const auto elsewhere = [](Frame* f) { f->depth.header.frame_id = "camera_depth_optical_frame"; };
  expectOne(writeBag([&](Frame* f, int) {
              halve(&f->depth);
              elsewhere(f);
              f->depth_info.height /= 2;
              f->depth_info.K[5] /= 2.0;
            }),
            Severity::kError, "registration", kDepth, "is 64x24");
  expectOne(writeBag([&](Frame* f, int) {
              f->depth_info.K[0] = f->depth_info.K[4] = 50.0;
              elsewhere(f);
            }),
            Severity::kError, "registration", kDepthInfo, "fx 50.0");
  expectOne(writeBag([](Frame* f, int) { f->depth_info.K[0] = f->depth_info.K[4] = 50.0; }),
            Severity::kWarning, "registration", kDepthInfo, "from which the tracker registers it");
  expectOne(writeBag([&](Frame* f, int) { elsewhere(f); }), Severity::kWarning, "frames", kDepth,
            "'camera_depth_optical_frame'");
}

TEST(ValidateBag, Stamps) {
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 4) f->color.header.stamp = ros::Time();
            }),
            Severity::kError, "stamps", kColor, "1 messages without a stamp");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 10 || k == 11)
                f->color.header.stamp += ros::Duration(k == 10 ? 1.0 / 30.0 : -1.0 / 30.0);
            }),
            Severity::kWarning, "stamps", kColor,
            "goes back in time 1 times, first by 0.033 s at message 11");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 10) f->depth.header.stamp -= ros::Duration(1.0 / 30.0);
            }),
            Severity::kWarning, "stamps", kDepth, "repeats a stamp 1 times");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 10) f->color.header.stamp += ros::Duration(2.0);
            }),
            Severity::kWarning, "stamps", kColor, "has 1 stamps far from those before and after");
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
    try {
      facts(path);
      ADD_FAILURE() << "read " << damaged.size() << " bytes";
    } catch (const std::exception& error) {
      EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
    }
  }
}

TEST(ValidateBag, AClockThatIsOffIsNamedOnBothStreams) {
  const Findings findings = check(facts(writeBag([](Frame* f, int) { f->delay = ros::Duration(100.0); })));
  ASSERT_EQ(findings.size(), 2u);
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.check, "clock");
    EXPECT_NE(finding.sentence.find("was recorded 100.000 s after its stamps"), std::string::npos);
  }
}

TEST(ValidateBag, RatesGapsAndLength) {
  expectOne(writeBag([](Frame* f, int k) {
              // Once every three frames makes 10 Hz.
              f->has_depth = true;
              if (k % 3 != 0) f->has_color = false;
            }),
            Severity::kWarning, "rates", kColor, "comes at 10.0 Hz");
  expectOne(writeBag([](Frame* f, int k) { f->has_color = k < 30 || k >= 36; }), Severity::kWarning, "gaps",
            kColor, "1 gaps at 30.0 Hz, the longest of 0.233 s at 0.97 s");
  const Findings brief =
      check(facts(writeBag([](Frame* f, int k) { f->has_color = f->has_depth = k < 20; })));
  ASSERT_EQ(brief.size(), 2u);
  EXPECT_NE(brief[0].sentence.find("20 images over 0.63 s"), std::string::npos) << brief[0].sentence;
}

TEST(ValidateBag, SyncOffset) {
  // Midway between frames: no depth image is within 15 ms.
  const auto late = [](Frame* f, int) { f->depth.header.stamp += ros::Duration(0.0165); };
  expectOne(writeBag(late), Severity::kError, "sync", kDepth, "within 15 ms of only 0 %");
  const auto some = [](Frame* f, int k) {
    if (k % 4 == 0) f->depth.header.stamp += ros::Duration(0.016);
  };
  expectOne(writeBag(some), Severity::kWarning, "sync", kDepth, "of only 75 %");
}

TEST(ValidateBag, DepthScale) {
  expectOne(writeBag([](Frame* f, int) { fill<std::uint16_t>(60, "16UC1", &f->depth); }), Severity::kError,
            "depth scale", kDepth, "median depth of 60 as 16UC1, that is 0.06 m");
  expectOne(writeBag([](Frame* f, int) { fill<float>(600.0f, "32FC1", &f->depth); }), Severity::kError,
            "depth scale", kDepth, "must be in metres");
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
  const auto both = [](const std::function<void(sensor_msgs::CameraInfo*)>& change) {
    return [change](Frame* f, int) { change(&f->color_info); };
  };
  // Depth's stays right, so that colour's is the only fault.
  const auto only = [&](const std::function<void(sensor_msgs::CameraInfo*)>& change) {
    return writeBag(both(change), [](std::string t) { return t; });
  };
  expectOne(only([](sensor_msgs::CameraInfo* i) { i->distortion_model = "fov"; }), Severity::kError,
            "intrinsics", kColorInfo, "distortion model 'fov'");
  expectOne(only([](sensor_msgs::CameraInfo* i) { i->width = 128; }), Severity::kError, "intrinsics",
            kColorInfo, "is for 128x48 pixels");
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
  EXPECT_NE(sentence(0.0, 60.0, 31.5).find("not calibrated"), std::string::npos);
  EXPECT_NE(sentence(60.0, std::nan(""), 31.5).find("not calibrated"), std::string::npos);
  EXPECT_NE(sentence(600.0, 600.0, 31.5).find("sees 6 degrees"), std::string::npos);
  EXPECT_NE(sentence(60.0, 40.0, 31.5).find("fy 40.0"), std::string::npos);
  EXPECT_NE(sentence(60.0, 60.0, 2.0).find("centre at (2.0, 23.5)"), std::string::npos);
}

TEST(ValidateBag, WhatIsNoBagIsRefused) {
  const std::string path = testing::TempDir() + "no.bag";
  FILE* file = std::fopen(path.c_str(), "w");
  std::fputs("not a bag", file);
  std::fclose(file);
  EXPECT_ANY_THROW(facts(path));
}

}  // namespace
}  // namespace softbody::validation

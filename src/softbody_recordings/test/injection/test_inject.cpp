#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>

#include "ros/injection/injector.h"

namespace softbody::injection {
namespace {

constexpr std::size_t kFrames = 40;
constexpr int kWidth = 64, kHeight = 48;
const std::string kColor = "/camera/color/image_raw", kDepth = "/camera/aligned_depth_to_color/image_raw",
                  kInfo = "/camera/color/camera_info";

ros::Time stampOf(std::size_t k) {
  return ros::Time(1600000000, 0) + ros::Duration(0.1 * static_cast<double>(k));
}

sensor_msgs::Image image(std::size_t k, const std::string& encoding, std::uint32_t bytes) {
  sensor_msgs::Image result;
  result.header.stamp = stampOf(k);
  result.header.frame_id = "camera";
  result.encoding = encoding;
  result.width = kWidth;
  result.height = kHeight;
  result.step = kWidth * bytes;
  result.data.assign(result.step * kHeight, 2);  // 514 mm
  return result;
}

const std::string& input() {
  static const std::string path = [] {
    const std::string file = testing::TempDir() + "inject_in.bag";
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    for (std::size_t k = 0; k < kFrames; ++k) {
      sensor_msgs::CameraInfo info;
      info.header.stamp = stampOf(k);
      bag.write(kInfo, stampOf(k), info);
      bag.write(kColor, stampOf(k), image(k, "rgb8", 3));
      bag.write(kDepth, stampOf(k), image(k, "16UC1", 2));
    }
    return file;
  }();
  return path;
}

struct BagImage {
  ros::Time received;
  sensor_msgs::Image image;
};

std::vector<BagImage> arrivals(const std::string& path, const std::string& topic) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::vector<BagImage> result;
  for (const rosbag::MessageInstance& m : view)
    result.push_back({m.getTime(), *m.instantiate<sensor_msgs::Image>()});
  return result;
}

InjectorOptions optionsFor(const std::string& name) {
  InjectorOptions options;
  options.input = input();
  options.output = testing::TempDir() + name;
  return options;
}

void run(const InjectorOptions& options) {
  inject(options, [](double) {});
}

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

double shareOf(const sensor_msgs::Image& image, std::uint16_t value) {
  const auto* z = reinterpret_cast<const std::uint16_t*>(image.data.data());
  return static_cast<double>(std::count(z, z + kWidth * kHeight, value)) / (kWidth * kHeight);
}

TEST(Choose, ExactlyTheShareAndOnlyByTheSeed) {
  for (const double share : {0.0, 0.1, 0.333, 0.5, 1.0}) {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
      const std::vector<bool> chosen = choose(60, share, seed, 7);
      EXPECT_EQ(std::count(chosen.begin(), chosen.end(), true), std::lround(share * 60));
      EXPECT_EQ(chosen, choose(60, share, seed, 7));
    }
  }
  EXPECT_NE(choose(60, 0.5, 1, 7), choose(60, 0.5, 2, 7));
  EXPECT_NE(choose(60, 0.5, 1, 7), choose(60, 0.5, 1, 8));
}

TEST(Inject, WithoutFaultsNothingChanges) {
  const InjectorOptions options = optionsFor("inject_none.bag");
  const InjectionReport report = inject(options, [](double) {});
  EXPECT_EQ(report.copied, kFrames);
  for (const std::string& topic : {kColor, kDepth}) {
    const std::vector<BagImage> before = arrivals(input(), topic), after = arrivals(options.output, topic);
    ASSERT_EQ(after.size(), kFrames);
    for (std::size_t k = 0; k < kFrames; ++k) {
      EXPECT_EQ(after[k].received, before[k].received);
      EXPECT_EQ(after[k].image.header.stamp, before[k].image.header.stamp);
      EXPECT_EQ(after[k].image.data, before[k].image.data);
    }
  }
}

TEST(Inject, DroppedFramesAreTheSameInBothStreamsAndTheRestIsUntouched) {
  InjectorOptions options = optionsFor("inject_drop.bag");
  options.deliveries.drop_share = 0.25;
  run(options);
  const std::vector<BagImage> color = arrivals(options.output, kColor),
                              depth = arrivals(options.output, kDepth);
  ASSERT_EQ(color.size(), kFrames * 3 / 4);
  ASSERT_EQ(depth.size(), color.size());
  for (std::size_t i = 0; i < color.size(); ++i)
    EXPECT_EQ(color[i].image.header.stamp, depth[i].image.header.stamp);
  rosbag::Bag bag(options.output, rosbag::bagmode::Read);
  EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery(kInfo)).size(), kFrames);
}

TEST(Inject, OneStreamAlone) {
  InjectorOptions options = optionsFor("inject_one.bag");
  options.deliveries.drop_share = 0.5;
  options.in_color = false;
  run(options);
  EXPECT_EQ(arrivals(options.output, kColor).size(), kFrames);
  EXPECT_EQ(arrivals(options.output, kDepth).size(), kFrames / 2);
}

TEST(Inject, DuplicatedFramesComeTwice) {
  InjectorOptions options = optionsFor("inject_twice.bag");
  options.deliveries.duplicate_share = 0.1;
  run(options);
  const std::vector<BagImage> color = arrivals(options.output, kColor);
  EXPECT_EQ(color.size(), kFrames * 11 / 10);
  std::set<ros::Time> stamps;
  for (const BagImage& arrival : color) stamps.insert(arrival.image.header.stamp);
  EXPECT_EQ(stamps.size(), kFrames);
}

TEST(Inject, DelayedFramesArriveLateWithTheirOwnStamps) {
  InjectorOptions options = optionsFor("inject_late.bag");
  options.deliveries.delay_share = 0.2;
  options.deliveries.delay_s = 0.25;
  run(options);
  std::size_t late = 0;
  for (const BagImage& arrival : arrivals(options.output, kColor)) {
    const double delay = (arrival.received - arrival.image.header.stamp).toSec();
    late += delay > 0.0;
    EXPECT_NEAR(delay, delay > 0.0 ? 0.25 : 0.0, 1e-9);
  }
  EXPECT_EQ(late, kFrames / 5);
}

TEST(Inject, ReorderedFramesArriveJustAfterTheNextOneAndNothingIsLost) {
  std::vector<Nanoseconds> received(400);
  for (std::size_t i = 0; i < received.size(); ++i) received[i] = static_cast<Nanoseconds>(33'000'000 * i);
  DeliveryFaults faults;
  for (const double share : {0.0, 0.1, 0.2, 0.5}) {
    faults.reorder_share = share;
    for (faults.seed = 1; faults.seed < 20; ++faults.seed) {
      const std::vector<Arrival> planned = planArrivals(received, faults);
      ASSERT_EQ(planned.size(), received.size());
      std::size_t overtaken = 0;
      for (std::size_t i = 0; i < planned.size(); ++i) {
        EXPECT_GE(planned[i].received, received[i]) << "before it was taken";
        if (planned[i].received == received[i]) continue;
        ++overtaken;
        EXPECT_GT(planned[i].received, planned[i + 1].received);
        EXPECT_LT(planned[i].received, received[i + 1] + 1'000'000);
      }
      EXPECT_EQ(overtaken, std::lround(share * 400));
    }
  }
}

TEST(ImageDelivery, OfAnyTwentyInARowTheShareIsChosenWhateverTheLength) {
  DeliveryFaults faults;
  faults.drop_share = 0.15;
  for (faults.seed = 1; faults.seed < 20; ++faults.seed) {
    int dropped = 0;
    for (std::size_t i = 0; i < 1000; ++i) {
      dropped += deliveryOf(i, faults).copies == 0;
      if (i % 20 != 19) continue;
      EXPECT_EQ(dropped, std::lround(0.15 * static_cast<double>(i + 1)));
    }
  }
}

TEST(Inject, WrongStampsAreOffByWhatIsAskedFor) {
  InjectorOptions options = optionsFor("inject_stamp.bag");
  options.deliveries.stamp_share = 0.5;
  options.deliveries.stamp_s = -3.0;
  run(options);
  std::size_t wrong = 0;
  for (const BagImage& arrival : arrivals(options.output, kDepth)) {
    const double off = (arrival.image.header.stamp - arrival.received).toSec();
    wrong += off < 0.0;
    EXPECT_NEAR(off, off < 0.0 ? -3.0 : 0.0, 1e-9);
  }
  EXPECT_EQ(wrong, kFrames / 2);
}

TEST(Inject, TheOccluderCoversItsShareForItsTimeAndIsNearer) {
  InjectorOptions options = optionsFor("inject_hand.bag");
  options.images.occluder_share = 0.25;
  options.images.occluder_m = 0.3;
  options.images.occluder_from_s = 1.0;
  options.images.occluder_for_s = 2.0;
  run(options);
  const std::vector<BagImage> depth = arrivals(options.output, kDepth),
                              color = arrivals(options.output, kColor);
  for (std::size_t k = 0; k < kFrames; ++k) {
    const bool present = k >= 10 && k < 30;
    EXPECT_DOUBLE_EQ(shareOf(depth[k].image, 300), present ? 0.25 : 0.0) << k;
    EXPECT_DOUBLE_EQ(shareOf(depth[k].image, 514), present ? 0.75 : 1.0) << k;
    const std::size_t middle = (kHeight / 2 * kWidth + kWidth / 2) * 3;
    EXPECT_EQ(color[k].image.data[middle], present ? 224 : 2) << k;
    EXPECT_EQ(color[k].image.data[0], 2);
  }
}

TEST(ImageFaults, WhatIsNearerThanTheOccluderStays) {
  ImageFaults faults;
  faults.occluder_share = 1.0;
  faults.occluder_m = 0.4;
  cv::Mat depth = (cv::Mat_<float>(1, 3) << 0.2f, 0.0f, 0.9f);
  occludeDepth(faults, &depth);
  EXPECT_EQ(depth.at<float>(0), 0.2f);
  EXPECT_EQ(depth.at<float>(1), 0.4f);
  EXPECT_EQ(depth.at<float>(2), 0.4f);
  cv::Mat other(2, 2, CV_8UC1);
  EXPECT_THROW(occludeDepth(faults, &other), std::invalid_argument);
}

TEST(Inject, HolesAreTheirShareOfEveryDepthImageAndOthersInEach) {
  InjectorOptions options = optionsFor("inject_holes.bag");
  options.images.hole_share = 0.25;
  run(options);
  const std::vector<BagImage> depth = arrivals(options.output, kDepth);
  for (const BagImage& arrival : depth) EXPECT_DOUBLE_EQ(shareOf(arrival.image, 0), 0.25);
  EXPECT_NE(depth[0].image.data, depth[1].image.data);
}

TEST(ImageFaults, MisplacedBlocksShowWhatIsBesideThem) {
  std::mt19937 random(3);
  cv::Mat3b original(240, 480);
  for (cv::Vec3b& pixel : original) pixel = {uchar(random()), uchar(random()), uchar(random())};
  ImageFaults faults;
  faults.misplaced_share = 0.25;
  cv::Mat3b images[2];
  for (int frame = 0; frame < 2; ++frame) {
    original.copyTo(images[frame]);
    misplaceBlocks(faults, frame, &images[frame]);
    int misplaced = 0;
    for (int v = 0; v < original.rows; v += 24) {
      for (int u = 0; u < original.cols; u += 24) {
        const cv::Mat3b block = images[frame](cv::Rect(u, v, 24, 24));
        if (cv::norm(block, original(cv::Rect(u, v, 24, 24)), cv::NORM_INF) == 0.0) continue;
        ++misplaced;
        cv::Mat1f likeness;
        cv::matchTemplate(original, block, likeness, cv::TM_SQDIFF);
        cv::Point place;
        cv::minMaxLoc(likeness, nullptr, nullptr, &place);
        EXPECT_EQ(cv::norm(block, original(cv::Rect(place, block.size())), cv::NORM_INF), 0.0)
            << u << " " << v;
        EXPECT_LT(cv::norm(place - cv::Point(u, v)), 12.8);
        const bool at_border = u == 0 || v == 0 || u + 24 == original.cols || v + 24 == original.rows;
        EXPECT_TRUE(at_border || cv::norm(place - cv::Point(u, v)) > 3.2);
      }
    }
    EXPECT_NEAR(misplaced, 50, 8) << "at the border a block may stay where it is";
  }
  EXPECT_GT(cv::norm(images[0], images[1], cv::NORM_INF), 0.0) << "others in every image";
}

/// As other drivers write the same images.
std::string otherInput() {
  const std::string file = testing::TempDir() + "inject_other.bag";
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  for (std::size_t k = 0; k < kFrames; ++k) {
    sensor_msgs::CompressedImage color;
    color.header = image(k, "", 0).header;
    cv::imencode(".png", cv::Mat3b(kHeight, kWidth, cv::Vec3b(2, 2, 2)), color.data);
    bag.write(kColor + "/compressed", stampOf(k), color);
    sensor_msgs::Image depth = image(k, "16UC1", 2);
    depth.is_bigendian = 1;  // 514 mm has the same bytes
    bag.write(kDepth, stampOf(k), depth);
  }
  return file;
}

TEST(Inject, OtherEncodingsAndTransportsGetTheSameFaults) {
  InjectorOptions options = optionsFor("inject_usual_out.bag"), other = optionsFor("inject_other_out.bag");
  other.input = otherInput();
  for (InjectorOptions* each : {&options, &other}) {
    each->images.occluder_share = 0.2;
    each->images.hole_share = 0.3;
    run(*each);
  }
  const std::vector<BagImage> usual = arrivals(options.output, kDepth),
                              depths = arrivals(other.output, kDepth);
  for (std::size_t k = 0; k < kFrames; ++k) EXPECT_EQ(depths.at(k).image.data, usual.at(k).image.data);
  const std::vector<BagImage> colors = arrivals(other.output, kColor);
  ASSERT_EQ(colors.size(), kFrames) << "raw, because they are changed";
  EXPECT_NE(colors[5].image.data, std::vector<std::uint8_t>(colors[5].image.data.size(), 2));
}

TEST(Inject, TheSameSeedGivesTheSameBytes) {
  InjectorOptions options = optionsFor("inject_a.bag");
  options.deliveries = {5, 0.1, 0.1, 0.1, 0.1, 0.2, 0.1, 0.1};
  options.images.hole_share = 0.1;
  run(options);
  const std::string first = bytes(options.output);
  run(options);
  EXPECT_EQ(bytes(options.output), first);
  options.deliveries.seed = 6;
  run(options);
  EXPECT_NE(bytes(options.output), first);
}

TEST(Inject, AFailureLeavesEarlierOutputAlone) {
  InjectorOptions options = optionsFor("inject_kept.bag");
  run(options);
  const std::string before = bytes(options.output);
  options.camera = "/elsewhere";
  EXPECT_THROW(run(options), std::invalid_argument);
  EXPECT_EQ(bytes(options.output), before);
  options = optionsFor("inject_kept.bag");
  options.input = options.output;
  EXPECT_THROW(run(options), std::invalid_argument);
  EXPECT_EQ(bytes(options.output), before);
}

}  // namespace
}  // namespace softbody::injection

#include <rosbag/bag.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "softbody_recordings/ros/bag_transforms.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

constexpr double kBegin_s = 1000.0;

ros::Time after(double seconds) { return ros::Time(kBegin_s + seconds); }

/// A bag of transforms, made message by message.
class TransformBag {
 public:
  explicit TransformBag(const std::string& name)
      : path_(folder_ / (name + ".bag")), bag_(path_, rosbag::bagmode::Write) {}

  void add(const std::string& parent, const std::string& child, double seconds, const Eigen::Isometry3d& pose,
           const char* topic = "/tf") {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(pose);
    transform.header.stamp = after(seconds);
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    add(transform, topic);
  }
  void add(const geometry_msgs::TransformStamped& transform, const char* topic = "/tf") {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    bag_.write(topic, transform.header.stamp, message);
  }
  /// Every period from the begin for four seconds.
  void addAll(const std::string& parent, const std::string& child, double period_s, double speed_m_s) {
    for (double t = 0.0; t < 4.0 + 0.5 * period_s; t += period_s)
      add(parent, child, t, shifted(speed_m_s * t));
  }
  static Eigen::Isometry3d shifted(double x_m) {
    return Eigen::Isometry3d(Eigen::Translation3d(x_m, 0.0, 0.0));
  }

  std::string path() const { return path_; }
  BagTransforms read() {
    bag_.close();
    return BagTransforms({path_.string()});
  }

 private:
  test::ScratchFolder folder_;
  fs::path path_;
  rosbag::Bag bag_;
};

TEST(BagTransforms, AreThoseOfTf2) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const std::vector<std::string> frames{"world", "base", "arm", "hand", "camera", "table"};
  const std::vector<std::size_t> parents{0, 0, 1, 2, 3, 0};
  TransformBag bag("bag_transforms_tf2");
  tf2::BufferCore buffer{ros::Duration(100.0)};
  const auto add = [&](std::size_t child, double t, bool is_static) {
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(any(random), any(random), any(random)) *
        Eigen::AngleAxisd(0.3 * any(random), Eigen::Vector3d(any(random), any(random), 2.0).normalized());
    bag.add(frames[parents[child]], frames[child], t, pose, is_static ? "/tf_static" : "/tf");
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(pose);
    transform.header.stamp = after(t);
    transform.header.frame_id = frames[parents[child]];
    transform.child_frame_id = frames[child];
    buffer.setTransform(transform, "test", is_static);
  };
  add(4, 0.0, true);
  for (const std::size_t child : {1u, 2u, 3u, 5u})
    for (int i = 0; i <= 40; ++i) add(child, 0.02 * i * static_cast<double>(child), false);
  const BagTransforms transforms = bag.read();
  for (int i = 0; i < 200; ++i) {
    const std::string target = frames[random() % frames.size()], source = frames[random() % frames.size()];
    const ros::Time stamp = after(0.4 * (1.0 + any(random)));
    const Eigen::Isometry3d expected = tf2::transformToEigen(buffer.lookupTransform(target, source, stamp));
    EXPECT_TRUE(transforms.at(target, source, stamp).isApprox(expected, 1e-9)) << target << " " << source;
  }
}

TEST(BagTransforms, AParentThatChangesIsThatOfTf2) {
  TransformBag bag("bag_transforms_parent");
  tf2::BufferCore buffer{ros::Duration(100.0)};
  const auto add = [&](const std::string& parent, const std::string& child, double t, double x_m) {
    bag.add(parent, child, t, TransformBag::shifted(x_m));
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(TransformBag::shifted(x_m));
    transform.header.stamp = after(t);
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    buffer.setTransform(transform, "test");
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i <= 20; ++i) {
    add("world", "hand", 0.2 * i, any(random));
    add("world", "table", 0.2 * i, any(random));
  }
  // Put down and taken up again.
  for (int i = 0; i <= 10; ++i) add(i % 2 == 0 ? "hand" : "table", "object", 0.4 * i, any(random));
  const BagTransforms transforms = bag.read();
  for (int i = 0; i < 200; ++i) {
    const ros::Time stamp = after(2.0 * (1.0 + any(random)));
    const Eigen::Isometry3d expected =
        tf2::transformToEigen(buffer.lookupTransform("world", "object", stamp));
    EXPECT_TRUE(transforms.at("world", "object", stamp).isApprox(expected, 1e-9)) << stamp;
  }
}

void expectAsTf2(const char* target, const char* source, const ros::Time& stamp,
                 const BagTransforms& transforms, const tf2::BufferCore& buffer) {
  const Eigen::Isometry3d expected = tf2::transformToEigen(buffer.lookupTransform(target, source, stamp));
  EXPECT_TRUE(transforms.at(target, source, stamp).isApprox(expected, 1e-9)) << target << " " << stamp;
}

geometry_msgs::TransformStamped infinitelyFar(const std::string& child, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform =
      tf2::eigenToTransform(TransformBag::shifted(std::numeric_limits<double>::infinity()));
  transform.header.stamp = stamp;
  transform.header.frame_id = "world";
  transform.child_frame_id = child;
  return transform;
}

/// A bag and tf2 with the same transforms.
struct BagAndTf2 {
  TransformBag bag{"bag_transforms_refused"};
  tf2::BufferCore buffer{ros::Duration(100.0)};

  /// Returns whether tf2 takes the transform.
  bool add(const std::string& parent, const std::string& child, double t,
           const geometry_msgs::Quaternion& rotation, double x_m, bool is_static = false) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(TransformBag::shifted(x_m));
    transform.transform.rotation = rotation;
    transform.header.stamp = after(t);
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    bag.add(transform, is_static ? "/tf_static" : "/tf");
    return buffer.setTransform(transform, "test", is_static);
  }
};

TEST(BagTransforms, WhatTf2RefusesIsLeftOutAndSaidOnce) {
  BagAndTf2 both;
  geometry_msgs::Quaternion unit, zero, hardly, nearly;
  unit.w = 1.0;
  hardly.w = std::sqrt(1.011);
  nearly.w = std::sqrt(1.009);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(both.add("world", "", 0.1, unit, 0.3));
  for (const std::string child : {"camera", "tool"}) {
    EXPECT_TRUE(both.add("world", child, 0.0, unit, 0.0));
    for (const bool is_static : {false, true}) {
      for (const std::string& parent : {child, "/" + child, std::string()})
        EXPECT_FALSE(both.add(parent, child, 0.05, unit, 0.3, is_static)) << parent;
    }
    EXPECT_FALSE(both.add("world", child, 0.1, zero, 0.3));
    EXPECT_FALSE(both.add("world", child, 0.15, unit, nan));
    both.bag.add(infinitelyFar(child, after(0.17)));  // which tf2 takes
    EXPECT_FALSE(both.add("world", child, 0.2, hardly, 0.3));
    EXPECT_TRUE(both.add("world", child, 0.3, nearly, 0.3));
    EXPECT_TRUE(both.add("world", child, 0.4, unit, 0.4));
  }
  const BagTransforms transforms = both.bag.read();
  for (double t = 0.01; t < 0.4; t += 0.02) {
    expectAsTf2("tool", "camera", after(t), transforms, both.buffer);
    expectAsTf2("world", "camera", after(t), transforms, both.buffer);
  }
  ASSERT_EQ(transforms.warnings().size(), 3u);
  EXPECT_TRUE(says(transforms.warnings()[0], "1 transform of frame ''"));
  EXPECT_TRUE(says(transforms.warnings()[1], "10 transforms of frame 'camera'"));
}

TEST(BagTransforms, AGapCountsOnlyWhereTheFrameMovedMeanwhile) {
  TransformBag bag("bag_transforms_gap");
  bag.addAll("world", "mount", 1.0, 0.0);
  bag.addAll("mount", "camera", 0.01, 0.1);
  bag.addAll("world", "slow", 1.0, 0.01);
  const BagTransforms transforms = bag.read();
  EXPECT_NEAR(transforms.at("world", "camera", after(2.6)).translation().x(), 0.26, 1e-9);
  EXPECT_NEAR(transforms.at("camera", "world", after(2.6)).translation().x(), -0.26, 1e-9);
  EXPECT_THROW(transforms.at("world", "slow", after(2.6)), tf2::ExtrapolationException);
  EXPECT_THROW(transforms.at("slow", "camera", after(2.6)), tf2::ExtrapolationException);
  EXPECT_NEAR(transforms.at("world", "slow", after(2.0)).translation().x(), 0.02, 1e-9)
      << "at a stamp there is no gap";
}

TEST(BagTransforms, AGapCountsWhereTheParentIsAnotherAfterIt) {
  TransformBag bag("bag_transforms_gap_parent");
  for (const char* parent : {"a", "b"}) bag.addAll("world", parent, 0.1, 0.0);
  bag.add("a", "camera", 0.0, TransformBag::shifted(0.3));
  bag.add("a", "camera", 1.0, TransformBag::shifted(0.3));
  bag.add("b", "camera", 3.0, TransformBag::shifted(0.3));
  const BagTransforms transforms = bag.read();
  for (const double t : {1.01, 2.0, 2.99})
    EXPECT_THROW(transforms.at("world", "camera", after(t)), tf2::ExtrapolationException) << t;
  for (const double t : {0.5, 1.0, 3.0})
    EXPECT_NEAR(transforms.at("world", "camera", after(t)).translation().x(), 0.3, 1e-9) << t;
}

TEST(BagTransforms, WhatIsAboveBothFramesDoesNotCount) {
  TransformBag bag("bag_transforms_above");
  bag.addAll("map", "base", 1.0, 0.5);  // a robot that drives, and says so once a second
  bag.addAll("base", "camera", 0.01, 0.1);
  bag.addAll("base", "table", 0.01, 0.0);
  const BagTransforms transforms = bag.read();
  EXPECT_NEAR(transforms.at("base", "camera", after(2.6)).translation().x(), 0.26, 1e-9);
  EXPECT_NEAR(transforms.at("table", "camera", after(2.6)).translation().x(), 0.26, 1e-9);
  EXPECT_THROW(transforms.at("map", "camera", after(2.6)), tf2::ExtrapolationException);
}

TEST(BagTransforms, WhatIsNotThereIsAnException) {
  TransformBag bag("bag_transforms_none");
  bag.addAll("world", "camera", 0.1, 0.1);
  bag.addAll("elsewhere", "tool", 0.1, 0.1);
  bag.add("chases", "itself", 1.0, TransformBag::shifted(1.0));
  bag.add("itself", "chases", 1.0, TransformBag::shifted(1.0));
  const BagTransforms transforms = bag.read();
  EXPECT_THROW(transforms.at("world", "camera", after(-1.0)), tf2::TransformException);
  EXPECT_THROW(transforms.at("world", "camera", after(9.0)), tf2::TransformException);
  EXPECT_THROW(transforms.at("world", "tool", after(1.0)), tf2::TransformException);
  EXPECT_THROW(transforms.at("nowhere", "camera", after(1.0)), tf2::TransformException);
  EXPECT_THROW(transforms.at("world", "itself", after(1.0)), tf2::TransformException);
}

TEST(BagTransforms, ASlashBeforeAFrameIsNoOtherFrame) {
  TransformBag bag("bag_transforms_slash");
  bag.add("/world", "camera", 0.0, TransformBag::shifted(3.0));
  const BagTransforms transforms = bag.read();
  EXPECT_EQ(transforms.at("world", "/camera", after(0.0)).translation().x(), 3.0);
  EXPECT_EQ(transforms.at("/world", "world", after(0.0)).translation().x(), 0.0);
}

TEST(BagTransforms, OfOneStampTheLaterBagCounts) {
  TransformBag first("bag_transforms_first"), second("bag_transforms_second");
  first.add("world", "camera", 1.0, TransformBag::shifted(1.0));
  second.add("/world", "/camera", 1.0, TransformBag::shifted(2.0));
  first.add("world", "camera", 0.9, TransformBag::shifted(1.0));
  first.add("world", "table", 0.0, TransformBag::shifted(1.0), "/tf_static");
  second.add("world", "table", 0.0, TransformBag::shifted(2.0), "/tf_static");
  first.read();
  second.read();
  for (const char* frame : {"camera", "table"}) {
    const auto at = [&](const TransformBag& a, const TransformBag& b) {
      return BagTransforms({a.path(), b.path()}).at("world", frame, after(1.0)).translation().x();
    };
    EXPECT_EQ(at(first, second), 2.0) << frame;
    EXPECT_EQ(at(second, first), 1.0) << frame;
  }
}

TEST(BagTransforms, OfOneStampInOneBagTheOneThatTf2KeepsCounts) {
  TransformBag bag("bag_transforms_repeated");
  tf2::BufferCore buffer{ros::Duration(100.0)};
  const auto add = [&](const std::string& parent, const std::string& child, double t, double x_m,
                       bool is_static = false) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(TransformBag::shifted(x_m));
    transform.header.stamp = after(t);
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    bag.add(transform, is_static ? "/tf_static" : "/tf");
    buffer.setTransform(transform, "test", is_static);
  };
  for (int i = 0; i <= 10; ++i) add("world", "camera", 0.1 * i, 0.1 * i);
  add("world", "camera", 0.3, 7.0);
  add("other", "camera", 0.5, 8.0);
  add("world", "other", 0.0, 2.0, true);
  add("world", "other", 0.0, 3.0, true);
  const BagTransforms transforms = bag.read();
  for (const double t : {0.25, 0.3, 0.35, 0.45, 0.5, 0.55}) {
    for (const char* target : {"world", "other"}) {
      const Eigen::Isometry3d expected =
          tf2::transformToEigen(buffer.lookupTransform(target, "camera", after(t)));
      EXPECT_TRUE(transforms.at(target, "camera", after(t)).isApprox(expected, 1e-9)) << target << " " << t;
    }
  }
}

}  // namespace
}  // namespace softbody

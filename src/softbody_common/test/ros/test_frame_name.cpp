#include <gtest/gtest.h>

#include "softbody_common/ros/frame_name.h"

namespace softbody {
namespace {

TEST(FrameName, HasNoLeadingSlash) {
  EXPECT_EQ(withoutSlash("/world"), "world");
  EXPECT_EQ(withoutSlash("left/softbody"), "left/softbody");
  EXPECT_EQ(withoutSlash(""), "");
}

TEST(FrameName, FollowsTheNamespaceExceptTheDefaultOne) {
  EXPECT_EQ(frameInNamespace("/softbody", "tool"), "tool");
  EXPECT_EQ(frameInNamespace("/", "softbody"), "softbody");
  EXPECT_EQ(frameInNamespace("", "softbody"), "softbody");
  EXPECT_EQ(frameInNamespace("/left", "softbody"), "left/softbody");
  EXPECT_EQ(frameInNamespace("/robot/left", "tool"), "robot/left/tool");
}

}  // namespace
}  // namespace softbody

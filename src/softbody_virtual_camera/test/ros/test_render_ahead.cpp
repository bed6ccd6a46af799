#include <gtest/gtest.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <thread>

#include "softbody_virtual_camera/ros/render_ahead.h"

namespace softbody::virtual_camera {
namespace {

CaptureMessages numbered(int frame) {
  CaptureMessages messages;
  messages.color = boost::make_shared<sensor_msgs::Image>();
  messages.color->header.seq = static_cast<std::uint32_t>(frame);
  return messages;
}

TEST(RenderAhead, EachFrameIsRenderedOnceInAnotherThread) {
  std::atomic<int> rendered{0};
  std::thread::id renderer;
  RenderAhead ahead([&](int frame) {
    ++rendered;
    renderer = std::this_thread::get_id();
    return numbered(frame);
  });
  for (int frame = 0; frame < 100; ++frame) {
    ahead.start(frame);
    EXPECT_EQ(ahead.take().color->header.seq, static_cast<std::uint32_t>(frame));
    EXPECT_EQ(rendered, frame + 1);
  }
  EXPECT_NE(renderer, std::this_thread::get_id());
}

TEST(RenderAhead, AFrameThatNobodyTakesDoesNotBlockTheEnd) {
  std::atomic<bool> begun{false};
  {
    RenderAhead ahead([&](int frame) {
      begun = true;
      return numbered(frame);
    });
    ahead.start(1);
    while (!begun) std::this_thread::yield();
  }
  const RenderAhead idle(numbered);
}

}  // namespace
}  // namespace softbody::virtual_camera

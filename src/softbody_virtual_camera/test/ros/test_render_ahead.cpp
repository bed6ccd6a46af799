#include <gtest/gtest.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <cmath>
#include <future>
#include <thread>

#include "ros/render_ahead.h"

namespace softbody::virtual_camera {
namespace {

CaptureMessages numbered(int frame) {
  CaptureMessages messages;
  for (sensor_msgs::ImagePtr* image : {&messages.color, &messages.depth, &messages.labels})
    *image = boost::make_shared<sensor_msgs::Image>();
  messages.info = boost::make_shared<sensor_msgs::CameraInfo>();
  messages.truth = boost::make_shared<softbody_msgs::MeshState>();
  messages.camera = boost::make_shared<geometry_msgs::PoseStamped>();
  messages.color->header.seq = static_cast<std::uint32_t>(frame);
  return messages;
}

/// Goes on by a tick whenever somebody reads it.
class TickingClock {
 public:
  static constexpr double kTick_s = 1e-4;

  ros::Time now() { return at(++ticks_); }
  void advance(double seconds) { ticks_ += std::lround(seconds / kTick_s); }
  RenderAhead::Clock reader() {
    return [this] { return now(); };
  }

 private:
  static ros::Time at(std::int64_t ticks) {
    return ros::Time(1000.0) + ros::Duration(kTick_s * static_cast<double>(ticks));
  }

  std::atomic<std::int64_t> ticks_{0};
};

TEST(RenderAhead, EachFrameIsRenderedOnceInAnotherThread) {
  std::atomic<int> rendered{0};
  std::thread::id renderer;
  TickingClock clock;
  RenderAhead ahead(
      [&](int frame) {
        ++rendered;
        renderer = std::this_thread::get_id();
        return numbered(frame);
      },
      clock.reader());
  for (int frame = 0; frame < 100; ++frame) {
    ahead.start(frame, clock.now());
    EXPECT_EQ(ahead.take().color->header.seq, static_cast<std::uint32_t>(frame));
    EXPECT_EQ(rendered, frame + 1);
  }
  EXPECT_NE(renderer, std::this_thread::get_id());
}

TEST(RenderAhead, AFrameIsNotOlderThanTheMarginAtItsTimeAndItsStampIsThatOfSending) {
  constexpr double kRender_s = 0.004, kPeriod_s = 0.010;
  TickingClock clock;
  std::promise<ros::Time> done;
  RenderAhead ahead(
      [&](int frame) {
        clock.advance(kRender_s);
        done.set_value(clock.now());
        return numbered(frame);
      },
      clock.reader());
  for (int frame = 0; frame < 20; ++frame) {
    done = std::promise<ros::Time>();
    const ros::Time due = clock.now() + ros::Duration(kPeriod_s);
    ahead.start(frame, due);
    const ros::Time rendered = done.get_future().get();
    const CaptureMessages messages = ahead.take();
    const double ticks_s = 5 * TickingClock::kTick_s;
    if (frame > 0) {  // how long the first frame takes is not known before
      EXPECT_NEAR((due - rendered).toSec(), RenderAhead::kMargin_s, ticks_s);
    }
    for (const auto& header : {messages.color->header, messages.depth->header, messages.info->header})
      EXPECT_NEAR((clock.now() - header.stamp).toSec(), 0.0, ticks_s);
  }
}

TEST(RenderAhead, WhoWaitsForAFrameIsNotKeptWaitingUntilItsTime) {
  TickingClock clock;
  RenderAhead ahead(numbered, clock.reader());
  ahead.start(1, clock.now() + ros::Duration(1e6));
  EXPECT_EQ(ahead.take().color->header.seq, 1U);
}

TEST(RenderAhead, AFrameThatNobodyTakesDoesNotBlockTheEnd) {
  std::atomic<bool> begun{false};
  TickingClock clock;
  {
    RenderAhead ahead(
        [&](int frame) {
          begun = true;
          return numbered(frame);
        },
        clock.reader());
    ahead.start(1, clock.now());
    while (!begun) std::this_thread::yield();
  }
  const RenderAhead idle(numbered);
  RenderAhead early(numbered, clock.reader());
  early.start(1, clock.now() + ros::Duration(1e6));
}

}  // namespace
}  // namespace softbody::virtual_camera

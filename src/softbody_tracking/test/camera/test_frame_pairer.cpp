#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>
#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody {
namespace {

using Image = std::shared_ptr<Nanoseconds>;
using Pairer = FramePairer<Image, Image, Image>;

constexpr Nanoseconds kStart = 1'000'000'000, kFrame = 33'333'333, kTolerance = 15'000'000;

Image imageAt(Nanoseconds stamp) { return std::make_shared<Nanoseconds>(stamp); }

/// An image on its way to the pairer.
struct Event {
  Nanoseconds arrival, stamp;
  bool is_depth;
};

Pairer startedPairer(const PairingConfig& config = {}) {
  Pairer pairer(config);
  pairer.setInfo(imageAt(0));
  return pairer;
}

/// A pairer, and the frames it has given.
struct PairingRun {
  explicit PairingRun(const PairingConfig& config = {}) : pairer(startedPairer(config)) {}

  void add(Nanoseconds stamp, bool is_depth) {
    if (is_depth)
      pairer.addDepth(stamp, imageAt(stamp));
    else
      pairer.addColor(stamp, imageAt(stamp));
    take(false);
  }
  void take(bool finish) {
    while (const auto frame = pairer.next(finish)) frames.push_back(*frame);
  }

  Pairer pairer;
  std::vector<Pairer::Frame> frames;
};

PairingRun runOf(std::vector<Event> events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
  PairingRun run;
  for (const Event& event : events) run.add(event.stamp, event.is_depth);
  run.take(true);
  return run;
}

/// Two streams at 30 Hz with an offset, jitter of their stamps, lost images and transport delays. Each
/// stream arrives in the order of its stamps, as over one connection.
std::vector<Event> randomStreams(std::mt19937* random, Nanoseconds offset, Nanoseconds jitter, double lost,
                                 Nanoseconds largest_delay) {
  std::uniform_int_distribution<Nanoseconds> stamp_noise(-jitter, jitter), delay(0, largest_delay);
  std::bernoulli_distribution is_lost(lost);
  std::vector<Event> events;
  for (const bool is_depth : {false, true}) {
    Nanoseconds last_arrival = 0;
    for (int i = 0; i < 300; ++i) {
      const Nanoseconds stamp = kStart + i * kFrame + (is_depth ? offset : 0) + stamp_noise(*random);
      if (is_lost(*random)) continue;
      last_arrival = std::max(last_arrival + 1, stamp + delay(*random));
      events.push_back({last_arrival, stamp, is_depth});
    }
  }
  return events;
}

TEST(FramePairer, EqualStampsMakeAFrameAtOnceWhicheverImageComesFirst) {
  PairingRun run;
  for (int i = 0; i < 30; ++i) {
    const Nanoseconds stamp = kStart + i * kFrame;
    run.add(stamp, i % 2 == 0);
    EXPECT_EQ(run.frames.size(), static_cast<std::size_t>(i));
    run.add(stamp, i % 2 != 0);
    ASSERT_EQ(run.frames.size(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(*run.frames.back().color, stamp);
    EXPECT_EQ(*run.frames.back().depth, stamp);
  }
}

TEST(FramePairer, DepthBeforeColorMakesAFrameAtOnceOnceTheRateIsKnown) {
  for (const Nanoseconds offset : {-6'000'000, 6'000'000}) {
    PairingRun run;
    for (int i = 0; i < 30; ++i) {
      run.add(kStart + i * kFrame + std::min<Nanoseconds>(0, offset), offset < 0);
      run.add(kStart + i * kFrame + std::max<Nanoseconds>(0, offset), offset >= 0);
      if (i >= 2) {
        EXPECT_EQ(run.frames.size(), static_cast<std::size_t>(i + 1)) << offset;
      }
    }
  }
}

Nanoseconds nearestTo(Nanoseconds stamp, const std::vector<Nanoseconds>& stamps) {
  return *std::min_element(stamps.begin(), stamps.end(), [stamp](Nanoseconds a, Nanoseconds b) {
    return std::llabs(a - stamp) < std::llabs(b - stamp);
  });
}

TEST(FramePairer, FramesHoldTheirInvariantsInRandomStreams) {
  std::mt19937 random(4);
  for (int round = 0; round < 200; ++round) {
    const Nanoseconds offset = std::uniform_int_distribution<Nanoseconds>(-14'000'000, 14'000'000)(random);
    const double lost = std::uniform_real_distribution<double>(0.0, 0.4)(random);
    const std::vector<Event> events = randomStreams(&random, offset, 4'000'000, lost, 60'000'000);
    const PairingRun run = runOf(events);
    std::vector<Nanoseconds> colors, depths;
    for (const Event& event : events) (event.is_depth ? depths : colors).push_back(event.stamp);
    Nanoseconds last = 0;
    std::set<Nanoseconds> used, paired;
    for (const Pairer::Frame& frame : run.frames)
      if (frame.depth) paired.insert(*frame.depth);
    int with_depth = 0;
    for (const Pairer::Frame& frame : run.frames) {
      EXPECT_GT(frame.stamp, last);
      last = frame.stamp;
      if (!frame.depth) continue;
      ++with_depth;
      EXPECT_LE(std::llabs(*frame.depth - frame.stamp), kTolerance);
      EXPECT_TRUE(used.insert(*frame.depth).second) << "a depth image in two frames";
      const Nanoseconds nearest_depth = nearestTo(frame.stamp, depths);
      EXPECT_TRUE(nearest_depth == *frame.depth || paired.count(nearest_depth) != 0) << round;
      const Nanoseconds nearest_color = nearestTo(*frame.depth, colors);
      EXPECT_TRUE(nearest_color == frame.stamp || nearestTo(nearest_color, depths) != *frame.depth) << round;
    }
    const UnpairedImages unpaired = run.pairer.unpaired();
    EXPECT_EQ(unpaired.colors_alone + static_cast<int>(run.frames.size()), static_cast<int>(colors.size()));
    EXPECT_EQ(unpaired.depths_alone + with_depth, static_cast<int>(depths.size()));
  }
}

TEST(FramePairer, TransportDelaysDoNotChangeTheFrames) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const Nanoseconds offset = std::uniform_int_distribution<Nanoseconds>(-15'000'000, 15'000'000)(random);
    std::vector<Event> events = randomStreams(&random, offset, 3'000'000, 0.1, 0);
    const PairingRun direct = runOf(events);
    std::uniform_int_distribution<Nanoseconds> delay(0, 50'000'000);
    Nanoseconds last[2] = {0, 0};
    for (Event& event : events)
      last[event.is_depth] = event.arrival =
          std::max(last[event.is_depth] + 1, event.arrival + delay(random));
    const PairingRun delayed = runOf(events);
    ASSERT_EQ(direct.frames.size(), delayed.frames.size()) << round;
    for (std::size_t i = 0; i < direct.frames.size(); ++i) {
      EXPECT_EQ(direct.frames[i].stamp, delayed.frames[i].stamp);
      ASSERT_EQ(direct.frames[i].depth != nullptr, delayed.frames[i].depth != nullptr) << round << " " << i;
      if (direct.frames[i].depth) {
        EXPECT_EQ(*direct.frames[i].depth, *delayed.frames[i].depth);
      }
    }
  }
}

TEST(FramePairer, ADroppedDepthImageCostsItsOwnFrameDepthAndNoOther) {
  for (const Nanoseconds offset : {-3'000'000, 0, 2'000'000}) {
    constexpr Nanoseconds kShort = 11'111'111;  // shorter than the tolerance
    PairingRun run;
    for (int i = 0; i < 200; ++i) {
      run.add(kStart + i * kShort, false);
      if (i != 10) run.add(kStart + i * kShort + offset, true);
    }
    run.take(true);
    ASSERT_EQ(run.frames.size(), 200u);
    int wrong = 0;
    for (const Pairer::Frame& frame : run.frames)
      wrong += !frame.depth || *frame.depth - frame.stamp != offset ? 1 : 0;
    EXPECT_EQ(wrong, 1) << "offset " << offset;
  }
}

TEST(FramePairer, RepeatedAndLateImagesAreDroppedAndCounted) {
  PairingRun run;
  for (int i = 0; i < 20; ++i) {
    for (int copies = 0; copies < (i % 5 == 0 ? 2 : 1); ++copies) {
      run.add(kStart + i * kFrame, false);
      run.add(kStart + i * kFrame, true);
    }
    if (i % 10 == 9) {
      EXPECT_EQ(run.pairer.addColor(kStart + (i - 2) * kFrame + 1, imageAt(0)).kind, StampVerdict::kLate);
      EXPECT_EQ(run.pairer.addDepth(kStart + (i - 2) * kFrame + 1, imageAt(0)).kind, StampVerdict::kLate);
      EXPECT_EQ(run.pairer.addDepth(0, imageAt(0)).kind, StampVerdict::kUnstamped);
    }
  }
  EXPECT_EQ(run.frames.size(), 20u);
  const UnpairedImages unpaired = run.pairer.unpaired();
  EXPECT_EQ(unpaired.colors_repeated, 4);
  EXPECT_EQ(unpaired.depths_repeated, 4);
  EXPECT_EQ(unpaired.colors_late, 2);
  EXPECT_EQ(unpaired.depths_late, 2);
  EXPECT_EQ(unpaired.unstamped, 2);
}

TEST(FramePairer, ARecordingThatStartsAgainGivesTheSameFramesAgain) {
  for (const bool depth_first : {false, true}) {
    PairingRun run;
    for (int pass = 0; pass < 3; ++pass) {
      for (int i = 0; i < 100; ++i) {
        run.add(kStart + i * kFrame, depth_first);
        run.add(kStart + i * kFrame, !depth_first);
      }
    }
    ASSERT_EQ(run.frames.size(), 300u);
    for (int i = 0; i < 300; ++i) {
      EXPECT_EQ(run.frames[i].stamp, kStart + i % 100 * kFrame);
      EXPECT_EQ(run.frames[i].pass, i / 100);
      EXPECT_TRUE(run.frames[i].depth);
    }
  }
}

TEST(FramePairer, AnImageLeftAtTheEndOfAPassDoesNotHoldTheNextPassUp) {
  for (const Nanoseconds offset : {Nanoseconds{0}, Nanoseconds{12'000'000}}) {
    PairingRun run;
    for (int pass = 0; pass < 3; ++pass) {
      for (int i = 0; i < 60; ++i) {
        run.add(kStart + i * kFrame, false);
        if (i < 59) run.add(kStart + i * kFrame + offset, true);
      }
      // Of each pass the last colour image waits, and with an offset the pair before it may.
      EXPECT_GE(run.frames.size(), static_cast<std::size_t>((pass + 1) * 59 - 1)) << offset;
    }
    int with_depth = 0;
    for (const Pairer::Frame& frame : run.frames) with_depth += frame.depth ? 1 : 0;
    EXPECT_GE(with_depth, 3 * 59 - 1) << offset;
  }
}

TEST(FramePairer, EveryColorImageMakesAFrameWhereItIsAskedFor) {
  PairingConfig config;
  config.every_color = true;
  PairingRun run(config);
  for (int i = 0; i < 100; ++i) {
    run.add(kStart + i * kFrame, false);
    if (i % 50 == 10) run.add(kStart + i * kFrame, true);
  }
  run.take(true);
  EXPECT_EQ(run.frames.size(), 100u);
}

TEST(FramePairer, OneStampFarAheadCostsItsOwnFrameAlone) {
  for (const bool is_depth : {false, true}) {
    PairingRun run;
    for (int i = 0; i < 60; ++i) {
      const Nanoseconds ahead = i == 30 ? 2'000'000'000 : 0;
      run.add(kStart + i * kFrame + (is_depth ? 0 : ahead), false);
      run.add(kStart + i * kFrame + (is_depth ? ahead : 0), true);
    }
    run.take(true);
    int with_depth = 0;
    for (const Pairer::Frame& frame : run.frames) with_depth += frame.depth ? 1 : 0;
    EXPECT_EQ(with_depth, 59) << is_depth;
    EXPECT_EQ(run.pairer.unpaired().outliers, 1);
  }
}

TEST(FramePairer, FramesWithAnyOddStampAreDroppedAndNoOthers) {
  std::mt19937 random(9);
  std::uniform_int_distribution<Nanoseconds> any(0, kLatestTime), fate(0, 19);
  for (int round = 0; round < 50; ++round) {
    PairingRun run;
    int odd_frames = 0;
    bool was_odd = true;  // the first frame is good
    for (int i = 0; i < 200; ++i) {
      const bool odd = !was_odd && fate(random) == 0;
      const Nanoseconds stamp = kStart + i * kFrame,
                        shown = round % 2 == 0 ? stamp + 2'000'000'000 : any(random);
      odd_frames += odd ? 1 : 0;
      was_odd = odd || i == 0;
      run.add(odd ? shown : stamp, false);
      run.add(odd ? shown : stamp, true);
    }
    run.take(true);
    EXPECT_EQ(static_cast<int>(run.frames.size()), 200 - odd_frames);
    for (const Pairer::Frame& frame : run.frames) {
      EXPECT_TRUE(frame.depth);
      EXPECT_EQ(frame.pass, 0);
    }
  }
}

TEST(FramePairer, APauseOfBothStreamsCostsNoFrame) {
  PairingRun run;
  for (int i = 0; i < 60; ++i) {
    const Nanoseconds stamp = kStart + i * kFrame + i / 20 * 3'000'000'000;
    run.add(stamp, false);
    run.add(stamp, true);
  }
  ASSERT_EQ(run.frames.size(), 60u);
  for (const Pairer::Frame& frame : run.frames) EXPECT_EQ(frame.pass, 0);
}

TEST(FramePairer, AStreamWithoutDepthOrWithAnotherClockMakesNoFrame) {
  for (const Nanoseconds apart : {Nanoseconds{116'000'000}, Nanoseconds{100'016'000'000}}) {
    PairingRun run;
    std::vector<std::weak_ptr<Nanoseconds>> images;
    for (int i = 0; i < 500; ++i) {
      const Image color = imageAt(i), depth = imageAt(i);
      images.insert(images.end(), {color, depth});
      run.pairer.addColor(kStart + apart + i * kFrame, color);
      run.pairer.addDepth(kStart + i * kFrame, depth);
      run.take(false);
    }
    EXPECT_TRUE(run.frames.empty()) << apart;
    const auto alive =
        std::count_if(images.begin(), images.end(), [](const auto& image) { return !image.expired(); });
    EXPECT_LE(alive, 2 * PairingConfig().queue_size);
  }
  PairingRun silent;
  for (int i = 0; i < 100; ++i) silent.add(kStart + i * kFrame, false);
  EXPECT_TRUE(silent.frames.empty());
}

TEST(FramePairer, DepthAtHalfTheRateGivesEveryColorImageAFrame) {
  PairingRun run;
  for (int i = 0; i < 100; ++i) {
    run.add(kStart + i * kFrame, false);
    if (i % 2 == 0) run.add(kStart + i * kFrame, true);
  }
  EXPECT_GE(run.frames.size(), 99u);
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    EXPECT_EQ(run.frames[i].depth != nullptr, i % 2 == 0) << i;
}

TEST(FramePairer, FramesWaitForTheFirstInfo) {
  Pairer pairer{PairingConfig()};
  for (int i = 0; i < 3; ++i) {
    pairer.addColor(kStart + i * kFrame, imageAt(i));
    pairer.addDepth(kStart + i * kFrame, imageAt(i));
    EXPECT_FALSE(pairer.next());
  }
  pairer.setInfo(imageAt(7));
  for (int i = 0; i < 3; ++i) {
    const auto frame = pairer.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(*frame->info, 7);
  }
}

TEST(FramePairer, ExactPairingTakesEqualStampsOnly) {
  PairingConfig config;
  config.exact = true;
  PairingRun run(config);
  for (int i = 0; i < 20; ++i) {
    run.add(kStart + i * kFrame, false);
    run.add(kStart + i * kFrame + (i % 2 == 0 ? 0 : 1), true);
  }
  for (const Pairer::Frame& frame : run.frames)
    EXPECT_EQ(frame.depth != nullptr, (frame.stamp - kStart) / kFrame % 2 == 0);
}

TEST(FramePairer, ParametersOutOfRangeAreRefused) {
  for (const char* text : {"{sync: near}", "{sync_tolerance_s: 0}", "{queue_size: 0}"}) {
    Parameters parameters(YAML::Load(text), "camera_ingest/");
    EXPECT_THROW(readPairingConfig(parameters), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>
#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "camera/pairing_run.h"
#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody {
namespace {

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
    EXPECT_LE(alive, static_cast<int>(2 * kMostWaiting));
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
  config.tolerance = 0;
  PairingRun run(config);
  for (int i = 0; i < 20; ++i) {
    run.add(kStart + i * kFrame, false);
    run.add(kStart + i * kFrame + (i % 2 == 0 ? 0 : 1), true);
  }
  for (const Pairer::Frame& frame : run.frames)
    EXPECT_EQ(frame.depth != nullptr, (frame.stamp - kStart) / kFrame % 2 == 0);
}

TEST(FramePairer, ParametersOutOfRangeAreRefused) {
  for (const char* text : {"{sync_tolerance_s: -1}", "{sync_tolerance_s: 2}"}) {
    Parameters parameters(YAML::Load(text), "camera_ingest/");
    EXPECT_THROW(pairingParameters().read(parameters), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace softbody

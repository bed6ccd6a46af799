#include "camera/frame_assembler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace softbody {
namespace {

using Message = std::shared_ptr<int>;
using Assembler = FrameAssembler<Message, Message>;

/// @param part 0: colour, 1: depth, 2: info.
std::optional<Assembler::Frame> add(Assembler* assembler, int part, Nanoseconds stamp) {
  const auto message = std::make_shared<int>(part);
  if (part == 0) return assembler->addColor(stamp, message);
  return part == 1 ? assembler->addDepth(stamp, message) : assembler->addInfo(stamp, message);
}

TEST(FrameAssembler, InAnyOrderTheThirdMessageMakesTheFrame) {
  std::mt19937 random(1);
  Assembler assembler;
  std::vector<int> parts{0, 1, 2};
  for (Nanoseconds stamp = 1; stamp < 200; ++stamp) {
    std::shuffle(parts.begin(), parts.end(), random);
    EXPECT_FALSE(add(&assembler, parts[0], stamp));
    EXPECT_FALSE(add(&assembler, parts[1], stamp));
    const auto frame = add(&assembler, parts[2], stamp);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->stamp, stamp);
    EXPECT_EQ(*frame->color + 10 * *frame->depth + 100 * *frame->info, 210);
  }
}

TEST(FrameAssembler, StampsFarAheadHoldNothingUp) {
  Assembler assembler;
  for (int odd = 0; odd < 50; ++odd) EXPECT_FALSE(add(&assembler, 0, 4'000'000'000'000'000'000 + odd));
  for (Nanoseconds stamp = 1; stamp < 50; ++stamp) {
    add(&assembler, 0, stamp);
    add(&assembler, 1, stamp);
    EXPECT_TRUE(add(&assembler, 2, stamp)) << stamp;
  }
}

TEST(FrameAssembler, AnIncompleteFrameIsGivenUpForALaterOne) {
  Assembler assembler;
  add(&assembler, 0, 1);
  add(&assembler, 1, 1);
  for (int part = 0; part < 3; ++part) EXPECT_EQ(add(&assembler, part, 2).has_value(), part == 2);
  EXPECT_FALSE(add(&assembler, 2, 1));
}

}  // namespace
}  // namespace softbody

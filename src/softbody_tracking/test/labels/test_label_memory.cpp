#include "labels/label_memory.h"

#include <gtest/gtest.h>

#include "labels/label_cells.h"

namespace softbody {
namespace {

constexpr int kReachPx = 24;
constexpr float kDepth = 0.5f;  // [m]

/// Of cells without anything in sight.
LabelMemory emptyMemory(int size_px = 4) {
  return {size_px, {100, 60}, cv::Mat1f(20, 30, 0.0f), cv::Mat1f(20, 30, 0.0f)};
}

cv::Point centerOf(const LabelMemory& memory, const cv::Point& place) {
  return memory.origin + memory.size_px * place + cv::Point(memory.size_px, memory.size_px) / 2;
}

TEST(LabelMemory, SaysNothingWithoutCells) {
  EXPECT_EQ(LabelRecall(LabelMemory(), kReachPx).logOdds({10, 10}, kDepth), 0.0);
  EXPECT_EQ(LabelRecall(emptyMemory(), kReachPx).logOdds({150, 90}, kDepth), 0.0);
}

TEST(LabelMemory, KnowsWhatWasNear) {
  for (const float body : {0.0f, 1.0f}) {
    LabelMemory memory = emptyMemory();
    const cv::Rect cells(10, 8, 6, 6);
    memory.depth(cells) = kDepth;
    memory.body(cells) = body;
    const double sign = body > 0.5f ? 1.0 : -1.0;
    const auto said = [&](const cv::Point& place, float depth) {
      return sign * LabelRecall(memory, kReachPx).logOdds(centerOf(memory, place), depth);
    };
    EXPECT_GT(said({12, 10}, kDepth), 1.0);
    EXPECT_GT(said({9, 10}, kDepth), 0.3) << "beside them";
    EXPECT_LT(said({9, 10}, kDepth), said({12, 10}, kDepth));
    EXPECT_GT(said({12, 10}, kDepth + 0.008f), 0.3);
    EXPECT_LT(said({12, 10}, kDepth + 0.008f), said({12, 10}, kDepth));
    EXPECT_EQ(said({12, 10}, kDepth + 0.02f), 0.0) << "another surface";
    EXPECT_EQ(said({12, 10}, kDepth - 0.02f), 0.0);
    EXPECT_EQ(said({24, 10}, kDepth), 0.0) << "nothing moves that far";
  }
}

TEST(LabelMemory, BetweenBothItIsUnsure) {
  LabelMemory memory = emptyMemory();
  memory.depth = kDepth;
  memory.body.colRange(0, 15) = 1.0f;
  EXPECT_GT(LabelRecall(memory, kReachPx).logOdds(centerOf(memory, {10, 10}), kDepth), 1.0);
  EXPECT_LT(LabelRecall(memory, kReachPx).logOdds(centerOf(memory, {19, 10}), kDepth), -1.0);
  EXPECT_LT(std::abs(LabelRecall(memory, kReachPx).logOdds(centerOf(memory, {14, 10}), kDepth)), 0.7);
}

/// Of small cells only some are looked at: always the one in the same place, also at the border.
TEST(LabelMemory, KnowsEveryCellItself) {
  for (const int size_px : {1, 2, 4, 10, 30}) {
    for (const cv::Point& place : {cv::Point(0, 0), cv::Point(1, 1), cv::Point(2, 3), cv::Point(15, 10),
                                   cv::Point(28, 18), cv::Point(29, 19)}) {
      LabelMemory memory = emptyMemory(size_px);
      memory.depth(place) = kDepth;
      memory.body(place) = 1.0f;
      EXPECT_NEAR(LabelRecall(memory, kReachPx).logOdds(centerOf(memory, place), kDepth), std::log(3.0), 1e-6)
          << size_px << " " << place;
    }
  }
}

/// In a mirrored scene the memory says the same.
TEST(LabelMemory, IsTheSameFromAllSides) {
  for (const int size_px : {1, 2, 5}) {
    LabelMemory memory = emptyMemory(size_px), mirrored = emptyMemory(size_px);
    cv::theRNG().state = 7;
    cv::randu(memory.depth, kDepth - 0.01f, kDepth + 0.01f);
    cv::randu(memory.body, 0.0f, 1.0f);
    cv::flip(memory.depth, mirrored.depth, -1);
    cv::flip(memory.body, mirrored.body, -1);
    for (cv::Point place(-3, -3); place.y < memory.depth.rows + 3; ++place.y) {
      for (place.x = -3; place.x < memory.depth.cols + 3; ++place.x) {
        const cv::Point opposite = cv::Point(memory.depth.cols - 1, memory.depth.rows - 1) - place;
        ASSERT_NEAR(LabelRecall(memory, kReachPx).logOdds(centerOf(memory, place), kDepth),
                    LabelRecall(mirrored, kReachPx).logOdds(centerOf(mirrored, opposite), kDepth), 1e-4)
            << size_px << " " << place;
      }
    }
  }
}

TEST(LabelMemory, KeepsTheCellsInFront) {
  LabelCells cells;
  cells.size_px = 4;
  cells.origin = {-8, 12};
  cells.grid = {2, 1};
  cells.cells.resize(2);
  LabelCell& front = cells.at({1, 0});
  front.shows_front = true;
  front.predicted = 0.5f, front.difference = -0.02f, front.body = 0.25f;
  cells.at({0, 0}).predicted = 0.5f;
  const LabelMemory memory = memoryOf(cells);
  EXPECT_EQ(memory.size_px, 4);
  EXPECT_EQ(memory.origin, cv::Point(-8, 12));
  EXPECT_FLOAT_EQ(memory.depth(0, 1), 0.48f);
  EXPECT_FLOAT_EQ(memory.body(0, 1), 0.25f);
  EXPECT_EQ(memory.depth(0, 0), 0.0f);
}

}  // namespace
}  // namespace softbody

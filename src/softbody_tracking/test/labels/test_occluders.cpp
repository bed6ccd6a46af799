#include "labels/occluders.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace softbody {
namespace {

const cv::Size kGrid(14, 11);
constexpr double kFocal = 615.0;  // [px]
const LabelMemory kNone;

/// A surface that faces the camera, half a metre away, with one sample in every cell.
struct FlatSurface {
  FlatSurface() {
    cells.size_px = samples.block_px = 6;
    cells.grid = kGrid;
    for (int i = 0; i < kGrid.area(); ++i) {
      SurfaceSample sample;
      sample.position = Eigen::Vector3d(0.0, 0.0, 0.5);
      sample.normal = -Eigen::Vector3d::UnitZ();
      samples.samples.push_back(sample);
      LabelCell cell;
      cell.sample = i, cell.shows_front = true, cell.predicted = 0.5f, cell.body = 1.0f;
      cells.cells.push_back(cell);
    }
  }
  void tell(double error_m = 0.0) { tellOccluders(samples, {kNone, kFocal, error_m, 24}, &cells); }
  void setDifference(const cv::Rect& places, float difference_m) {
    for (int y = places.y; y < places.br().y; ++y)
      for (int x = places.x; x < places.br().x; ++x) cells.at({x, y}).difference = difference_m;
  }
  /// Smallest and largest probability of the body.
  std::pair<float, float> range(const cv::Rect& places) const {
    std::pair<float, float> range(1.0f, 0.0f);
    for (int y = places.y; y < places.br().y; ++y) {
      for (int x = places.x; x < places.br().x; ++x) {
        range.first = std::min(range.first, cells.at({x, y}).body);
        range.second = std::max(range.second, cells.at({x, y}).body);
      }
    }
    return range;
  }

  SurfaceSamples samples;
  LabelCells cells;
};

const cv::Rect kAll({}, kGrid), kBeforeCells(4, 3, 5, 4);

TEST(Occluders, AreBeforeTheBody) {
  for (const float before : {0.015f, 0.025f, 0.1f, 0.3f, 0.5f}) {
    FlatSurface surface;
    surface.setDifference(kBeforeCells, -before);
    surface.tell();
    EXPECT_LT(surface.range(kBeforeCells).second, 0.1f) << before;
    EXPECT_GT(surface.range(cv::Rect(10, 0, 4, 11)).first, 0.9f) << before;
  }
}

TEST(Occluders, AreNotTheBodyThatMovedAsAWhole) {
  for (const float farther : {-0.02f, -0.005f, 0.0f, 0.009f}) {
    FlatSurface surface;
    surface.setDifference(kAll, farther);
    surface.tell();
    EXPECT_GT(surface.range(kAll).first, 0.9f) << farther;
    surface.setDifference(kBeforeCells, farther - 0.015f);
    surface.tell();
    EXPECT_LT(surface.range(kBeforeCells).second, 0.1f) << farther;
  }
}

/// The smaller of two pieces.
TEST(Occluders, AreNotAPieceThatMoved) {
  FlatSurface surface;
  for (cv::Point place(10, 0); place.x < kGrid.width; ++place.x)
    for (place.y = 0; place.y < kGrid.height; ++place.y)
      surface.samples.samples[static_cast<std::size_t>(surface.cells.at(place).sample)].piece = 1;
  surface.setDifference({10, 0, 4, 11}, -0.015f);
  surface.tell();
  EXPECT_GT(surface.range(kAll).first, 0.9f);
}

/// The distance along the normal counts.
TEST(Occluders, AreNotASteepSideThatMovedALittle) {
  const auto hand = [](double steepness) {
    FlatSurface surface;
    const Eigen::Vector3d normal(std::sin(steepness), 0.0, -std::cos(steepness));
    for (cv::Point place = kBeforeCells.tl(); place.y < kBeforeCells.br().y; ++place.y)
      for (place.x = kBeforeCells.x; place.x < kBeforeCells.br().x; ++place.x)
        surface.samples.samples[static_cast<std::size_t>(surface.cells.at(place).sample)].normal = normal;
    surface.setDifference(kBeforeCells, -0.01f);
    surface.tell();
    return surface.range(kBeforeCells);
  };
  EXPECT_LT(hand(0.0).second, 0.2f);
  EXPECT_GT(hand(1.2).first, 0.8f);
}

/// If the body is nowhere as predicted, a difference says less.
TEST(Occluders, AreMeasuredByTheDeviationOfTheBody) {
  const auto leastBody = [](double deviation_m) {
    FlatSurface surface;
    std::mt19937 random(6);
    std::normal_distribution<double> gauss(0.0, deviation_m);
    for (LabelCell& cell : surface.cells.cells) cell.difference = static_cast<float>(gauss(random));
    surface.setDifference(kBeforeCells, -0.01f);
    surface.tell();
    return surface.range(kBeforeCells).second;
  };
  EXPECT_LT(leastBody(0.0), 0.2f);
  EXPECT_GT(leastBody(0.01), 0.8f);
}

TEST(Occluders, AreLikelierFarBesideThePrediction) {
  const auto body = [](int distance, double error_m) {
    FlatSurface surface;
    surface.cells.at({13, 5}).distance = distance;
    for (const cv::Point& beside : {cv::Point(12, 5), cv::Point(13, 4), cv::Point(13, 6)})
      surface.cells.at(beside).shows_front = false;
    surface.tell(error_m);
    return surface.cells.at({13, 5}).body;
  };
  for (const double error_m : {0.0, 0.005})
    for (int distance = 0; distance < 4; ++distance)
      EXPECT_LT(body(distance + 1, error_m), body(distance, error_m)) << distance << " " << error_m;
  EXPECT_GT(body(3, 0.005), body(3, 0.0)) << "predictions were off";
}

/// One noisy cell is what its neighbours are; one behind a step is not.
TEST(Occluders, AreAlikeWhereNoStepIs) {
  const auto middle = [](float color_odds, float step_m) {
    FlatSurface surface;
    surface.cells.at({6, 5}).color_odds = color_odds;
    surface.cells.at({6, 5}).difference = -step_m;
    surface.tell();
    return surface.cells.at({6, 5}).body;
  };
  EXPECT_GT(middle(-3.0f, 0.0f), 0.9f);
  EXPECT_LT(middle(-3.0f, 0.009f), 0.1f);
}

/// The same field with its cells in another order.
FlatSurface mirrored(const FlatSurface& surface, const std::function<cv::Point(const cv::Point&)>& to) {
  FlatSurface result = surface;
  for (cv::Point place(0, 0); place.y < kGrid.height; ++place.y)
    for (place.x = 0; place.x < kGrid.width; ++place.x) result.cells.at(to(place)) = surface.cells.at(place);
  return result;
}

TEST(Occluders, DoNotDependOnTheOrder) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  FlatSurface surface;
  for (LabelCell& cell : surface.cells.cells) {
    cell.shows_front = uniform(random) > -0.8f;
    cell.difference = 0.006f * uniform(random);
    cell.color_odds = 2.0f * uniform(random);
    cell.body = uniform(random) > -0.6f ? 1.0f : 0.0f;
  }
  for (const bool x : {true, false}) {
    const auto to = [&](const cv::Point& place) {
      return x ? cv::Point(kGrid.width - 1 - place.x, place.y)
               : cv::Point(place.x, kGrid.height - 1 - place.y);
    };
    FlatSurface other = mirrored(surface, to), told = surface;
    other.tell();
    told.tell();
    EXPECT_GT(told.range(kAll).second - told.range(kAll).first, 0.4f);
    for (cv::Point place(0, 0); place.y < kGrid.height; ++place.y)
      for (place.x = 0; place.x < kGrid.width; ++place.x)
        EXPECT_NEAR(told.cells.at(place).body, other.cells.at(to(place)).body, 1e-5) << place;
  }
}

}  // namespace
}  // namespace softbody

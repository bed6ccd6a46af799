#include <test_support/gtest.h>

#include "fixtures/tracked_box.h"
#include "tracker/backoff.h"
#include "tracker/frame_observer.h"

namespace softbody {
namespace {

TEST(CutBody, FollowsThePiecesOfABodyThatIsCut) {
  TrackedBox tracked;
  TrackingResult result;
  for (int i = 0; i < 5; ++i) result = tracked.show(posedBox(tracked.box()));
  const auto features_before = result.status.features_tracked;
  tracked.cut(posedBox(cutBox(tracked.box())));
  const Eigen::Index whole = makeBox().volume.rest_vertices.rows();
  for (int i = 1; i <= 10; ++i) {
    const TetTopology& volume = tracked.box().volume;
    Points truth = posedBox(tracked.box());
    for (Eigen::Index v = 0; v < truth.rows(); ++v) {
      const bool right = v >= whole || volume.rest_vertices(v, 0) > 1e-9;
      truth.row(v) += (right ? 1.0 : -1.0) * i * 0.002 * Eigen::RowVector3d(1.0, 0.2, -0.5);
    }
    result = tracked.show(truth);
    EXPECT_FALSE(result.targets.reset);
    EXPECT_EQ(result.targets.revision, 1u);
    EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
    EXPECT_GT(result.status.features_tracked, 0.4 * features_before) << "the bound ones are still known";
    // A block on the rim of the gap may show the other piece.
    EXPECT_LT(tracked.shareOff(result, truth, 0.002), 0.01);
  }
}

TEST(CutBody, HoldsAPieceThatDoesNotShowUntilItDoes) {
  TrackedBox tracked;
  for (int i = 0; i < 5; ++i) tracked.show(posedBox(tracked.box()));
  tracked.cut(posedBox(cutBox(tracked.box())));
  const Points rest = posedBox(tracked.box());
  EXPECT_EQ(tracked.show(rest).status.state, TrackingState::kTracking);
  const TetTopology& volume = tracked.box().volume;
  const int middle = cvRound(tracked.frame().camera.project(boxPose().translation()).x());
  const cv::Rect right(middle - 20, 0, 640 - middle + 20, 480);
  TrackingResult result;
  for (int i = 0; i < 12; ++i) {
    result = tracked.show(rest, [&](RgbdFrame* frame) { frame->depth(right).setTo(0.3f); });
  }
  EXPECT_EQ(result.status.state, TrackingState::kDegraded);
  EXPECT_TRUE(says(result.status.reason, "almost hidden, at the last pose: piece 1 of 2"));
  int held = 0;
  for (const Target& target : result.targets.targets) {
    if (target.kind != TargetKind::kPrior) continue;
    EXPECT_LT((target.position - positionOf(target.place, rest, volume.tets)).norm(), 1e-9);
    ++held;
  }
  EXPECT_GT(held, volume.rest_vertices.rows() / 3);
  result = tracked.show(rest);
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_LT(tracked.shareOff(result, rest, 0.002), 0.01);
}

/// Number of targets of each kind.
int countOf(TargetKind kind, const TrackingResult& result) {
  const std::vector<Target>& targets = result.targets.targets;
  return static_cast<int>(std::count_if(targets.begin(), targets.end(),
                                        [&](const Target& target) { return target.kind == kind; }));
}

/// Covers the frame except a square around the middle of the cut. @param side of the square [px].
void coverAround(int side, RgbdFrame* frame) {
  const cv::Mat1f depth = frame->depth.clone();
  const Eigen::Vector2d middle = frame->camera.project(boxPose().translation());
  const cv::Rect left_open(cvRound(middle.x()) - side / 2, cvRound(middle.y()) - side / 2, side, side);
  frame->depth.setTo(0.3f);
  if (side > 0) depth(left_open).copyTo(frame->depth(left_open));
}

TEST(CutBody, IsHeldIfNoPieceIsWellVisible) {
  TrackedBox tracked;
  for (int i = 0; i < 5; ++i) tracked.show(posedBox(tracked.box()));
  tracked.cut(posedBox(cutBox(tracked.box())));
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  TrackingResult result;
  for (int i = 0; i < 20; ++i) {
    result = tracked.show(rest, [](RgbdFrame* frame) { coverAround(24, frame); });
    EXPECT_EQ(result.status.state, TrackingState::kDegraded) << "some blocks agree: it is not lost";
    EXPECT_EQ(countOf(TargetKind::kPrior, result), rest.rows());
    EXPECT_EQ(countOf(TargetKind::kDepth, result) + countOf(TargetKind::kFeature, result), 0);
    EXPECT_EQ(tracked.worstTarget(result, rest, TargetKind::kPrior), 0.0);
  }
  result = tracked.show(rest);
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_EQ(countOf(TargetKind::kPrior, result), 0);
}

TEST(CutBody, IsLostIfNothingOfItIsVisible) {
  TrackedBox tracked;
  for (int i = 0; i < 5; ++i) tracked.show(posedBox(tracked.box()));
  tracked.cut(posedBox(cutBox(tracked.box())));
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  const TrackingResult result = tracked.show(rest, [](RgbdFrame* frame) { coverAround(0, frame); });
  EXPECT_EQ(result.status.state, TrackingState::kLost);
  EXPECT_TRUE(result.targets.targets.empty());
  EXPECT_TRUE(tracked.tracksWithin(3, rest));
}

/// Moves one piece [m].
class PartedCutBody : public ::testing::TestWithParam<double> {};

/// Each piece is found in its new place, although the whole body is recognised as before the cut.
TEST_P(PartedCutBody, IsFoundAgainPieceByPieceAfterItWasLost) {
  TrackedBox tracked;
  for (int i = 0; i < 5; ++i) tracked.show(posedBox(tracked.box()));
  tracked.cut(posedBox(cutBox(tracked.box())));
  const Eigen::Index whole = makeBox().volume.rest_vertices.rows();
  const auto parted = [&](double by) {
    const Points rest = posedBox(tracked.box());
    const Eigen::Isometry3d turn = Eigen::Translation3d(by, 0.0, 0.0) *
                                   Eigen::Translation3d(boxPose().translation()) *
                                   Eigen::AngleAxisd(5.0 * by, Eigen::Vector3d::UnitZ()) *
                                   Eigen::Translation3d(-boxPose().translation());
    Points vertices = rest;
    const Points turned = transformed(rest, turn);
    for (Eigen::Index v = 0; v < rest.rows(); ++v)
      if (v >= whole || tracked.box().volume.rest_vertices(v, 0) > 1e-9) vertices.row(v) = turned.row(v);
    return vertices;
  };
  for (int i = 0; 0.005 * i < GetParam(); ++i) tracked.show(parted(0.005 * i));
  const Points truth = parted(GetParam());
  EXPECT_EQ(tracked.show(truth).status.state, TrackingState::kTracking);
  TrackingResult result;
  for (int i = 0; i < 12; ++i) result = tracked.show(truth, [](RgbdFrame* frame) { coverAround(0, frame); });
  ASSERT_EQ(result.status.state, TrackingState::kRecovering);
  result = tracked.show(truth);
  EXPECT_TRUE(result.targets.reset);
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_GT(result.targets.targets.size(), 1000u);
  EXPECT_LT(tracked.shareOff(result, truth, 0.002), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Gaps, PartedCutBody, ::testing::Values(0.05, 0.08));

/// The frame with the stamp after the last one's.
RgbdFrame next(RgbdFrame frame) {
  static Nanoseconds stamp = 0;
  frame.stamp = stamp += kFrameInterval;
  return frame;
}

class CutObserver : public ::testing::Test {
 protected:
  CutObserver() : observer_({}, box_.volume, box_.surface) {
    observer_.learnFeatures(frame_, observer_.observe(next(frame_), rest_));
  }
  Points parted(double gap) const {
    Points vertices = rest_;
    for (const int v : observer_.model().pieces()[1]) vertices(v, 0) += gap;
    return vertices;
  }

  BoxBody box_ = cutBox(makeBox());
  Points rest_ = posedBox(box_);
  RgbdFrame frame_ = renderFrame(box_, rest_, 1);
  FrameObserver observer_;
};

TEST_F(CutObserver, ExpectsNoFeaturesOfAnAlmostHiddenPiece) {
  const Observation whole = observer_.observe(next(frame_), rest_).seen;
  ASSERT_GT(whole.expected_features, 200);
  EXPECT_EQ(whole.matched_features, static_cast<int>(whole.matches.size()));
  const int middle = cvRound(frame_.camera.project(boxPose().translation()).x());
  frame_.depth(cv::Rect(middle - 20, 0, 640 - middle + 20, 480)).setTo(0.0f);
  for (int i = 0; i < 2; ++i) {
    const Observation seen = observer_.observe(next(frame_), rest_).seen;
    ASSERT_EQ(seen.visibility[1], Visibility::kAlmostHidden);
    EXPECT_LT(seen.expected_features, 0.7 * whole.expected_features);
    EXPECT_GT(seen.matched_features, 0.8 * seen.expected_features) << "found wherever expected";
  }
}

/// The right piece comes back beyond the window of alignment, and the left one loses some texture. Few of all
/// features are found, but enough of the left piece.
TEST_F(CutObserver, FindsAPieceAtOnceThatComesBack) {
  const int middle = cvRound(frame_.camera.project(boxPose().translation()).x());
  RgbdFrame covered = frame_;
  covered.depth = frame_.depth.clone();
  covered.depth(cv::Rect(middle - 20, 0, 640 - middle + 20, 480)).setTo(0.3f);
  RgbdFrame back = renderFrame(box_, parted(0.035), 2);
  back.color(cv::Rect(0, 0, middle - 80, 480)).setTo(cv::Vec3b(35, 90, 140));
  const auto foundOnRight = [&](const RgbdFrame& before) {
    FrameObserver observer({}, box_.volume, box_.surface);
    observer.learnFeatures(frame_, observer.observe(next(frame_), rest_));
    observer.observe(next(before), rest_);
    return matchesOn({false, true}, observer.observe(next(back), rest_).seen.matches);
  };
  EXPECT_GT(foundOnRight(frame_), 50);
  EXPECT_GT(foundOnRight(covered), 50) << "it was held";
}

/// Shows the left piece only, then both. The right one moved along x meanwhile; the prediction keeps its old
/// place. It must be found within a few frames.
void findsAgain(FrameObserver* observer, const BoxBody& box, const Points& predicted, double moved) {
  const auto frameOf = [&](const Points& vertices) { return renderFrame(box, vertices, 1); };
  RgbdFrame covered = frameOf(predicted);
  const int middle = cvRound(covered.camera.project(boxPose().translation()).x());
  covered.depth(cv::Rect(middle - 20, 0, 640 - middle + 20, 480)).setTo(0.3f);
  for (int i = 0; i < 5; ++i) observer->observe(next(covered), predicted);
  Points truth = predicted;
  for (const int v : observer->model().pieces()[1]) truth(v, 0) += moved;
  const RgbdFrame back = frameOf(truth);
  ObservedBody found = observer->observe(next(back), predicted);
  int frames = 1;
  for (; matchesOn({false, true}, found.seen.matches) < 50 && frames < 20; ++frames)
    found = observer->observe(next(back), predicted);
  EXPECT_LE(frames, 10);
  EXPECT_LT((found.surface.volumeVertices() - truth).rowwise().norm().maxCoeff(), 0.003);
}

TEST_F(CutObserver, FindsAPieceAgainThatMovedUnseen) { findsAgain(&observer_, box_, rest_, 0.08); }

/// The tolerance of recognition depends on the piece's own size.
TEST_F(CutObserver, FindsAPieceAgainHoweverFarOffTheOtherIs) {
  Points far = rest_;
  for (const int v : observer_.model().pieces()[0]) far(v, 0) -= 2.0;
  findsAgain(&observer_, box_, far, 0.08);
}

/// In another light the features are not found; a search of the whole image in every frame would gain
/// nothing.
TEST_F(CutObserver, SearchesSeldomForAPieceWhoseFeaturesHaveLongBeenMissing) {
  const int middle = cvRound(frame_.camera.project(boxPose().translation()).x());
  RgbdFrame dull = frame_;
  dull.color = frame_.color.clone();
  const cv::Rect right(middle, 0, 640 - middle, 480), all(0, 0, 640, 480);
  const auto framesToFind = [&](int dull_frames, const cv::Rect& part, double moved) {
    const RgbdFrame back = renderFrame(box_, parted(moved), 2);
    dull.color(part).setTo(cv::Vec3b(35, 90, 140));
    FrameObserver observer({}, box_.volume, box_.surface);
    observer.learnFeatures(frame_, observer.observe(next(frame_), rest_));
    for (int i = 0; i < dull_frames; ++i) observer.observe(next(dull), rest_);
    int frames = 1;
    while (matchesOn({false, true}, observer.observe(next(back), rest_).seen.matches) < 50 && frames < 20)
      ++frames;
    return frames;
  };
  EXPECT_EQ(framesToFind(0, right, 0.08), 1);
  const int after_long = framesToFind(15, right, 0.08);
  EXPECT_GT(after_long, 1);
  EXPECT_LE(after_long, kLongestGap / kFrameInterval + 2);
  EXPECT_EQ(framesToFind(0, all, 0.035), 1);
  EXPECT_EQ(framesToFind(15, all, 0.035), 2) << "once the left piece is found where it was";
}

/// The right piece jumps. A scrap with the left one's texture appears elsewhere too, but the left one's other
/// features are not there.
TEST_F(CutObserver, MovesAPieceOnlyToWhereItsOwnFeaturesAre) {
  const Points truth = parted(0.08);
  RgbdFrame frame = renderFrame(box_, truth, 2);
  const int middle = cvRound(frame.camera.project(boxPose().translation()).x());
  const cv::Rect scrap(middle - 110, 180, 56, 56), shown_at = scrap + cv::Point(-60, 160);
  const cv::Mat3b color = frame.color(scrap).clone();
  const cv::Mat1f depth = frame.depth(scrap).clone();
  frame.color(cv::Rect(0, 0, middle, 480)).setTo(cv::Vec3b(35, 90, 140));
  color.copyTo(frame.color(shown_at));
  depth.copyTo(frame.depth(shown_at));
  const Points found = observer_.observe(next(frame), rest_).surface.volumeVertices();
  for (int piece = 0; piece < 2; ++piece) {
    for (const int v : observer_.model().pieces()[piece])
      ASSERT_LT((found.row(v) - truth.row(v)).norm(), 0.01) << "vertex " << v << " of piece " << piece;
  }
}

TEST_F(CutObserver, SeesOutlinesOnlyWhereTheyAreUsed) {
  const Points beside = transformed(rest_, Eigen::Isometry3d(Eigen::Translation3d(0.012, 0.0, 0.0)));
  const auto outlines = [&](double weight) {
    TrackerConfig config;
    config.outline_weight = weight;
    const cv::Mat3b plain(frame_.color.size(), cv::Vec3b(90, 90, 90));
    RgbdFrame frame = frame_;
    frame.color = plain;
    return FrameObserver(config, box_.volume, box_.surface)
        .observe(next(frame), beside)
        .seen.outline.associations.size();
  };
  EXPECT_EQ(outlines(0.0), 0u);
  EXPECT_GT(outlines(1.0), 10u);
}

TEST_F(CutObserver, NamesPiecesAsTheVisualMeshDoes) {
  const auto names = [&](const MeshTopology& surface) {
    return SurfaceModel(box_.volume, surface).piecesOfSurface();
  };
  using Names = std::vector<std::set<std::uint32_t>>;
  EXPECT_EQ(names(box_.surface), (Names{{0}, {1}}));
  MeshTopology reversed = box_.surface;
  reversed.triangles = box_.surface.triangles.colwise().reverse().eval();
  reversed.triangle_pieces =
      trianglePieces(reversed.triangles, static_cast<int>(reversed.rest_vertices.rows()));
  EXPECT_EQ(names(reversed), (Names{{1}, {0}}));
}

}  // namespace
}  // namespace softbody

#include "softbody_common/cutting/edit_history.h"

#include <test_support/gtest.h>

#include <cstdint>
#include <limits>
#include <random>

namespace softbody {
namespace {

/// A patch of one triangle, told apart by its first coordinate.
TriangleMesh patch(double x) {
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.vertices << x, 0, 0, x, 1, 0, x, 0, 1;
  mesh.triangles << 0, 1, 2;
  return mesh;
}

Cut cutAt(const EditHistory& history, std::uint32_t stroke, double x) {
  return {history.revision + 1, stroke, CutKind::kCut, patch(x)};
}

Cut edit(const EditHistory& history, CutKind kind) { return {history.revision + 1, 0, kind, {}}; }

/// A possible edit of any kind; few stroke numbers, so that strokes grow.
Cut randomEdit(const EditHistory& history, std::mt19937* random) {
  const auto pick = [random](int count) { return std::uniform_int_distribution<int>(0, count - 1)(*random); };
  const CutKind kinds[] = {CutKind::kUndo, CutKind::kRedo, CutKind::kReset};
  const int kind = pick(10);
  if (kind < 5) {
    const Cut move = edit(history, kinds[kind / 2]);
    if (refusalOf(move, history).empty()) return move;
  }
  return cutAt(history, static_cast<std::uint32_t>(pick(3)), pick(1000));
}

EditHistory randomHistory(EditHistory history, int edits, std::mt19937* random) {
  for (int k = 0; k < edits; ++k) addEdit(randomEdit(history, random), &history);
  return history;
}

TEST(EditHistory, RefusesWhatIsNotPossible) {
  EditHistory history;
  EXPECT_EQ(refusalOf(edit(history, CutKind::kUndo), history), "there is no cut to undo");
  EXPECT_EQ(refusalOf(edit(history, CutKind::kRedo), history), "there is no cut to redo");
  EXPECT_EQ(refusalOf(edit(history, CutKind::kReset), history), "the body is not cut");
  Cut late = cutAt(history, 1, 0.0);
  late.revision = 7;
  EXPECT_TRUE(says(refusalOf(late, history), "its revision is 7"));
}

TEST(EditHistory, BoundsTheStroke) {
  EditHistory history;
  Cut half = cutAt(history, 1, 0.0);
  half.patch.triangles = Triangles::Constant(kMostPatchTriangles / 2 + 1, 3, 0);
  EXPECT_EQ(refusalOf(half, history), "");
  addEdit(half, &history);
  ++half.revision;
  EXPECT_TRUE(says(refusalOf(half, history), "begin another stroke"));
  half.stroke = 2;
  EXPECT_EQ(refusalOf(half, history), "");
}

TEST(EditHistory, AStrokeGrowsUntilAnotherEdit) {
  EditHistory history;
  addEdit(cutAt(history, 1, 0.1), &history);
  addEdit(cutAt(history, 1, 0.2), &history);
  EXPECT_EQ(history.strokes.size(), 1u);
  addEdit(edit(history, CutKind::kUndo), &history);
  addEdit(edit(history, CutKind::kRedo), &history);
  addEdit(cutAt(history, 1, 0.3), &history);
  EXPECT_EQ(history.strokes.size(), 2u);
  EXPECT_EQ(history.in_force, 2u);
  EXPECT_EQ(history.revision, 5u);
}

TEST(EditHistory, TheNextEditIsFoundAndNoneIfThereAreMore) {
  std::mt19937 random(19);
  int further = 0;
  for (int round = 0; round < 500; ++round) {
    const EditHistory from = randomHistory({}, round % 9, &random);
    const EditHistory to = randomHistory(from, 1, &random);
    const std::optional<Cut> next = nextEdit(from, to);
    ASSERT_TRUE(next.has_value()) << round;
    EditHistory made = from;
    addEdit(*next, &made);
    EXPECT_TRUE(sameEdits(made, to)) << round;
    EXPECT_EQ(made.revision, to.revision);
    further += nextEdit(from, randomHistory(to, 2, &random)) ? 1 : 0;
    EXPECT_FALSE(nextEdit(from, from)) << round;
  }
  EXPECT_EQ(further, 0);
}

TEST(EditHistory, CommonStrokesAreTheFirstThatAreTheSame) {
  EditHistory one;
  for (std::uint32_t stroke = 1; stroke < 4; ++stroke) addEdit(cutAt(one, stroke, 0.1 * stroke), &one);
  EditHistory other = one;
  addEdit(edit(other, CutKind::kReset), &other);
  EXPECT_EQ(commonStrokes(one, other), 3u);
  addEdit(edit(other, CutKind::kRedo), &other);
  addEdit(cutAt(other, 2, 0.7), &other);
  EXPECT_EQ(commonStrokes(one, other), 1u);
  EXPECT_EQ(commonStrokes({}, other), 0u);
}

/// However often revisions leap, each leap that is accepted leaves room for the edits that follow.
TEST(EditHistory, OneMessageCannotUseUpTheRevisions) {
  std::mt19937 random(5);
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  EditHistory own;
  for (int k = 0; k < 1000; ++k) {
    EditHistory theirs;
    theirs.body = own.body == 0 || random() % 10 == 0 ? 1 + random() % 3 : own.body;
    theirs.revision = random() % 4 == 0 ? kMost - random() % 100 : own.revision + random() % 2'000'000;
    const bool same_body = theirs.body == own.body;
    if (!refusalOf(theirs, own).empty()) continue;
    EXPECT_LE(theirs.revision, (same_body ? own.revision : kMost / 2) + 1'000'000u);
    own = theirs;
    if (own.revision > kMost / 2) own = {};
  }
  EditHistory next = own;
  next.revision += 1;
  EXPECT_EQ(refusalOf(next, own), "");
  EditHistory last;
  last.body = 7;
  last.revision = kMost;
  EXPECT_NE(refusalOf(last, EditHistory{}), "");
  EditHistory first = last;
  first.revision = 3;
  EXPECT_NE(refusalOf(last, first), "");
  EXPECT_EQ(refusalOf(first, last), "");
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

#include <random>

#include "cutting/binding/body_history.h"
#include "cutting/fixtures/cut_visual_body.h"
#include "cutting/fixtures/same_topology.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

MeshState restOf(const TetTopology& volume) { return testing::stateOf(volume, volume.rest_vertices); }

CuttingConfig configWith(double undo_memory_mb) {
  CuttingConfig config;
  config.undo_memory_mb = undo_memory_mb;
  return config;
}

/// Surface, and a simulator that follows the tets of another process.
struct Body {
  explicit Body(double undo_memory_mb)
      : simulator(testing::sponge(), Material(), {}),
        tets(testing::sponge(), configWith(undo_memory_mb), testing::followedBy(&simulator)),
        surface(testing::visualSponge(), testing::sponge(), configWith(undo_memory_mb)) {}

  bool apply(const Cut& cut) {
    std::string reason;
    if (!surface.apply(cut, restOf(surface.volume()), &reason)) return false;
    tets.adopt(surface.edits());
    return true;
  }
  void adopt(const EditHistory& edits) {
    tets.adopt(edits);
    surface.adopt(edits);
  }
  std::size_t dropped() const { return tets.droppedVersions() + surface.droppedVersions(); }

  Simulator simulator;
  CuttableBody tets, surface;
};

using testing::expectSame;

/// Bit for bit, and so is the shape that the surface takes.
void expectSame(const Body& a, const Body& b) {
  EXPECT_EQ(a.simulator.topology().revision, b.simulator.topology().revision);
  EXPECT_EQ(a.surface.volume().revision, b.surface.volume().revision);
  EXPECT_EQ(a.surface.surface().topology().revision, b.surface.surface().topology().revision);
  expectSame(a.simulator.topology(), b.simulator.topology());
  expectSame(a.surface.volume(), b.surface.volume());
  expectSame(a.simulator.topology(), b.surface.volume());
  expectSame(a.surface.surface().topology(), b.surface.surface().topology());
  const MeshState bent =
      testing::stateOf(a.surface.volume(), testing::deformed(a.surface.volume().rest_vertices));
  EXPECT_LT((a.surface.surface().apply(bent).vertices - b.surface.surface().apply(bent).vertices)
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
  EXPECT_TRUE(sameEdits(a.tets.edits(), b.tets.edits()));
  EXPECT_TRUE(sameEdits(a.tets.edits(), a.surface.edits()));
}

/// Random edits of a body; strokes have one or more patches.
class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed) : random_(seed), cuts_(sponge_, seed) {}

  Cut next(const CuttableBody& surface) {
    const int kind = std::uniform_int_distribution<int>(0, 9)(random_);
    if (kind == 0) return surface.edit(CutKind::kReset);
    if (kind <= 3) return surface.edit(CutKind::kUndo);
    if (kind <= 5) return surface.edit(CutKind::kRedo);
    Cut cut = surface.separateCut(cuts_.planeCut());
    if (kind == 9 && cut.stroke > 0) --cut.stroke;  // continues the last stroke
    return cut;
  }

 private:
  std::mt19937 random_;
  const TetTopology sponge_ = testing::sponge();
  testing::RandomCuts cuts_;
};

TEST(EditMemory, ABodyWithoutMemoryUndoesAndRedoesTheSame) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    Body whole(1000.0), bounded(0.0);
    RandomEdits edits(seed);
    std::size_t most_dropped = 0;
    for (int k = 0; k < 60; ++k) {
      const Cut cut = edits.next(whole.surface);
      const bool made = whole.apply(cut);
      ASSERT_EQ(bounded.apply(cut), made) << "edit " << k;
      expectSame(whole, bounded);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", edit " << k;
      most_dropped = std::max(most_dropped, bounded.dropped());
    }
    EXPECT_EQ(whole.dropped(), 0u);
    EXPECT_GT(most_dropped, 4u);
  }
}

TEST(EditMemory, ABodyThatTakesOverAHistoryIsTheSame) {
  Body whole(1000.0), follower(1.0);
  RandomEdits edits(4);
  for (int k = 0; k < 60; ++k) {
    whole.apply(edits.next(whole.surface));
    if (k % 4 != 3) continue;
    Body started(1.0);
    started.adopt(whole.surface.edits());
    expectSame(whole, started);
    follower.adopt(whole.surface.edits());
    expectSame(whole, follower);
    ASSERT_FALSE(HasFailure()) << "edit " << k;
  }
}

/// From any history to any other.
TEST(EditMemory, ABodyTakesOverTheHistoryOfAnother) {
  RandomEdits edits(8);
  for (int round = 0; round < 8; ++round) {
    Body one(1.0), other(1.0);
    for (int k = 0; k < 3; ++k) one.apply(edits.next(one.surface));
    other.adopt(one.surface.edits());
    for (int k = 0; k < 8; ++k) one.apply(edits.next(one.surface));
    for (int k = 0; k < round; ++k) other.apply(edits.next(other.surface));
    one.adopt(other.surface.edits());
    expectSame(one, other);
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
}

TEST(EditMemory, APlacedBodyKeepsItsPlaceWhenItTakesOverAHistory) {
  Body whole(1000.0), follower(1000.0);
  RandomEdits edits(5);
  for (int k = 0; k < 12; ++k) whole.apply(edits.next(whole.surface));
  TargetSet targets;
  targets.reset = true;
  targets.body_pose = testing::somePose();
  follower.simulator.step(targets, 1'000'000);
  follower.adopt(whole.surface.edits());
  const TetTopology& volume = follower.simulator.topology();
  const Points expected = transformed(volume.rest_vertices, targets.body_pose);
  EXPECT_LT((follower.simulator.state().vertices - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(EditMemory, VersionsStayWithinTheirBound) {
  const TetTopology sponge = testing::sponge();
  testing::RandomCuts cuts(sponge, 6);
  BodyHistory history(sponge, {});
  constexpr CutLimits kLimits{0, 50'000};
  for (std::uint32_t stroke = 0; stroke < 25; ++stroke) {
    EditHistory edits = history.edits();
    addEdit({edits.revision + 1, stroke, CutKind::kCut, cuts.planeCut()}, &edits);
    history.adopt(edits, kLimits);
    EXPECT_LE(history.droppableBytes(), kLimits.undo_bytes);
  }
  EXPECT_GT(history.droppedVersions(), 5u);
}

TEST(EditMemory, TooManyPiecesAreRefused) {
  CuttingConfig config;
  config.max_pieces = 2;
  CuttableBody surface(testing::visualSponge(), testing::sponge(), config);
  std::string reason;
  const auto plane = [&](double x) {
    return surface.separateCut(testing::planePatch({x, 0.05, 0.015}, {1.0, 0.1, 0.0}, 1.0));
  };
  ASSERT_TRUE(surface.apply(plane(0.05), restOf(surface.volume()), &reason)) << reason;
  EXPECT_THROW(surface.apply(plane(0.12), restOf(surface.volume()), &reason), std::invalid_argument);
  EXPECT_THROW(surface.preview(plane(0.12).patch), std::invalid_argument);
  EXPECT_EQ(surface.volume().revision, 1u);
}

}  // namespace
}  // namespace softbody

#include <gtest/gtest.h>

#include <random>

#include "cutting/fixtures/cut_visual_body.h"
#include "cutting/fixtures/same_topology.h"
#include "cutting/volume/undo_versions.h"
#include "softbody_sim/cutting/binding/cuttable_surface.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

MeshState restOf(const TetTopology& volume) { return testing::stateOf(volume, volume.rest_vertices); }

/// Simulator and surface with the same bound of the memory for undo.
struct Body {
  explicit Body(double undo_memory_mb)
      : simulator(testing::sponge(), Material(), simulatorConfig(undo_memory_mb)),
        surface(testing::visualSponge(), testing::sponge(), cuttingConfig(undo_memory_mb)) {}

  static SimulatorConfig simulatorConfig(double undo_memory_mb) {
    SimulatorConfig config;
    config.undo_memory_mb = undo_memory_mb;
    return config;
  }
  static CuttingConfig cuttingConfig(double undo_memory_mb) {
    CuttingConfig config;
    config.undo_memory_mb = undo_memory_mb;
    return config;
  }
  bool apply(const Cut& cut) {
    std::string reason;
    if (!surface.apply(cut, restOf(surface.volume()), &reason)) return false;
    EXPECT_TRUE(simulator.apply(cut, &reason)) << reason;
    return true;
  }
  void adopt(const EditHistory& edits) {
    simulator.adopt(edits);
    surface.adopt(edits);
  }

  Simulator simulator;
  CuttableSurface surface;
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
  EXPECT_TRUE(sameEdits(a.simulator.edits(), b.simulator.edits()));
  EXPECT_TRUE(sameEdits(a.simulator.edits(), a.surface.edits()));
}

/// Random edits of a body; strokes have one or more patches.
class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed) : random_(seed), cuts_(sponge_, seed) {}

  Cut next(const CuttableSurface& surface) {
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
      most_dropped =
          std::max({most_dropped, bounded.simulator.droppedVersions(), bounded.surface.droppedVersions()});
    }
    EXPECT_EQ(whole.simulator.droppedVersions() + whole.surface.droppedVersions(), 0u);
    EXPECT_GT(most_dropped, 2u);
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
  CutHistory history(sponge);
  constexpr std::size_t kLimit = 200'000;
  for (std::uint32_t stroke = 0; stroke < 25; ++stroke) {
    history.cutOrAdvance(cuts.planeCut(), stroke);
    dropVersions(kLimit, &history);
    std::size_t used = 0;
    const std::size_t present = history.edits().in_force;
    for (std::size_t k = 1; k + 1 < present; ++k) used += history.has(k) ? history.bytes(k) : 0;
    EXPECT_LE(used, kLimit);
    EXPECT_TRUE(history.has(0) && history.has(present) && history.has(present - 1));
  }
  EXPECT_GT(droppedVersions(history), 5u);
}

TEST(EditMemory, TooManyPiecesAreRefused) {
  CuttingConfig config;
  config.max_pieces = 2;
  CuttableSurface surface(testing::visualSponge(), testing::sponge(), config);
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

#include "shown_pieces.h"

namespace softbody {
namespace {

constexpr int kFewest = 12;          // features, or blocks of depth
constexpr int kEnough = 150;         // blocks of depth, whatever is hidden beside them
constexpr double kLeastShown = 0.3;  // of the blocks that the prediction shows of a piece

}  // namespace

std::vector<bool> shownPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                              const std::vector<FeatureMatch>& matches, std::size_t body_count) {
  if (body_count == 1) return {true};
  std::vector<int> blocks(body_count, 0), agreeing(body_count, 0), features(body_count, 0);
  for (const SurfaceSample& sample : samples.samples) ++blocks[sample.body];
  for (const Association& association : depth) ++agreeing[association.body];
  for (const FeatureMatch& match : matches) features[match.association.body] += match.inlier ? 1 : 0;
  std::vector<bool> shown;
  for (std::size_t body = 0; body < body_count; ++body) {
    shown.push_back(features[body] >= kFewest || agreeing[body] >= kEnough ||
                    (agreeing[body] >= kFewest && agreeing[body] >= kLeastShown * blocks[body]));
  }
  return shown;
}

}  // namespace softbody

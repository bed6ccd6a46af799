#include "texture/view_choice.h"

#include <algorithm>
#include <limits>

namespace softbody::scanning {
namespace {

// A seam along one side costs as much as a view of half the best one's quality.
constexpr float kSeam = 0.5f;
constexpr int kSweeps = 12;        // of messages; later ones change little
constexpr int kChangeRounds = 20;  // of single changes

constexpr float kNever = std::numeric_limits<float>::max();

float bestQuality(const std::vector<TriangleView>& views) {
  float best = 0.0f;
  for (const TriangleView& view : views) best = std::max(best, view.quality);
  return best;
}

/// Messages between the triangles, and what follows from them.
class BeliefPropagation {
 public:
  BeliefPropagation(const EdgeNeighbors& neighbors, const TriangleViews& views)
      : neighbors_(neighbors), views_(views), messages_(views.size()) {
    std::size_t frames = 0;
    for (std::size_t t = 0; t < views.size(); ++t) {
      const float best = bestQuality(views[t]);
      costs_.emplace_back();
      for (const TriangleView& view : views[t]) {
        costs_.back().push_back(1.0f - view.quality / best);
        frames = std::max(frames, static_cast<std::size_t>(view.frame) + 1);
      }
      for (auto& message : messages_[t]) message.assign(views[t].size(), 0.0f);
    }
    of_frame_.assign(frames, kNever);
  }

  void sweep(bool forward) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const std::size_t t = forward ? i : views_.size() - 1 - i;
      for (std::size_t k = 0; k < 3; ++k) {
        if (neighbors_[t][k] >= 0) send(t, k);
      }
    }
  }

  /// The frame of least cost.
  int best(std::size_t t) const {
    const std::vector<float> costs = beliefs(t, 3);
    if (costs.empty()) return -1;
    return views_[t][static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin())]
        .frame;
  }

  /// Takes the frame of least cost among the neighbours' frames. @return whether it is another one.
  bool improve(std::size_t t, std::vector<int>* labels) const {
    float least = kNever;
    int best = -1;
    for (std::size_t i = 0; i < views_[t].size(); ++i) {
      float cost = costs_[t][i];
      for (const int other : neighbors_[t]) {
        const int label = other < 0 ? -1 : (*labels)[static_cast<std::size_t>(other)];
        if (label >= 0 && label != views_[t][i].frame) cost += kSeam;
      }
      if (cost < least || (cost == least && views_[t][i].frame == (*labels)[t]))
        least = cost, best = views_[t][i].frame;
    }
    const bool changes = best != (*labels)[t];
    (*labels)[t] = best;
    return changes;
  }

 private:
  /// Costs of the triangle's views with all messages but that over one side; 3: all.
  std::vector<float> beliefs(std::size_t t, std::size_t without) const {
    std::vector<float> sums = costs_[t];
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; k != without && i < sums.size(); ++i) sums[i] += messages_[t][k][i];
    }
    return sums;
  }

  void send(std::size_t t, std::size_t side) {
    const auto to = static_cast<std::size_t>(neighbors_[t][side]);
    if (views_[t].empty() || views_[to].empty()) return;
    const auto& back = neighbors_[to];
    const auto at =
        static_cast<std::size_t>(std::find(back.begin(), back.end(), static_cast<int>(t)) - back.begin());
    if (at == 3) return;
    const std::vector<float> sums = beliefs(t, side);
    const float other = *std::min_element(sums.begin(), sums.end()) + kSeam;
    for (std::size_t i = 0; i < sums.size(); ++i) of_frame_[frameOf(t, i)] = sums[i];
    std::vector<float>& message = messages_[to][at];
    float least = kNever;
    for (std::size_t i = 0; i < message.size(); ++i) {
      message[i] = std::min(of_frame_[frameOf(to, i)], other);
      least = std::min(least, message[i]);
    }
    for (float& value : message) value -= least;
    for (std::size_t i = 0; i < sums.size(); ++i) of_frame_[frameOf(t, i)] = kNever;
  }

  std::size_t frameOf(std::size_t t, std::size_t view) const {
    return static_cast<std::size_t>(views_[t][view].frame);
  }

  const EdgeNeighbors& neighbors_;
  const TriangleViews& views_;
  std::vector<std::vector<float>> costs_;                    // per triangle and view
  std::vector<std::array<std::vector<float>, 3>> messages_;  // to a triangle over each side
  std::vector<float> of_frame_;                              // scratch
};

}  // namespace

std::vector<int> chooseViews(const EdgeNeighbors& neighbors, const TriangleViews& views) {
  BeliefPropagation propagation(neighbors, views);
  for (int i = 0; i < kSweeps; ++i) propagation.sweep(i % 2 == 0);
  std::vector<int> labels;
  for (std::size_t t = 0; t < views.size(); ++t) labels.push_back(propagation.best(t));
  bool changes = true;
  for (int round = 0; changes && round < kChangeRounds; ++round) {
    changes = false;
    for (std::size_t t = 0; t < views.size(); ++t) changes = propagation.improve(t, &labels) || changes;
  }
  return labels;
}

}  // namespace softbody::scanning

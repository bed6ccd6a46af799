#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace softbody {

/// What a display draws next: a state, and its topology if that is not the one already drawn.
template <typename TopologyPtr, typename StatePtr>
struct BodyNews {
  TopologyPtr topology;  ///< null: unchanged
  StatePtr state;
};

/// Pairs the states of a body with their topologies, which come by another topic: a state is held until its
/// topology has come, and a topology until its first state has come. Only the newest of both is kept.
/// TopologyPtr and StatePtr point to messages with a revision. put() may be called by any thread.
template <typename TopologyPtr, typename StatePtr>
class ShownBody {
 public:
  using News = BodyNews<TopologyPtr, StatePtr>;

  void putTopology(TopologyPtr topology) {
    const std::lock_guard lock(mutex_);
    next_topology_ = std::move(topology);
  }

  void putState(StatePtr state) {
    const std::lock_guard lock(mutex_);
    next_state_ = std::move(state);
  }

  /// What has come since the last call and fits together; nothing if there is no news.
  /// @param same whether two topologies are the same body. They are sent again every second.
  template <typename Same>
  std::optional<News> take(const Same& same) {
    const std::lock_guard lock(mutex_);
    if (next_topology_ && topology_ && same(*next_topology_, *topology_)) next_topology_ = {};
    if (!next_state_) return std::nullopt;
    const bool next = next_topology_ && next_topology_->revision == next_state_->revision;
    const bool shown = !next && topology_ && topology_->revision == next_state_->revision;
    if (!next && !shown) return std::nullopt;
    if (next) topology_ = std::exchange(next_topology_, {});
    return News{next ? topology_ : TopologyPtr{}, std::exchange(next_state_, {})};
  }

  /// The revision of a state that waits for its topology.
  std::optional<unsigned> heldRevision() const {
    const std::lock_guard lock(mutex_);
    if (!next_state_) return std::nullopt;
    return next_state_->revision;
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    topology_ = next_topology_ = {};
    next_state_ = {};
  }

 private:
  mutable std::mutex mutex_;
  TopologyPtr topology_, next_topology_;
  StatePtr next_state_;
};

}  // namespace softbody

#pragma once

#include <deque>
#include <memory>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/cutting/tet_edits.h"

namespace softbody {

/// The last edits of the tets of a body, for targets that are late.
class RecentEdits {
 public:
  /// @param before the tets before the edits. After several edits at once earlier targets are not found
  /// again.
  void add(const TetTopology& before, const TetEdits& edits);
  void clear() { steps_.clear(); }

  /// Converts targets on tets of a recent revision to tets of the present one. Drops targets that are far
  /// outside of their new tet. Returns targets of other revisions unchanged.
  TargetSet toCurrentRevision(TargetSet targets) const;

 private:
  struct Step {
    std::shared_ptr<const TetTopology> before;
    std::shared_ptr<const TetEdit> edit;
  };
  std::deque<Step> steps_;  ///< oldest first
};

}  // namespace softbody

#pragma once

#include <vector>

#include "softbody_common/geometry/tet_locator.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Finds where on a body measured points of its surface belong.
class SurfacePoints {
 public:
  /// @param visual at rest; @param volume must outlive this.
  SurfacePoints(const MeshTopology& visual, const TetTopology& volume);

  /// A target on the closest place of the deformed surface for each point, which counts along the surface's
  /// normal. @param vertices of the volume [m].
  std::vector<Target> targetsOf(const Points& measured, const Points& vertices) const;

 private:
  MeshTopology visual_;
  const TetTopology* volume_;
  TetLocator locator_;
  std::vector<MaterialPoint> binding_;  ///< of the visual vertices
};

}  // namespace softbody

#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody::bench {

/// A body with as many points and cage faces as the doll of Kang et al. 2022. The cage is a bumpy ball, 200
/// mm wide, with 128 vertices and 252 faces. The 18,650 points lie on a similar surface, 3 to 15 % inside of
/// it.
struct DollSize {
  TriangleMesh cage;
  Points points;
};

DollSize makeDollSize();

}  // namespace softbody::bench

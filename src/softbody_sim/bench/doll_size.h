#pragma once

#include "softbody_common/types.h"

namespace softbody::bench {

/// As many points and cage faces as the doll of Kang et al. 2022 has: a bumpy ball of 128 vertices and 252
/// faces, 200 mm wide, and 18,650 points spread over a like surface 3 to 15 % inside of it.
struct DollSize {
  TriangleMesh cage;
  Points points;
};

DollSize makeDollSize();

}  // namespace softbody::bench

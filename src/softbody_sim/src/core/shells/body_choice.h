#pragma once

#include <string>

#include "surface_mesh/surface_repair.h"

namespace softbody {

/// Which of a file's shells are the body, and how large it is.
struct BodyChoice {
  std::string shell;      ///< "all", "largest" or a number from 1; empty: the largest if it dominates
  double unit_m = 1.0;    ///< metres per unit of the surface
  double length_m = 0.0;  ///< of the body's longest side; above 0, it replaces the unit
};

/// The body of a repaired surface, in metres. Surfaces that enclose nothing are dropped, holes are filled,
/// repeated shells are dropped and crossing ones united. Shells inside one another are one body: a shell in a
/// solid is a cavity, a shell in a cavity is solid.
/// @param name of the mesh, for warnings, which say all that was done. @throw std::invalid_argument if
/// nothing encloses a volume, or if the choice is not clear; the message then lists the bodies.
WeldedSurface chosenBody(WeldedSurface surface, const BodyChoice& choice, const std::string& name,
                         Warnings* warnings);

/// The same for a surface whose volume is given: nothing is dropped or united.
WeldedSurface wholeBody(WeldedSurface surface, double unit_m, const std::string& name, Warnings* warnings);

}  // namespace softbody

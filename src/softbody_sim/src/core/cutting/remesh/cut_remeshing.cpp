#include "cutting/remesh/cut_remeshing.h"

#include "cutting/remesh/complex_improvement.h"
#include "cutting/remesh/complex_transfer.h"
#include "cutting/remesh/fill_refinement.h"

namespace softbody {
namespace {

constexpr double kGoal = 0.4226;  // sine of 25 degrees

}  // namespace

void remeshCut(const std::vector<bool>& is_cut, double distance, SplitSurface* surface, CutFill* fill) {
  CutComplex complex = complexAround(*surface, *fill, is_cut);
  // The fill has no vertices inside yet: first the curve gets its shape from the skin alone.
  improveSkin(kGoal, distance, &complex);
  refineFill(distance, &complex);
  improveFill(kGoal, distance, &complex);
  writeBack(complex, surface, fill);
}

}  // namespace softbody

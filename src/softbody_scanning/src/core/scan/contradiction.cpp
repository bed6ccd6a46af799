#include "scan/contradiction.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace softbody::scanning {
namespace {

constexpr double kMinority =
    0.2;                         // of the views of a place: fewer do not change the surface, and are left out
constexpr int kFewestViews = 3;  // that agree on one or the other
// Half of what a volume may be off: the sides of what moved are often hidden, and only its top tells.
constexpr double kMostContradicted = 0.025;

bool isContradicted(const PlaceEvidence& place) {
  const int fewer = std::min(place.measured, place.empty);
  return fewer >= kFewestViews && fewer > kMinority * (place.measured + place.empty);
}

}  // namespace

double contradictedShare(const Volume& volume, double above_m) {
  double measured = 0.0, contradicted = 0.0;
  const int first = static_cast<int>((above_m - volume.box().box.min().z()) / volume.box().voxel_m) + 1;
  for (int z = std::max(0, first); z < volume.size().z(); ++z)
    for (int y = 0; y < volume.size().y(); ++y)
      for (int x = 0; x < volume.size().x(); ++x) {
        const PlaceEvidence& place = volume.at({x, y, z});
        measured += place.measured;
        if (isContradicted(place)) contradicted += place.measured;
      }
  return measured > 0.0 ? contradicted / measured : 0.0;
}

void requireOneSurface(const Volume& volume, double above_m) {
  const double share = contradictedShare(volume, above_m);
  if (share <= kMostContradicted) return;
  throw std::invalid_argument(fmt::format(
      "the object moved or changed its shape, or something stood beside it for a while: at {:.0f} % "
      "of the surface, some views measured it and others looked through it; record it again and "
      "touch neither the object nor what it stands on",
      1e2 * share));
}

}  // namespace softbody::scanning

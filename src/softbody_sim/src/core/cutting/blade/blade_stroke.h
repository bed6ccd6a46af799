#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "cutting/blade/blade_outline.h"
#include "cutting/blade/rest_map.h"
#include "cutting/patch/cut_patch.h"
#include "softbody_sim/cutting/cutting_config.h"

namespace softbody {

/// What a blade cuts next.
struct BladeCut {
  std::uint32_t stroke = 0;
  CutPatch patch;  ///< in single precision, as it is published
};

/// From a blade's motion to patches. A blade that is in the body by less than a share of an advance only
/// touches it. A stroke begins where sides of the blade's polygon enter the body, be it between two samples,
/// and go on in it along their normals; the sides that face this way are its leading edge, and the edge's
/// furthest advance so far is the front of the cut. Once some of the edge is far enough beyond the front, the
/// patch ruled between both is to be cut. What does not advance cuts nothing: withdrawal, tremor, a blade
/// that moves to its side or along its edge. A blade that comes back into a slit goes on with the stroke that
/// made it.
class BladeStroke {
 public:
  /// @param spacing of the samples on the blade's outline [m]; @param overhang of the tets over the visual
  /// mesh [m]: where the blade is outside of the one the patch goes on through the other.
  BladeStroke(const CuttingConfig& config, double spacing, double overhang);

  /// @param blade polygon where it is now, the same one every time; @param map of the body as it is now.
  /// @return the cut that the blade asks for now; it asks again, with its way since added, until accept() is
  /// called.
  std::optional<BladeCut> follow(const Points& blade, const RestMap& map, const RestSolid& solid);
  void accept();

  /// The blade is nowhere near, or not seen.
  void lift() { active_ = false, clear_.resize(0, 3); }
  /// Strokes do not go on after cuts that others made, or took back.
  void forgetStrokes();
  /// Numbers that others give to their strokes.
  void noteNumber(std::uint32_t number) { last_number_ = std::max(last_number_, number); }
  std::uint32_t lastNumber() const { return last_number_; }

 private:
  struct Stroke {
    std::uint32_t number = 0;
    std::vector<int> edge;    ///< samples of the outline
    Points front;             ///< of the samples, with one more at either end
    Points reach;             ///< furthest since
    Eigen::VectorXd reached;  ///< how far that is beyond the front [m]
    std::vector<CutPatch> patches;
  };

  std::uint32_t newNumber() { return ++last_number_; }
  struct Contact;
  bool resume(const Contact& now);
  Eigen::Vector3d wayIn(const Contact& now) const;
  bool enter(const Contact& now, const RestSolid& solid);
  void startFromFront();
  std::optional<BladeCut> advance(const BladeOutline& outline, const RestSolid& solid);

  CuttingConfig config_;
  double spacing_, overhang_;
  std::vector<int> parts_;  ///< per side of the polygon, as many samples begin on it
  Points clear_;            ///< outline but for what only touches, when it was out of the body last
  std::vector<Stroke> strokes_;
  bool active_ = false;  ///< the last of strokes_
  Points asked_;         ///< front after the cut that was asked for
  CutPatch asked_patch_;
  std::uint32_t last_number_ = 0;
};

}  // namespace softbody

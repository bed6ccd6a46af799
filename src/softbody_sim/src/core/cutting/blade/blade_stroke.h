#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "cutting/blade/blade_outline.h"
#include "cutting/blade/rest_map.h"
#include "cutting/patch/cut_patch.h"
#include "softbody_sim/cutting/cutting_config.h"

namespace softbody {

/// The next cut of a blade.
struct BladeCut {
  std::uint32_t stroke = 0;
  CutPatch patch;  ///< rounded to single precision, as it is published
};

/// Turns the motion of a blade into cut patches. A blade that is less deep in the body than a fraction of an
/// advance only touches it. A stroke begins when sides of the blade's polygon enter the body and advance
/// along their normals. The sides that face this direction are the leading edge. The furthest position of the
/// leading edge so far is the front of the cut. When a part of the edge is far enough beyond the front, the
/// ruled patch between both is cut. Withdrawal, tremor, and motion sideways or along the edge cut nothing. A
/// blade that returns into a slit continues the stroke that made it.
class BladeStroke {
 public:
  /// @param spacing of the samples on the blade's outline [m]; @param overhang of the tets over the visual
  /// mesh [m]: the patch continues through this layer, outside of the visual mesh.
  BladeStroke(const CuttingConfig& config, double spacing, double overhang);

  /// @param blade polygon in its present pose, the same polygon in every call; @param map of the present
  /// state. @return the next cut, if any. Until accept() is called, later calls return it again, extended by
  /// the further motion.
  std::optional<BladeCut> follow(const Points& blade, const RestMap& map, const RestSolid& solid);
  void accept();

  /// To be called when the blade is far away or is not seen.
  void lift() { active_ = false, clear_.resize(0, 3); }
  /// Ends all strokes. To be called after an undo, or after a cut that the blade did not make.
  void forgetStrokes();
  /// Reserves a number for another stroke.
  void noteNumber(std::uint32_t number) { last_number_ = std::max(last_number_, number); }
  std::uint32_t lastNumber() const { return last_number_; }

 private:
  struct Stroke {
    std::uint32_t number = 0;
    std::vector<int> edge;    ///< samples of the outline
    Points front;             ///< positions of the samples, and one more at either end
    Points reach;             ///< furthest positions since then
    Eigen::VectorXd reached;  ///< distance of `reach` beyond the front [m]
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
  std::vector<int> parts_;  ///< per side of the polygon, its number of parts
  Points clear_;  ///< outline without the touching margin, when the blade was last outside of the body
  std::vector<Stroke> strokes_;
  bool active_ = false;  ///< the last stroke in strokes_ continues
  Points asked_;         ///< front after the requested cut
  CutPatch asked_patch_;
  std::uint32_t last_number_ = 0;
};

}  // namespace softbody

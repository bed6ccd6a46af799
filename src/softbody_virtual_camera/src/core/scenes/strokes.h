#pragma once

#include <vector>

#include "bodies/plane_cut.h"
#include "scenes/tool.h"

namespace softbody::virtual_camera {

/// The blade's way down into the body and up again. Lengths are in the scene's frame.
struct Stroke {
  PlaneCut cut;
  Eigen::Vector3d low, high;  ///< bounds of the face of the cut, in the cut's frame [m]
  double begin_s = 0.0;
};

constexpr double kDown_s = 2.0, kUp_s = 1.0;
constexpr double kTurn_s = 1.0;   ///< before a stroke: move from the previous stroke
constexpr double kLeave_s = 1.5;  ///< after the last stroke: move along x, out of view

/// @param mesh after the cut. @throw std::invalid_argument if the blade is shorter than the face.
Stroke makeStroke(const PlaneCut& cut, const CutMesh& mesh, const Tool& tool, double begin_s);

/// The tool's pose in the body's frame. Its blade is in the plane of the cut, and its z axis is along -y of
/// the cut.
Eigen::Isometry3d toolPose(const std::vector<Stroke>& strokes, const Tool& tool, double t);

/// The surface swept by the blade's edge, in rest space [m].
TriangleMesh sweptPatch(const Stroke& stroke, const Tool& tool);

}  // namespace softbody::virtual_camera

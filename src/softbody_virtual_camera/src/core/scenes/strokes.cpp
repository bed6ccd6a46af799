#include "scenes/strokes.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <stdexcept>

#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

/// Height of the blade's edge over the front of the cut, before the stroke and at its lowest point.
double raised(const Stroke& stroke) { return stroke.high.z() + 0.008; }
double lowered(const Stroke& stroke) { return stroke.cut.through ? stroke.low.z() - 0.005 : 0.0; }

/// The blade in the tool's frame. Its edge is at the smallest y, along z.
struct Blade {
  explicit Blade(const Tool& tool)
      : edge(tool.blade.col(1).minCoeff()),
        middle(0.5 * (tool.blade.col(2).minCoeff() + tool.blade.col(2).maxCoeff())),
        length(tool.blade.col(2).maxCoeff() - tool.blade.col(2).minCoeff()) {}
  double edge, middle, length;
};

Eigen::Isometry3d poseAt(const Stroke& stroke, const Tool& tool, double edge_height) {
  const Blade blade(tool);
  Eigen::Isometry3d T_cut_tool = Eigen::Isometry3d::Identity();
  T_cut_tool.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T_cut_tool.translation() << 0.0, 0.5 * (stroke.low.y() + stroke.high.y()) + blade.middle,
      edge_height - blade.edge;
  return stroke.cut.T_rest_cut * T_cut_tool;
}

Eigen::Isometry3d between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share) {
  const Eigen::Quaterniond from(a.linear()), to(b.linear());
  return Eigen::Translation3d((1.0 - share) * a.translation() + share * b.translation()) *
         from.slerp(share, to);
}

}  // namespace

Stroke makeStroke(const PlaneCut& cut, const CutMesh& mesh, const Tool& tool, double begin_s) {
  const Points places = transformed(cut.T_rest_cut.inverse(), mesh.topology.rest_vertices);
  constexpr double kFar = 1e9;
  Stroke stroke{cut, Eigen::Vector3d::Constant(kFar), Eigen::Vector3d::Constant(-kFar), begin_s};
  for (std::size_t f = 0; f < mesh.triangle_parents.size(); ++f) {
    if (mesh.triangle_parents[f] >= 0) continue;
    for (const int i : mesh.topology.triangles.row(static_cast<Eigen::Index>(f))) {
      stroke.low = stroke.low.cwiseMin(places.row(i).transpose());
      stroke.high = stroke.high.cwiseMax(places.row(i).transpose());
    }
  }
  const double width = stroke.high.y() - stroke.low.y(), length = Blade(tool).length;
  if (width > length) {
    throw std::invalid_argument(
        fmt::format("the tool's blade is too short for this body: it has {:.0f} % of the length of the cut",
                    100.0 * length / width));
  }
  return stroke;
}

Eigen::Isometry3d toolPose(const std::vector<Stroke>& strokes, const Tool& tool, double t) {
  constexpr double kWay = 0.55;  // [m]
  std::size_t i = 0;
  while (i + 1 < strokes.size() && t > strokes[i + 1].begin_s - kTurn_s) ++i;
  const Stroke& stroke = strokes[i];
  const double time = t - stroke.begin_s;
  const double depth = smoothStep(time / kDown_s) - smoothStep((time - kDown_s) / kUp_s);
  Eigen::Isometry3d pose = poseAt(stroke, tool, (1.0 - depth) * raised(stroke) + depth * lowered(stroke));
  if (i + 1 == strokes.size() && time > kDown_s + kUp_s) {
    const double gone = smoothStep((time - kDown_s - kUp_s) / kLeave_s);
    return Eigen::Translation3d(gone * kWay, 0.0, 0.0) * pose;
  }
  if (i == 0 || time > 0.0) return pose;
  return between(poseAt(strokes[i - 1], tool, raised(strokes[i - 1])), pose,
                 smoothStep(1.0 + time / kTurn_s));
}

TriangleMesh sweptPatch(const Stroke& stroke, const Tool& tool) {
  const double length = Blade(tool).length, middle = 0.5 * (stroke.low.y() + stroke.high.y());
  const Eigen::Vector3d corner(0.0, middle - 0.5 * length, lowered(stroke));
  TriangleMesh patch = rectangle(corner, {0.0, length, 0.0}, {0.0, 0.0, raised(stroke) - lowered(stroke)});
  patch.vertices = transformed(stroke.cut.T_rest_cut, patch.vertices);
  return patch;
}

}  // namespace softbody::virtual_camera

#include <Eigen/Dense>

#include "plays.h"
#include "softbody_bringup/virtual_camera/motion_profiles.h"
#include "softbody_bringup/virtual_camera/plane_cut.h"
#include "softbody_bringup/virtual_camera/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kPlace = 0.015;  // x of the cut [m], between two rows of vertices
constexpr double kDownBegin = 0.5, kDownEnd = 2.5, kUpEnd = 3.5;  // of the blade [s]
constexpr double kApartBegin = 4.0, kApartEnd = 5.5;              // of the pieces [s]

/// The tool's pose in the body's frame where it begins: its blade in the plane of the cut, the marker towards
/// the camera; the edge goes from above the body to below it.
Eigen::Isometry3d toolPose(double t) {
  constexpr double kRaised = 0.18, kTravel = 0.06, kTowardsCamera = 0.085;  // [m]
  const double down = smoothStep((t - kDownBegin) / (kDownEnd - kDownBegin));
  const double up = smoothStep((t - kDownEnd) / (kUpEnd - kDownEnd));
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T.translation() << kPlace, -kTowardsCamera, kRaised - kTravel * (down - up);
  return T;
}

/// The motion of the piece beyond the cut, or of the other one: apart, each turning a little.
Eigen::Isometry3d pieceMotion(double t, bool beyond) {
  constexpr double kWay = 0.02, kTurn = 0.15;  // [m], [rad]
  const double share = (beyond ? 1.0 : -1.0) * smoothStep((t - kApartBegin) / (kApartEnd - kApartBegin));
  return Eigen::Translation3d(share * kWay, 0.0, 0.0) *
         Eigen::AngleAxisd(share * kTurn, Eigen::Vector3d::UnitZ());
}

Points movedPieces(const PlaneCut& cut, double t) {
  const Points& rest = cut.topology.rest_vertices;
  const Eigen::Isometry3d near = pieceMotion(t, false), far = pieceMotion(t, true);
  Points moved(rest.rows(), 3);
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    const Eigen::Vector3d place = rest.row(i);
    moved.row(i) = (cut.beyond[static_cast<std::size_t>(i)] ? far : near) * place;
  }
  return moved;
}

}  // namespace

Scene cutScene(const Stage& stage, const Tool& tool) {
  Play play;
  play.name = "cut";
  play.duration_s = 8.0;
  play.repeats = false;
  const auto T_camera_tool = [start = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    return start * toolPose(t);
  };
  for (const Actor& actor : toolActors(tool)) play.props.push_back({actor, T_camera_tool});
  Scene scene = perform(stage, play);
  const PlaneCut cut = cutByPlane(stage.actors.at(0).rest, kPlace);
  scene.edits = {cut.topology};
  scene.state = [=, whole = scene.state](double t) {
    SceneState state = whole(t);
    state.T_camera_tool = T_camera_tool(t);
    if (t < kDownEnd) return state;
    state.revision = 1;
    state.vertices.at(0) = transformed(state.T_camera_body, movedPieces(cut, t));
    return state;
  };
  return scene;
}

}  // namespace softbody::virtual_camera

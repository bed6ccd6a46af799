#include "scenes/cut_scenes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "motion/motion_profiles.h"
#include "scenes/strokes.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kPlace = 0.015, kCrossPlace = 0.025;                 // x of the middle of the cuts [m]
constexpr double kLeeway = 2e-3;                                      // largest shift to avoid vertices [m]
constexpr double kFirst = 0.5, kRest = 1.0, kMove = 1.5, kEnd = 2.0;  // before the first stroke and so on [s]

/// The body's vertices after the cuts. The share of the motion goes from 0 to 1.
using Aftermath = std::function<Points(double share)>;

/// A vertical cut through the body, rotated about the vertical.
PlaneCut verticalCut(double place, double angle_rad) {
  return {Eigen::Translation3d(place, 0.0, 0.0) * Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ())};
}

/// Direction of the cuts. The markers of a board lie in the plane of its blade. A board is turned, so that
/// the camera sees them.
double angleOf(const Tool& tool) {
  constexpr double kBoardAngle = 0.9, kInPlane = 0.9;  // [rad], cosine
  const auto in_plane = [](const ToolMarker& marker) {
    return std::abs(marker.T_tool_marker.linear()(0, 2)) > kInPlane;
  };
  return std::any_of(tool.markers.begin(), tool.markers.end(), in_plane) ? kBoardAngle : 0.0;
}

/// A cut from the top through 60 % of the body's height there.
PlaneCut partialCut(const MeshTopology& body, const PlaneCut& through) {
  constexpr double kDepth = 0.6;
  const CutMesh whole = cutByPlane(body, through);
  const Eigen::Index made = whole.topology.rest_vertices.rows() - body.rest_vertices.rows();
  const Eigen::VectorXd heights = whole.topology.rest_vertices.bottomRows(made).col(2);
  PlaneCut cut = through;
  cut.through = false;
  cut.T_rest_cut.translation().z() = heights.maxCoeff() - kDepth * (heights.maxCoeff() - heights.minCoeff());
  return cut;
}

/// Every piece moves away from the middle of the cuts and rotates a little.
Aftermath partPieces(const MeshTopology& cut, double place) {
  constexpr double kWay = 0.02, kTurn = 0.15;  // [m], [rad]
  std::vector<std::uint32_t> piece(static_cast<std::size_t>(cut.rest_vertices.rows()), 0);
  std::map<std::uint32_t, std::pair<Eigen::Vector3d, double>> sums;
  for (Eigen::Index f = 0; f < cut.triangles.rows(); ++f) {
    for (const int i : cut.triangles.row(f)) {
      auto& [sum, count] =
          sums.try_emplace(cut.triangle_pieces[static_cast<std::size_t>(f)], Eigen::Vector3d::Zero(), 0.0)
              .first->second;
      sum += cut.rest_vertices.row(i).transpose();
      count += 1.0;
      piece[static_cast<std::size_t>(i)] = cut.triangle_pieces[static_cast<std::size_t>(f)];
    }
  }
  return [=, rest = cut.rest_vertices](double share) {
    std::vector<Eigen::Isometry3d> motions;
    for (const auto& [number, total] : sums) {
      const Eigen::Vector3d center = total.first / total.second;
      const Eigen::Vector3d away = Eigen::Vector3d(center.x() - place, center.y(), 0.0).normalized();
      const double turn = share * (number % 2 == 0 ? -kTurn : kTurn);
      motions.push_back(Eigen::Translation3d(center + share * kWay * away) *
                        Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-center));
    }
    Points moved(rest.rows(), 3);
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
      moved.row(i) = motions[piece[static_cast<std::size_t>(i)]] * Eigen::Vector3d(rest.row(i).transpose());
    }
    return moved;
  };
}

/// The walls of a slit move apart: by `kWay` at the top, by zero at the front, and less with the distance
/// from the slit.
Aftermath openSlit(const CutMesh& mesh, const Stroke& stroke) {
  constexpr double kWay = 0.006, kReach = 0.06;  // [m]
  return [=, rest = mesh.topology.rest_vertices, beyond = mesh.beyond](double share) {
    Points places = transformed(stroke.cut.T_rest_cut.inverse(), rest);
    for (Eigen::Index i = 0; i < places.rows(); ++i) {
      const double height = std::max(0.0, places(i, 2) / stroke.high.z());
      const double near = 1.0 - smoothStep(std::abs(places(i, 0)) / kReach);
      places(i, 0) += (beyond[static_cast<std::size_t>(i)] ? 1.0 : -1.0) * share * kWay * height * near;
    }
    return transformed(stroke.cut.T_rest_cut, places);
  };
}

/// Successive cuts of the body at rest.
struct Cuts {
  std::vector<Stroke> strokes;
  std::vector<Edit> edits;
  CutMesh last;
};

Cuts makeCuts(const MeshTopology& whole, const std::vector<PlaneCut>& planned, const Tool& tool) {
  Cuts cuts;
  MeshTopology before = whole;
  std::vector<int> parents(whole.cut.size());
  std::iota(parents.begin(), parents.end(), 0);
  double begin = kFirst;
  for (const PlaneCut& plan : planned) {
    const PlaneCut cut = clearOfVertices(before.rest_vertices, plan, kLeeway);
    cuts.last = cutByPlane(before, cut);
    std::vector<int> composed;
    for (const int parent : cuts.last.triangle_parents) {
      composed.push_back(parent < 0 ? -1 : parents[static_cast<std::size_t>(parent)]);
    }
    parents = composed;
    before = cuts.last.topology;
    cuts.strokes.push_back(makeStroke(cut, cuts.last, tool, begin));
    cuts.edits.push_back({before, parents, sweptPatch(cuts.strokes.back(), tool)});
    begin += kDown_s + kUp_s + kTurn_s;
  }
  return cuts;
}

Scene performCuts(const Stage& stage, const Tool& tool, const Cuts& cuts, const Aftermath& aftermath) {
  const double begin = cuts.strokes.back().begin_s + kDown_s + kUp_s + kRest;
  Play play;
  play.duration_s = begin + kMove + kEnd;
  play.repeats = false;
  const auto T_camera_tool = [=, start = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    return start * toolPose(cuts.strokes, tool, t);
  };
  for (const Actor& actor : toolActors(tool)) play.props.push_back(rigidProp(actor, T_camera_tool));
  Scene scene = perform(stage, play);
  scene.hands = 0;  // the props are the tool
  scene.edits = cuts.edits;
  scene.state = [=, whole = scene.state, strokes = cuts.strokes](double t) {
    SceneState state = whole(t);
    state.T_camera_tool = T_camera_tool(t);
    const auto done = [t](const Stroke& stroke) { return t >= stroke.begin_s + kDown_s; };
    state.revision = static_cast<std::uint32_t>(std::count_if(strokes.begin(), strokes.end(), done));
    if (state.revision == 0) return state;
    const Points& rest = scene.edits[state.revision - 1].topology.rest_vertices;
    const bool after = t > begin;
    state.vertices.at(0) =
        transformed(state.T_camera_body, after ? aftermath(smoothStep((t - begin) / kMove)) : rest);
    return state;
  };
  return scene;
}

MeshTopology wholeBody(const Stage& stage) {
  return topologyOf({stage.actors.at(0).rest, stage.actors.at(0).skin});
}

}  // namespace

Scene cutScene(const Stage& stage, const Tool& tool) {
  const Cuts cuts = makeCuts(wholeBody(stage), {verticalCut(kPlace, angleOf(tool))}, tool);
  return performCuts(stage, tool, cuts, partPieces(cuts.last.topology, kPlace));
}

Scene cutPartialScene(const Stage& stage, const Tool& tool) {
  const MeshTopology body = wholeBody(stage);
  const Cuts cuts = makeCuts(
      body, {partialCut(body, clearOfVertices(body.rest_vertices, verticalCut(kPlace, 0.0), kLeeway))}, tool);
  return performCuts(stage, tool, cuts, openSlit(cuts.last, cuts.strokes.back()));
}

Scene cutCrossScene(const Stage& stage, const Tool& tool) {
  // At larger angles, the doll or the image border would hide the marker.
  constexpr double kFirstAngle = -0.25, kSecondAngle = 0.33;  // [rad]
  const Cuts cuts =
      makeCuts(wholeBody(stage),
               {verticalCut(kCrossPlace, kFirstAngle), verticalCut(kCrossPlace, kSecondAngle)}, tool);
  return performCuts(stage, tool, cuts, partPieces(cuts.last.topology, kCrossPlace));
}

}  // namespace softbody::virtual_camera

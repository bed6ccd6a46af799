#include "elastic/hanging_plays.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "elastic/embedded_body.h"
#include "elastic/holders.h"
#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"
#include "solid/free_motion.h"
#include "solid/held_solid.h"
#include "solid/key_states.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kSupported_s = 1.0;                        // until the support sinks
constexpr double kSupportThick_m = 0.01;                    // it ends on the table
enum HangingRow { kHoldForce, kHoldTorque, kHangingRows };  // after the nodes

/// A clamped body and its weight.
struct HangingBody {
  EmbeddedBody body;
  Clamp clamp;
  Holder holder;
  double density = 0.0;         ///< [kg/m^3]
  Eigen::VectorXd weight = {};  ///< on the nodes [N]
};

Eigen::VectorXd weightOf(const HexSolid& solid, double density, double gravity) {
  const Eigen::VectorXd volumes = solid.nodalVolumes();
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(solid.unknowns());
  for (Eigen::Index i = 0; i < volumes.size(); ++i) weight[3 * i + 2] = -gravity * density * volumes[i];
  return weight;
}

/// The density at which the free end would sink by a share of the body's length, if it sank in proportion.
double densityThatSags(const Stage& stage, const HangingBody& hanging, double share) {
  constexpr double kSmallStrain = 1e-4;
  const HexSolid& solid = hanging.body.solid();
  const Points& rest = hanging.body.restNodes();
  const double length = rest.col(0).maxCoeff() - rest.col(0).minCoeff();
  const double density = kSmallStrain * stage.elasticity.youngs_modulus_pa / (stage.gravity_m_s2 * length);
  const Points sunk = asPoints(heldShape(solid, solid.rest(), hanging.holder.held,
                                         weightOf(solid, density, stage.gravity_m_s2))) -
                      rest;
  Eigen::Index tip = 0;
  rest.col(0).maxCoeff(&tip);
  return density * share * length / -sunk(tip, 2);
}

std::shared_ptr<const HangingBody> hangingBody(const Stage& stage, double share,
                                               const Eigen::Vector3d& cell_m) {
  const TriangleMesh& rest = stage.actors.at(0).rest;
  const Clamp clamp = makeClamp(rest.vertices, tableHeight(stage));
  HangingBody hanging{EmbeddedBody(rest, stage.elasticity, cell_m), clamp, {}};
  hanging.holder = holderOf(clamp, hanging.body.restNodes());
  const auto given = stage.elasticity.density_kg_m3;
  hanging.density = given ? *given : densityThatSags(stage, hanging, share);
  hanging.weight = weightOf(hanging.body.solid(), hanging.density, stage.gravity_m_s2);
  return std::make_shared<const HangingBody>(std::move(hanging));
}

/// How far the nodes have moved, and the rows above. The clamp always carries what it holds.
Points hangingKey(const HangingBody& hanging, const Eigen::VectorXd& nodes) {
  const Points places = asPoints(nodes);
  const Points forces = asPoints(holdingForces(hanging.body.solid(), nodes) - hanging.weight);
  const ContactWrench wrench = wrenchOn(hanging.holder, places, forces);
  Points key(places.rows() + kHangingRows, 3);
  key << places - hanging.body.restNodes(), wrench.force.transpose(), wrench.torque.transpose();
  return key;
}

/// By the share of the weight that nothing but the clamp carries.
KeyStates saggedStates(const HangingBody& hanging) {
  constexpr int kIntervals = 8;
  const HexSolid& solid = hanging.body.solid();
  Eigen::VectorXd last = solid.rest(), nodes = last;
  std::vector<Points> keys = {hangingKey(hanging, nodes)};
  for (int key = 1; key <= kIntervals; ++key) {
    const double share = static_cast<double>(key) / kIntervals;
    const Eigen::VectorXd start = 2.0 * nodes - last;
    last = nodes;
    nodes = heldShape(solid, start, hanging.holder.held, share * hanging.weight);
    keys.push_back(hangingKey(hanging, nodes));
  }
  return {0.0, 1.0, keys};
}

/// Of the body that is let go in its rest shape.
KeyStates swingingStates(const HangingBody& hanging, double damping, double duration_s) {
  constexpr double kInterval_s = 1.0 / 120.0;
  constexpr double kFrame_s = 1.0 / 30.0;  // of the damping
  const HexSolid& solid = hanging.body.solid();
  const FreeMotion motion{solid.rest(), hanging.holder.held, hanging.density, hanging.weight,
                          -std::log(1.0 - damping) / kFrame_s};
  std::vector<Points> keys;
  const int intervals = static_cast<int>(std::lround(duration_s / kInterval_s));
  for (const Eigen::VectorXd& nodes : moveFreely(solid, motion, kInterval_s, intervals))
    keys.push_back(hangingKey(hanging, nodes));
  return {0.0, intervals * kInterval_s, keys};
}

/// A plate on a column, below the whole body. The origin is the middle of its upper side.
TriangleMesh supportMesh(const Points& rest) {
  constexpr double kColumn = 0.016, kDeep = 0.2, kBeyond = 0.01;  // [m]
  const Eigen::Vector3d size = (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).transpose();
  TriangleMesh plate = box({size.x() - kClampLength_m, size.y() + 2.0 * kBeyond, kSupportThick_m});
  plate.vertices.col(2).array() -= 0.5 * kSupportThick_m;
  return merge({plate, capsule({0.0, 0.0, -kSupportThick_m}, {0.0, 0.0, -kDeep}, kColumn)});
}

/// @param height of the support's upper side in the body's frame.
Prop supportProp(const Stage& stage, const std::function<double(double t)>& height) {
  const Points& rest = stage.actors.at(0).rest.vertices;
  const double x = 0.5 * (rest.col(0).maxCoeff() + rest.col(0).minCoeff() + kClampLength_m);
  return rigidProp({supportMesh(rest), darkPaint(), 2.0e-3},
                   [=, T_camera_body = stage.T_camera_body](double t) -> Eigen::Isometry3d {
                     return T_camera_body * Eigen::Translation3d(x, 0.0, height(t));
                   });
}

/// @param states at a time.
Play hangingPlay(const Stage& stage, const std::shared_ptr<const HangingBody>& hanging,
                 const std::function<Points(double t)>& state) {
  const Eigen::Index nodes = hanging->body.restNodes().rows();
  Play play;
  play.repeats = false;
  play.has_weight = true;
  play.material = hanging->body.material();
  play.material->elasticity.density_kg_m3 = hanging->density;
  play.shape = [=](double t) -> Points { return hanging->body.surface(state(t).topRows(nodes)); };
  play.wrenches = [=](double t) -> std::vector<ContactWrench> {
    const Points rows = state(t).bottomRows(kHangingRows);
    return {{"clamp", rows.row(kHoldForce), rows.row(kHoldTorque)}};
  };
  addClamp(stage, hanging->clamp, &play);
  return play;
}

/// @param lowest of the body, at any time. @return the height of the support when it lies on the table.
double requireClear(const Stage& stage, const char* scene, double lowest) {
  const double floor = tableHeight(stage) + kSupportThick_m;
  if (lowest < floor)
    throw std::invalid_argument(fmt::format(
        "{}: the body would sag onto the table; make it stiffer (--youngs-modulus) or lighter (--density)",
        scene));
  return floor;
}

}  // namespace

Play sagPlay(const Stage& stage) {
  constexpr double kSag = 0.2, kSinking = 1.5, kLeaving = 0.5, kHanging = 1.5;  // of the length; [s]
  const auto hanging = hangingBody(stage, kSag, kBendingCell_m);
  const auto states = std::make_shared<const KeyStates>(saggedStates(*hanging));
  const auto state = [=](double t) { return states->at(smoothStep((t - kSupported_s) / kSinking)); };
  Play play = hangingPlay(stage, hanging, state);
  play.name = "sag";
  play.duration_s = kSupported_s + kSinking + kLeaving + kHanging;
  const double leaves = kSupported_s + kSinking, sagged = play.shape(leaves).col(2).minCoeff();
  const double way = sagged - requireClear(stage, "sag", sagged);
  play.props.push_back(supportProp(stage, [=, shape = play.shape](double t) {
    return shape(t).col(2).minCoeff() - way * smoothStep((t - leaves) / kLeaving);
  }));
  return play;
}

Play swingPlay(const Stage& stage) {
  constexpr double kSag = 0.09, kFalling = 0.08, kSwinging = 3.0;  // of the length; [s]
  const auto hanging = hangingBody(stage, kSag, kSwingingCell_m);
  const auto states =
      std::make_shared<const KeyStates>(swingingStates(*hanging, stage.elasticity.damping, kSwinging));
  Play play = hangingPlay(stage, hanging, [=](double t) { return states->at(t - kSupported_s); });
  play.name = "swing";
  play.duration_s = kSupported_s + kSwinging;
  double lowest = 1.0;
  for (double t = kSupported_s; t < play.duration_s; t += 0.01)
    lowest = std::min(lowest, play.shape(t).col(2).minCoeff());
  const double bottom = stage.actors.at(0).rest.vertices.col(2).minCoeff();
  const double way = bottom - requireClear(stage, "swing", lowest);
  play.props.push_back(
      supportProp(stage, [=](double t) { return bottom - way * smoothStep((t - kSupported_s) / kFalling); }));
  return play;
}

}  // namespace softbody::virtual_camera

#include "answering/answer_play.h"

#include <Eigen/Dense>
#include <cmath>
#include <deque>
#include <utility>

#include "answering/answering_body.h"
#include "answering/moving_hand.h"
#include "elastic/holders.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kStiffer = 1.2;       // than the tracker believes
constexpr double kRestHeight_m = 0.3;  // of the hand
constexpr std::size_t kKept = 4;       // states, for motion blur

/// The fingers take the body from above, across its width.
HandShape shapeFor(const TriangleMesh& rest) {
  return {{0.02, 0.01, 0.06},
          {0.021, 0.5 * (rest.vertices.col(1).maxCoeff() - rest.vertices.col(1).minCoeff()) + 1e-3, 0.03}};
}

TriangleMesh palmAndArm(const HandShape& shape) {
  constexpr double kThick = 0.02, kArm = 0.3;
  TriangleMesh palm = box({0.03, 2.0 * (shape.half_inside.y() + 0.03), kThick});
  const double z = -0.5 * (shape.finger.z() + kThick);
  palm.vertices.col(2).array() += z;
  return merge({palm, capsule({0.0, 0.0, z}, {0.0, 0.0, z - kArm}, 0.015)});
}

/// @param place of the hand in the body's frame at the start [m].
Eigen::Isometry3d fromAbove(const Eigen::Isometry3d& T_world_body, const Eigen::Vector3d& place) {
  return T_world_body * Eigen::Translation3d(place) *
         Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitX());
}

/// The hand's motion where nobody commands it.
HandOrder scripted(const Eigen::Isometry3d& T_world_body, double t) {
  const Eigen::Vector3d place = t < 0.5   ? Eigen::Vector3d(0.0, 0.0, kRestHeight_m)
                                : t < 2.0 ? Eigen::Vector3d(0.07, 0.0, 0.08)
                                : t < 3.2 ? Eigen::Vector3d(0.07, 0.0, 0.02)
                                : t < 4.2 ? Eigen::Vector3d(0.07, 0.0, 0.06)
                                : t < 5.0 ? Eigen::Vector3d(0.07, 0.03, 0.06)
                                : t < 6.2 ? Eigen::Vector3d(0.07, 0.03, 0.02)
                                          : Eigen::Vector3d(0.07, 0.03, kRestHeight_m);
  return {false, fromAbove(T_world_body, place), t >= 2.5 && t < 5.6};
}

/// Body and hand over time.
class Answer {
 public:
  Answer(const Stage& stage, std::shared_ptr<HandCommands> commands)
      : stage_(stage),
        T_world_body_(stage.T_camera_world.inverse() * stage.T_camera_body),
        commands_(std::move(commands)),
        shape_(shapeFor(stage.actors.at(0).rest)) {
    stage_.elasticity.youngs_modulus_pa *= kStiffer;
    restart();
  }

  /// In the body's frame at the start.
  Points surfaceAt(double t) {
    const auto [before, after, share] = around(t);
    return (1.0 - share) * before->surface + share * after->surface;
  }

  GripperState handAt(double t) {
    const auto [before, after, share] = around(t);
    const auto between = [s = share](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.translation() = (1.0 - s) * a.translation() + s * b.translation();
      T.linear() = Eigen::Quaterniond(a.linear()).slerp(s, Eigen::Quaterniond(b.linear())).toRotationMatrix();
      return T;
    };
    GripperState state;
    state.T_camera_gripper = between(before->hand.T_world_hand, after->hand.T_world_hand);
    for (const std::size_t side : {0u, 1u})
      state.T_camera_fingers[side] =
          between(before->hand.T_world_fingers[side], after->hand.T_world_fingers[side]);
    state.closed = before->hand.closed;
    return transformed(stage_.T_camera_world, state);
  }

  TrueMaterial material() const { return body_->material(); }
  const HandShape& shape() const { return shape_; }

 private:
  struct Moment {
    Points surface;
    HandContact hand;
  };
  struct Between {
    const Moment *before, *after;
    double share;
  };

  void restart() {
    body_.emplace(stage_.actors.at(0).rest, stage_.elasticity, T_world_body_, stage_.gravity_m_s2, shape_);
    hand_.emplace(shape_, fromAbove(T_world_body_, {0.0, 0.0, kRestHeight_m}));
    moments_.clear();
    steps_ = -1;
    keep();
  }

  void keep() {
    moments_.push_back({transformed(T_world_body_.inverse(), body_->surface()), hand_->contact()});
    if (moments_.size() > kKept) moments_.pop_front();
    ++steps_;
  }

  void advance() {
    HandOrder order = commands_->now();
    if (!order.live) order = scripted(T_world_body_, static_cast<double>(steps_) * kAnswerStep_s);
    hand_->step(order.T_world_hand.value_or(fromAbove(T_world_body_, {0.0, 0.0, kRestHeight_m})), order.close,
                kAnswerStep_s);
    body_->step(hand_->contact());
    keep();
  }

  Between around(double t) {
    const double place = std::max(0.0, t) / kAnswerStep_s;
    const long before = std::lround(std::floor(place + 1e-6));
    if (before <= steps_ - static_cast<long>(moments_.size())) restart();
    while (steps_ <= before) advance();
    const std::size_t row = moments_.size() - 1 - static_cast<std::size_t>(steps_ - before);
    return {&moments_[row], &moments_[row + 1], std::clamp(place - static_cast<double>(before), 0.0, 1.0)};
  }

  Stage stage_;
  Eigen::Isometry3d T_world_body_;
  std::shared_ptr<HandCommands> commands_;
  HandShape shape_;
  std::optional<AnsweringBody> body_;
  std::optional<MovingHand> hand_;
  std::deque<Moment> moments_;  ///< the last ones
  long steps_ = -1;             ///< of the newest moment
};

Texture handPaint() {
  return [](const Eigen::Vector3d&) { return Eigen::Vector3f(0.20f, 0.21f, 0.23f); };
}

}  // namespace

Play answerPlay(const Stage& stage) {
  Play play;
  play.name = "answer";
  play.duration_s = 7.5;
  play.repeats = false;
  play.hand = std::make_shared<HandCommands>();
  const auto answer = std::make_shared<Answer>(stage, play.hand);
  play.material = answer->material();
  play.has_weight = true;
  play.shape = [answer](double t) { return answer->surfaceAt(t); };
  play.gripper = [answer](double t) { return answer->handAt(t); };
  play.props = {rigidProp({palmAndArm(answer->shape()), handPaint(), 4e-3},
                          [answer](double t) { return answer->handAt(t).T_camera_gripper; })};
  for (const std::size_t side : {0u, 1u})
    play.props.push_back(
        rigidProp({box(answer->shape().finger), handPaint(), 4e-3},
                  [answer, side](double t) { return answer->handAt(t).T_camera_fingers.at(side); }));
  return play;
}

}  // namespace softbody::virtual_camera

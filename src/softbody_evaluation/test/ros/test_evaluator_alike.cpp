#include <softbody_msgs/TrackingStatus.h>
#include <test_support/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fixtures/evaluator_bags.h"
#include "report/report_json.h"
#include "report/verdict.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/protocol/tracking_state.h"
#include "softbody_common/ros/conversions.h"

namespace softbody::evaluation {
namespace {

/// The truth's states with material exchanged: the result has the material p where the truth has motion * p.
/// The body of the recording is a box whose vertices are symmetric.
class Exchange {
 public:
  explicit Exchange(const Eigen::Isometry3d& motion) {
    rosbag::Bag bag(recording());
    rosbag::View view(bag, rosbag::TopicQuery("/ground_truth/surface/topology"));
    const MeshTopology mesh = fromMessage(*view.begin()->instantiate<softbody_msgs::MeshTopology>());
    const Points places = transformed(mesh.rest_vertices, motion);
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
      Eigen::Index image = 0;
      (mesh.rest_vertices.rowwise() - places.row(v)).rowwise().squaredNorm().minCoeff(&image);
      images_.push_back(static_cast<std::size_t>(image));
    }
  }

  bool operator()(softbody_msgs::MeshState* state, int /*frame*/) const {
    const auto truth = state->vertices;
    for (std::size_t v = 0; v < images_.size(); ++v) state->vertices[v] = truth[images_[v]];
    return true;
  }

 private:
  std::vector<std::size_t> images_;
};

/// Adds what the tracker said of each frame of the recording, as in a bag of replay.
void addStatuses(const std::string& result,
                 const std::function<void(softbody_msgs::TrackingStatus*, int)>& say) {
  std::vector<ros::Time> stamps;
  {
    rosbag::Bag bag(recording());
    for (const rosbag::MessageInstance& m :
         rosbag::View(bag, rosbag::TopicQuery("/ground_truth/surface/state")))
      stamps.push_back(m.getTime());
  }
  rosbag::Bag bag(result, rosbag::bagmode::Append);
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    softbody_msgs::TrackingStatus status;
    status.header.stamp = stamps[k];
    status.state = softbody_msgs::TrackingStatus::TRACKING;
    say(&status, static_cast<int>(k));
    bag.write("/softbody/status", stamps[k], status);
  }
}

void alike(softbody_msgs::TrackingStatus* status, int /*frame*/) { status->reason = alikeReason(4); }

EvaluatorOptions optionsFor(const std::string& result) {
  EvaluatorOptions options = optionsOf(result);
  return options;
}

Eigen::Isometry3d turn(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle_rad, axis));
}

TEST(PosesThatLookAlike, AreMeasuredModuloTheSymmetryIfTheTrackerSaidSo) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval(), Eigen::Vector3d::UnitZ().eval()}) {
    const std::string result = resultFromTruth("alike.bag", Exchange(turn(M_PI, axis)));
    const Report silent = evaluate(optionsFor(result));
    EXPECT_GT(silent.vertex_error->all.mean, 0.02);
    EXPECT_EQ(judge(silent).level, Level::kWrong);
    EXPECT_FALSE(silent.alike);

    addStatuses(result, alike);
    const Report said = evaluate(optionsFor(result));
    EXPECT_LT(said.vertex_error->all.max, 1e-5);
    EXPECT_EQ(said.vertex_error->unmatched_share, 0.0);
    const Verdict verdict = judge(said);
    EXPECT_EQ(verdict.level, Level::kGood);
    EXPECT_EQ(verdict.premise.find("The tracker took one of 4 poses that look alike."), 0u)
        << verdict.premise;
    EXPECT_TRUE(says(verdict.premise, "turned by 180 degrees"));
    EXPECT_EQ(toJson(said)["alike"]["poses"], 4);
    EXPECT_EQ(toJson(said)["alike"]["same_shape"], true);
  }
}

TEST(PosesThatLookAlike, AnErrorOfTheResultStaysAnError) {
  const Exchange exchange(turn(M_PI, Eigen::Vector3d::UnitZ()));
  const std::string result =
      resultFromTruth("alike_shifted.bag", [&](softbody_msgs::MeshState* state, int frame) {
        return exchange(state, frame) && shift(state, 0.004f);
      });
  addStatuses(result, alike);
  EXPECT_NEAR(evaluate(optionsFor(result)).vertex_error->all.mean, 0.004, 1e-4);
}

TEST(PosesThatLookAlike, TheTruePoseIsSaidToBeTheTrueOne) {
  const std::string result = resultFromTruth("alike_true.bag", asItIs);
  addStatuses(result, alike);
  const Report report = evaluate(optionsFor(result));
  EXPECT_LT(report.vertex_error->all.max, 1e-5);
  EXPECT_TRUE(says(judge(report).premise, "the true one"));
}

TEST(PosesThatLookAlike, APoseInWhichTheMeshDiffersIsAnErrorAndIsSaidFirst) {
  const std::string result = resultFromTruth("alike_wrong.bag", [](softbody_msgs::MeshState* state, int) {
    Points vertices = fromMessage(*state).vertices;
    const Eigen::RowVector3d centre = vertices.colwise().mean();
    vertices =
        ((vertices.rowwise() - centre) * turn(0.5 * M_PI, Eigen::Vector3d::UnitZ()).linear().transpose())
            .rowwise() +
        centre;
    for (std::size_t v = 0; v < state->vertices.size(); ++v) {
      const auto row = vertices.row(static_cast<Eigen::Index>(v));
      state->vertices[v].x = static_cast<float>(row.x());
      state->vertices[v].y = static_cast<float>(row.y());
      state->vertices[v].z = static_cast<float>(row.z());
    }
    return true;
  });
  addStatuses(result, alike);
  const Report report = evaluate(optionsFor(result));
  EXPECT_GT(report.vertex_error->all.mean, 0.02);
  const Verdict verdict = judge(report);
  EXPECT_EQ(verdict.level, Level::kWrong);
  EXPECT_TRUE(says(verdict.premise, "the mesh does not look the same"));
  EXPECT_TRUE(says(verdict.premise, "turned by 90 degrees"));
}

TEST(PosesThatLookAlike, ABodyThatIsFoundAgainMayBeInAnotherPose) {
  const Exchange first(turn(M_PI, Eigen::Vector3d::UnitX())), second(turn(M_PI, Eigen::Vector3d::UnitY()));
  const std::string result =
      resultFromTruth("alike_again.bag", [&](softbody_msgs::MeshState* state, int frame) {
        return frame < kFrames / 2 ? first(state, frame) : second(state, frame);
      });
  addStatuses(result, [](softbody_msgs::TrackingStatus* status, int frame) {
    if (frame == kFrames / 2 - 1) status->state = softbody_msgs::TrackingStatus::LOST;
    alike(status, frame);
  });
  EXPECT_LT(evaluate(optionsFor(result)).vertex_error->all.max, 1e-5);
}

TEST(PosesThatLookAlike, WithoutTruthTheVerdictSaysThatThePoseIsNotKnown) {
  EvaluatorOptions options;
  options.result = resultFromTruth("alike_recorded.bag", asItIs);
  options.recording = recording();
  addStatuses(options.result, alike);
  const Verdict verdict = judge(evaluate(options));
  EXPECT_EQ(verdict.level, Level::kGood);
  EXPECT_TRUE(says(verdict.premise, "is not known"));
}

}  // namespace
}  // namespace softbody::evaluation

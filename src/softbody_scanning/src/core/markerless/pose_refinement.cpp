#include "markerless/pose_refinement.h"

#include <tbb/parallel_for.h>

#include <optional>

#include "markerless/certainty.h"
#include "markerless/pose_graph.h"
#include "markerless/recognition.h"
#include "markerless/view_pairs.h"
#include "softbody_common/statistics/median.h"
#include "softbody_scanning/fusion/depth_view.h"

namespace softbody::scanning {
namespace {

/// Two frames that see the same.
struct ViewPair {
  int from = 0, to = 0;
  RelativePose pose;
};

struct Session {
  std::vector<TrackedFrame> frames;
  double inverse_depth_std = 0.0, depth_m = 0.0;
};

Session prepare(const std::vector<KeyFrame>& frames) {
  Session session;
  session.inverse_depth_std = measureInverseDepthNoise(frames);
  session.frames.resize(frames.size());
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    session.frames[i] = followedFrame(frames[i].camera, frames[i].color, frames[i].depth);
    addAnchors(session.inverse_depth_std, &session.frames[i]);
  });
  std::vector<double> depths;
  for (const KeyFrame& frame : frames) depths.push_back(medianDepth(frame.depth));
  session.depth_m = median(&depths);
  return session;
}

/// A loop may start far off: then the frames are recognised by their look.
std::optional<ViewPair> alignPair(const std::vector<KeyFrame>& frames, const Session& session,
                                  std::pair<int, int> pair) {
  const KeyFrame &a = frames[pair.first], &b = frames[pair.second];
  const auto estimate = [&](const Eigen::Isometry3d& start) {
    return estimateRelativePose(session.frames[pair.first], session.frames[pair.second], start,
                                session.inverse_depth_std);
  };
  const auto isSure = [&](const RelativePose& pose) {
    return doubtAbout(pose, session.depth_m, session.inverse_depth_std).empty();
  };
  ViewPair aligned{pair.first, pair.second, estimate(b.T_camera_model * a.T_camera_model.inverse())};
  if (isSure(aligned.pose)) return aligned;
  if (pair.second - pair.first <= kLoopFrames) return std::nullopt;
  const auto start = recognise(lookOf(a.camera, a.color, a.depth), lookOf(b.camera, b.color, b.depth));
  if (!start) return std::nullopt;
  aligned.pose = estimate(*start);
  if (!isSure(aligned.pose)) return std::nullopt;
  return aligned;
}

std::vector<ViewPair> alignPairs(const std::vector<KeyFrame>& frames, const Session& session) {
  const auto pairs = pairViews(frames, session.depth_m);
  std::vector<std::optional<ViewPair>> tried(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(),
                    [&](std::size_t i) { tried[i] = alignPair(frames, session, pairs[i]); });
  std::vector<ViewPair> aligned;
  for (auto& pair : tried)
    if (pair) aligned.push_back(std::move(*pair));
  return aligned;
}

/// Rms disagreement of the loops at the object [m].
double loopError(const std::vector<ViewPair>& pairs, const std::vector<Eigen::Isometry3d>& poses,
                 double depth_m) {
  double squares = 0.0;
  int loops = 0;
  const Eigen::Vector3d place(0.0, 0.0, depth_m);
  for (const ViewPair& pair : pairs) {
    if (pair.to - pair.from <= kLoopFrames) continue;
    const Eigen::Isometry3d T_to_from = poses[pair.to] * poses[pair.from].inverse();
    squares += (T_to_from * (pair.pose.T_to_from.inverse() * place) - place).squaredNorm();
    ++loops;
  }
  return loops > 0 ? std::sqrt(squares / loops) : 0.0;
}

RefinementReport beginReport(const std::vector<ViewPair>& pairs) {
  RefinementReport report;
  report.pairs = static_cast<int>(pairs.size());
  for (const ViewPair& pair : pairs) {
    if (pair.to - pair.from > kLoopFrames) ++report.loops;
    report.pixel_std += pair.pose.pixel_std / static_cast<double>(pairs.size());
  }
  return report;
}

}  // namespace

RefinementReport refinePoses(std::vector<KeyFrame>* frames) {
  const Session session = prepare(*frames);
  const std::vector<ViewPair> pairs = alignPairs(*frames, session);
  RefinementReport report = beginReport(pairs);
  std::vector<Eigen::Isometry3d> poses;
  for (const KeyFrame& frame : *frames) poses.push_back(frame.T_camera_model);
  report.loop_before_m = loopError(pairs, poses, session.depth_m);
  std::vector<PoseEdge> edges;
  for (const ViewPair& pair : pairs)
    edges.push_back({pair.from, pair.to, pair.pose.T_to_from, pair.pose.covariance});
  const auto covariances = adjustPoses(edges, &poses);
  report.loop_after_m = loopError(pairs, poses, session.depth_m);
  double variance = 0.0;
  for (const PoseCovariance& covariance : covariances)
    variance += covarianceAt(covariance, session.depth_m).trace() / static_cast<double>(poses.size());
  report.position_std_m = std::sqrt(variance);
  for (std::size_t i = 0; i < poses.size(); ++i) (*frames)[i].T_camera_model = poses[i];
  return report;
}

}  // namespace softbody::scanning

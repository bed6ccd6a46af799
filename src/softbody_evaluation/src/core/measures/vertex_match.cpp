#include "softbody_evaluation/measures/vertex_match.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::evaluation {
namespace {

/// Distinguishes the copies of a vertex: mean position and normal of the triangles around it. Inside of a cut
/// surface only the normals differ. On its rim the triangles of the cut give the clearest normals.
struct Fans {
  Points centres, normals;
};

/// Vertex normals of the triangles that fill cuts; of all triangles for vertices without a cut triangle.
Points sideNormals(const MeshTopology& topology) {
  std::vector<Eigen::Index> walls;
  for (std::size_t f = 0; f < topology.cut.size(); ++f) {
    if (topology.cut[f]) walls.push_back(static_cast<Eigen::Index>(f));
  }
  const Triangles triangles = topology.triangles(walls, Eigen::all);
  Points normals = vertexNormals(topology.rest_vertices, topology.triangles);
  const Points of_walls = vertexNormals(topology.rest_vertices, triangles);
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    if (!of_walls.row(v).isZero()) normals.row(v) = of_walls.row(v);
  }
  return normals;
}

Fans fansOf(const MeshTopology& topology) {
  Fans fans{Points::Zero(topology.rest_vertices.rows(), 3), sideNormals(topology)};
  Eigen::VectorXd count = Eigen::VectorXd::Zero(topology.rest_vertices.rows());
  for (Eigen::Index f = 0; f < topology.triangles.rows(); ++f) {
    Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) centre += topology.rest_vertices.row(topology.triangles(f, k)) / 3.0;
    for (int k = 0; k < 3; ++k) {
      fans.centres.row(topology.triangles(f, k)) += centre;
      count[topology.triangles(f, k)] += 1.0;
    }
  }
  for (Eigen::Index v = 0; v < fans.centres.rows(); ++v) {
    fans.centres.row(v) =
        count[v] > 0.0 ? (fans.centres.row(v) / count[v]).eval() : topology.rest_vertices.row(v).eval();
  }
  return fans;
}

std::unordered_map<int, std::vector<int>> verticesByParent(const std::vector<int>& parents) {
  std::unordered_map<int, std::vector<int>> vertices;
  for (std::size_t i = 0; i < parents.size(); ++i) vertices[parents[i]].push_back(static_cast<int>(i));
  return vertices;
}

std::size_t pieceCount(const MeshTopology& topology) {
  return topology.triangle_pieces.empty()
             ? 0
             : 1 + *std::max_element(topology.triangle_pieces.begin(), topology.triangle_pieces.end());
}

/// The candidate at the same position and side. Copies have the same position at rest. If the files were
/// welded differently, the position decides first, then the side.
int nearestCopy(const MeshTopology& mine, const Fans& my_fans, Eigen::Index vertex, const MeshTopology& its,
                const Fans& its_fans, const std::vector<int>& candidates, double largest_m) {
  constexpr double kFacing_m = 0.05;  // cost of perpendicular normals; copies have opposite normals
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const int candidate : candidates) {
    const double distance = (its.rest_vertices.row(candidate) - mine.rest_vertices.row(vertex)).norm();
    const double facing = 1.0 - its_fans.normals.row(candidate).dot(my_fans.normals.row(vertex));
    const double cost = distance + (its_fans.centres.row(candidate) - my_fans.centres.row(vertex)).norm() +
                        kFacing_m * facing;
    if (distance > largest_m || cost >= least) continue;
    least = cost;
    best = candidate;
  }
  return best;
}

}  // namespace

std::vector<int> matchVertices(const std::vector<int>& result_parents,
                               const std::vector<int>& truth_parents) {
  std::unordered_map<int, int> truth_of_parent;
  for (std::size_t i = 0; i < truth_parents.size(); ++i)
    truth_of_parent.emplace(truth_parents[i], static_cast<int>(i));
  truth_of_parent.erase(-1);
  std::vector<int> matches;
  matches.reserve(result_parents.size());
  for (const int parent : result_parents) {
    const auto found = truth_of_parent.find(parent);
    matches.push_back(found == truth_of_parent.end() ? -1 : found->second);
  }
  return matches;
}

bool sameMesh(const MeshTopology& mesh, const MeshTopology& truth) {
  constexpr double kShare = 1e-6, kRounding = std::numeric_limits<float>::epsilon();
  const Points& places = truth.rest_vertices;
  if (places.rows() == 0) return false;
  const double diagonal = (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm();
  const double tolerance = kShare * diagonal + kRounding * places.cwiseAbs().maxCoeff();
  const std::vector<int> matches = matchVertices(mesh.vertex_parents, truth.vertex_parents);
  bool any = false;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0) continue;
    any = true;
    const auto offset = mesh.rest_vertices.row(static_cast<Eigen::Index>(i)) - places.row(matches[i]);
    if (offset.norm() > tolerance) return false;
  }
  return any;
}

std::vector<int> matchVertices(const MeshTopology& result, const MeshTopology& truth, double largest_m) {
  const Fans result_fans = fansOf(result), truth_fans = fansOf(truth);
  const auto truth_vertices = verticesByParent(truth.vertex_parents);
  const auto nearestOf = [&](std::size_t i, const std::vector<int>& candidates) {
    const bool of_the_file = result.vertex_parents[i] >= 0;
    return nearestCopy(result, result_fans, static_cast<Eigen::Index>(i), truth, truth_fans, candidates,
                       of_the_file ? std::numeric_limits<double>::infinity() : largest_m);
  };
  std::vector<int> matches(result.vertex_parents.size(), -1);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto candidates = truth_vertices.find(result.vertex_parents[i]);
    if (candidates != truth_vertices.end()) matches[i] = nearestOf(i, candidates->second);
  }
  // Where several cuts meet, a vertex can be matched to a wrong side. The majority of its piece corrects
  // this.
  const PieceMatch pieces = matchPieces(result, truth, matches);
  const std::vector<int> result_pieces = vertexPieces(result), truth_pieces = vertexPieces(truth);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0 || result_pieces[i] < 0) continue;
    const int own = pieces.true_piece[static_cast<std::size_t>(result_pieces[i])];
    if (own < 0 || truth_pieces[static_cast<std::size_t>(matches[i])] == own) continue;
    std::vector<int> candidates;
    for (const int candidate : truth_vertices.at(result.vertex_parents[i])) {
      if (truth_pieces[static_cast<std::size_t>(candidate)] == own) candidates.push_back(candidate);
    }
    if (const int copy = nearestOf(i, candidates); copy >= 0) matches[i] = copy;
  }
  return matches;
}

PieceMatch matchPieces(const MeshTopology& result, const MeshTopology& truth,
                       const std::vector<int>& matches) {
  PieceMatch match;
  match.result_pieces = pieceCount(result);
  match.true_pieces = pieceCount(truth);
  match.true_piece.assign(match.result_pieces, -1);
  const std::vector<int> result_pieces = vertexPieces(result), truth_pieces = vertexPieces(truth);
  std::map<std::pair<int, int>, int> votes;
  int all = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0 || result_pieces[i] < 0) continue;
    ++votes[{result_pieces[i], truth_pieces[static_cast<std::size_t>(matches[i])]}];
    ++all;
  }
  std::vector<std::tuple<int, int, int>> by_votes;  // minus votes, so that most come first
  by_votes.reserve(votes.size());
  for (const auto& [pair, count] : votes) by_votes.emplace_back(-count, pair.first, pair.second);
  std::sort(by_votes.begin(), by_votes.end());
  int right = 0;
  for (const auto& [minus_count, mine, its] : by_votes) {
    int& assigned = match.true_piece[static_cast<std::size_t>(mine)];
    const bool taken =
        std::find(match.true_piece.begin(), match.true_piece.end(), its) != match.true_piece.end();
    if (its < 0 || assigned >= 0 || taken) continue;
    assigned = its;
    right -= minus_count;
  }
  match.vertices_right = all == 0 ? 0.0 : static_cast<double>(right) / all;
  return match;
}

std::vector<int> vertexPieces(const MeshTopology& topology) {
  std::vector<int> pieces(static_cast<std::size_t>(topology.rest_vertices.rows()), -1);
  for (Eigen::Index f = 0; f < topology.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      pieces[static_cast<std::size_t>(topology.triangles(f, k))] =
          static_cast<int>(topology.triangle_pieces[static_cast<std::size_t>(f)]);
    }
  }
  return pieces;
}

std::vector<bool> nearCut(const MeshTopology& topology, double near_m) {
  std::vector<Eigen::Index> corners;
  for (Eigen::Index f = 0; f < topology.triangles.rows(); ++f) {
    if (!topology.cut[static_cast<std::size_t>(f)]) continue;
    for (int k = 0; k < 3; ++k) corners.push_back(topology.triangles(f, k));
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<bool> near(static_cast<std::size_t>(topology.rest_vertices.rows()), false);
  for (Eigen::Index v = 0; v < topology.rest_vertices.rows(); ++v) {
    near[static_cast<std::size_t>(v)] = std::any_of(corners.begin(), corners.end(), [&](Eigen::Index c) {
      return (topology.rest_vertices.row(c) - topology.rest_vertices.row(v)).norm() <= near_m;
    });
  }
  return near;
}

}  // namespace softbody::evaluation

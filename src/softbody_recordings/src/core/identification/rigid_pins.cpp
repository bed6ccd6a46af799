#include "identification/rigid_pins.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

Points rowsOf(const Points& points, const std::vector<int>& rows) {
  Points chosen(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t k = 0; k < rows.size(); ++k)
    chosen.row(static_cast<Eigen::Index>(k)) = points.row(rows[k]);
  return chosen;
}

/// The pins of one region in one frame.
struct HeldNow {
  std::size_t frame = 0;
  std::vector<std::size_t> indices;  ///< in the frame's pins
  Points positions;                  ///< as the frame that they follow moves them [m]
};

/// The same vertices held by a region of a name.
using Holds = std::map<std::pair<std::string, std::vector<int>>, std::vector<HeldNow>>;

Holds holdsOf(const std::vector<SeenFrame>& frames) {
  Holds holds;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const NamedSurroundings& around = frames[f].around;
    std::map<std::string, HeldNow> regions;
    for (std::size_t k = 0; k < around.pins.size(); ++k) regions[around.pins[k]].indices.push_back(k);
    for (auto& [name, held] : regions) {
      std::vector<int> vertices;
      held.frame = f;
      held.positions.resize(static_cast<Eigen::Index>(held.indices.size()), 3);
      for (const std::size_t k : held.indices) {
        held.positions.row(static_cast<Eigen::Index>(vertices.size())) =
            around.all.pins[k].position.transpose();
        vertices.push_back(around.all.pins[k].vertex);
      }
      holds[{name, vertices}].push_back(std::move(held));
    }
  }
  return holds;
}

/// Componentwise.
Points medianPoints(const std::vector<Points>& all) {
  Points median = all.front();
  for (Eigen::Index k = 0; k < median.size(); ++k) {
    std::vector<double> values;
    for (const Points& points : all) values.push_back(points(k));
    median(k) = medianOf(std::move(values));
  }
  return median;
}

/// Where the held vertices are in the first frame of the hold, from all of its frames.
Points placesInFirst(const std::vector<HeldNow>& hold, const std::vector<int>& vertices,
                     const std::vector<SeenFrame>& frames, const Points& rest, double noticeable_m) {
  const Points held_rest = rowsOf(rest, vertices);
  std::vector<Points> near, all;
  for (const HeldNow& now : hold) {
    const Points& seen = frames[now.frame].vertices;
    const Eigen::Isometry3d of_body = fitRigid(rest, seen),
                            T_first_now = fitRigid(now.positions, hold.front().positions);
    const double misfit =
        std::sqrt((transformed(rest, of_body) - seen).squaredNorm() / static_cast<double>(rest.rows()));
    if (misfit < noticeable_m) near.push_back(transformed(held_rest, T_first_now * of_body));
    all.push_back(transformed(held_rest, T_first_now * fitRigid(held_rest, rowsOf(seen, vertices))));
  }
  return medianPoints(near.empty() ? all : near);
}

}  // namespace

std::vector<std::vector<Pin>> rigidPins(const std::vector<SeenFrame>& frames, const Points& rest,
                                        double noticeable_m) {
  std::vector<std::vector<Pin>> pins;
  for (const SeenFrame& frame : frames) pins.push_back(frame.around.all.pins);
  for (const auto& [key, hold] : holdsOf(frames)) {
    const std::vector<int>& vertices = key.second;
    const Points held_rest = rowsOf(rest, vertices);
    const Eigen::Isometry3d T_first_rest =
        fitRigid(held_rest, placesInFirst(hold, vertices, frames, rest, noticeable_m));
    for (const HeldNow& now : hold) {
      const Points places =
          transformed(held_rest, fitRigid(hold.front().positions, now.positions) * T_first_rest);
      for (std::size_t k = 0; k < now.indices.size(); ++k) {
        Pin& pin = pins[now.frame][now.indices[k]];
        pin.position = places.row(static_cast<Eigen::Index>(k)).transpose();
        pin.accuracy_m = 0.0;
      }
    }
  }
  return pins;
}

}  // namespace softbody

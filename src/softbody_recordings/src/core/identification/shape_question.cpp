#include "identification/shape_question.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "softbody_sim/identification/shape_fit.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/object/vertex_region.h"
#include "softbody_sim/surroundings/body_surface.h"

namespace softbody {
namespace {

/// The vertices of all held regions, where they are at rest.
std::vector<Pin> pinsOf(const ShapeQuestion& question, const ObjectDescription& description,
                        const ObjectModel& model, const std::function<void(const std::string&)>& warn) {
  const BodySurface surface = BodySurface(model.visual, model.volume).in(model.volume);
  const Points& rest = model.volume.rest_vertices;
  std::set<int> held;
  for (const std::string& region : question.pins)
    for (const int v : surface.verticesAtRest(fmt::format("the region '{}'", region), boxOf(region), rest))
      held.insert(v);
  for (const PinRegion& region : description.pins) {
    if (!region.frame.empty())
      warn(
          fmt::format("pin '{}' follows frame {}; one shape has no frames, so it is held where it is at rest",
                      region.name, region.frame));
    for (const int v :
         surface.verticesAtRest(fmt::format("the box of pin '{}'", region.name), region.box(), rest))
      held.insert(v);
  }
  if (held.empty())
    throw std::invalid_argument(
        "nothing holds the body: name the held part with --pin REGION, for example --pin \"x<0.01\" [m]");
  std::vector<Pin> pins;
  for (const int v : held) pins.push_back({v, rest.row(v).transpose()});
  return pins;
}

Points loadsOf(const std::vector<RegionLoad>& given, const Points& rest) {
  if (given.empty()) return Points();
  Points loads = Points::Zero(rest.rows(), 3);
  for (const RegionLoad& load : given) {
    const std::vector<int> vertices = verticesWhere(load.region, rest);
    for (const int v : vertices)
      loads.row(v) += load.force.transpose() / static_cast<double>(vertices.size());
  }
  return loads;
}

}  // namespace

MaterialAnswer answer(const ShapeQuestion& question, const ObjectDescription& description,
                      const ObjectModel& model, const std::function<void(const std::string&)>& warn,
                      const std::function<void(double)>& progress) {
  MaterialAnswer answer{problemOf(model, question.material), {}};
  const Points& rest = model.volume.rest_vertices;
  Warnings warnings;
  const SurfaceFile file = readSurfaceFile(question.shape, &warnings);
  for (const std::string& warning : warnings) warn(warning);
  ShapeObservation observation;
  observation.surroundings.pins = pinsOf(question, description, model, warn);
  observation.surroundings.loads = loadsOf(question.loads, rest);
  answer.problem.observations = {observation};
  try {
    answer.estimate = identifyFromShape(answer.problem, model.visual, question.unit_m * file.mesh.vertices,
                                        progress, &answer.problem.observations[0].targets);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", question.shape, error.what()));
  }
  return answer;
}

}  // namespace softbody

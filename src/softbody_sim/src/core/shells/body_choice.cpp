#include "shells/body_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "shells/hole_filling.h"
#include "shells/shell_nesting.h"

namespace softbody {
namespace {

/// Share of the volume that may be left out without a question: less than a snug cage adds.
constexpr double kNegligible = 0.05;
/// Of a file. One with more shells is a scan with dust; only the largest count.
constexpr std::size_t kMostShells = 100;

/// The vector in whole or tenths of a millimetre.
std::string millimetres(const Eigen::Vector3d& metres, const char* separator) {
  const Eigen::Vector3d mm = 1e3 * metres;
  return fmt::format("{:.1f}{}{:.1f}{}{:.1f}", mm[0], separator, mm[1], separator, mm[2]);
}

std::string sizeAndPlace(const Eigen::AlignedBox3d& box, double unit_m) {
  return fmt::format("{} mm at ({}) mm", millimetres(unit_m * box.sizes(), " x "),
                     millimetres(unit_m * box.center(), ", "));
}

/// What was dropped or added before the size is known.
struct Repairs {
  std::vector<Shell> sheets, repeated, dust;
  FilledHoles holes;
  int united = 0;
  std::ptrdiff_t flipped = 0;
};

/// Drops shells. @return those that were dropped.
template <typename Drops>
std::vector<Shell> dropShells(const std::vector<Shell>& shells, const Drops& drops, WeldedSurface* surface) {
  std::vector<Shell> dropped;
  std::vector<Eigen::Index> kept;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (drops(s)) {
      dropped.push_back(shells[s]);
    } else {
      kept.insert(kept.end(), shells[s].triangles.begin(), shells[s].triangles.end());
    }
  }
  if (dropped.empty()) return dropped;
  std::sort(kept.begin(), kept.end());
  keepTriangles(kept, surface);
  return dropped;
}

std::vector<Shell> dropSheets(const std::string& name, WeldedSurface* surface) {
  const std::vector<Shell> shells = shellsOf(surface->mesh);
  const auto largest = std::max_element(shells.begin(), shells.end(), [](const Shell& a, const Shell& b) {
    return std::abs(a.volume) < std::abs(b.volume);
  });
  if (std::all_of(shells.begin(), shells.end(), [](const Shell& shell) { return shell.isSheet(); }))
    throw std::invalid_argument(
        fmt::format("{}: encloses no volume: the mean thickness is {:.2g} of the size. If it is a sheet, "
                    "make a model with "
                    "prepare_model --thickness",
                    name, 2.0 * std::abs(largest->volume) / largest->area / largest->box.diagonal().norm()));
  return dropShells(
      shells, [&](std::size_t s) { return shells[s].isSheet(); }, surface);
}

std::vector<Shell> dropDust(WeldedSurface* surface) {
  const std::vector<Shell> shells = shellsOf(surface->mesh);
  if (shells.size() <= kMostShells) return {};
  std::vector<std::size_t> order(shells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(shells[a].volume) > std::abs(shells[b].volume);
  });
  std::vector<bool> dust(shells.size(), false);
  for (std::size_t k = kMostShells; k < order.size(); ++k) dust[order[k]] = true;
  return dropShells(
      shells, [&](std::size_t s) { return dust[s]; }, surface);
}

void flipOutward(WeldedSurface* surface) {
  std::vector<bool> flip(static_cast<std::size_t>(surface->mesh.triangles.rows()), false);
  for (const Shell& shell : shellsOf(surface->mesh))
    for (const Eigen::Index f : shell.triangles) flip[static_cast<std::size_t>(f)] = shell.volume < 0.0;
  flipTriangles(flip, surface);
}

/// Number of triangles of a surface that were turned over since.
std::ptrdiff_t turnedOver(const Triangles& before, const Triangles& after) {
  std::ptrdiff_t count = 0;
  for (Eigen::Index f = 0; f < std::min(before.rows(), after.rows()); ++f)
    count += before.row(f) == after.row(f) ? 0 : 1;
  return count;
}

void report(const std::vector<Shell>& dropped, const char* what, double unit_m, const std::string& name,
            Warnings* warnings) {
  if (dropped.empty()) return;
  const auto largest = std::max_element(dropped.begin(), dropped.end(),
                                        [](const Shell& a, const Shell& b) { return a.area < b.area; });
  warnings->push_back(fmt::format("{}: {} {}; the largest: {} triangles, {}", name, dropped.size(), what,
                                  largest->triangles.size(), sizeAndPlace(largest->box, unit_m)));
}

void reportAll(const Repairs& done, double unit_m, const std::string& name, Warnings* warnings) {
  report(done.sheets, "surfaces that enclose no volume were dropped", unit_m, name, warnings);
  report(done.repeated, "shells that repeat another one were dropped", unit_m, name, warnings);
  report(done.dust, "shells were dropped as dust", unit_m, name, warnings);
  if (done.holes.count > 0)
    warnings->push_back(fmt::format("{}: {} holes were filled, the widest is {:.1f} mm wide, at ({}) mm",
                                    name, done.holes.count, 1e3 * unit_m * done.holes.widest,
                                    millimetres(unit_m * done.holes.place, ", ")));
  if (done.united > 0)
    warnings->push_back(fmt::format("{}: {} crossing shells were united", name, done.united));
  if (done.flipped > 0)
    warnings->push_back(fmt::format("{}: {} triangles faced inward and were flipped", name, done.flipped));
}

double totalVolume(const std::vector<Body>& bodies) {
  return std::accumulate(bodies.begin(), bodies.end(), 0.0,
                         [](double sum, const Body& body) { return sum + body.volume; });
}

std::string listOf(const std::vector<Body>& bodies, double unit_m) {
  std::string list;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    list += fmt::format("\n  shell {}: {}, {:.4g} cm3, {:.1f} % of the volume", b + 1,
                        sizeAndPlace(bodies[b].box, unit_m), 1e6 * std::pow(unit_m, 3) * bodies[b].volume,
                        100.0 * bodies[b].volume / totalVolume(bodies));
  return list;
}

/// How many of the bodies, largest first, are taken, and from which on.
std::pair<std::size_t, std::size_t> rangeOf(const std::vector<Body>& bodies, const BodyChoice& choice,
                                            const std::string& list, const std::string& name) {
  const std::size_t count = bodies.size();
  if (choice.shell == "all") return {0, count};
  const double rest = totalVolume(bodies) - bodies[0].volume;
  if (count == 1 || choice.shell == "largest" ||
      (choice.shell.empty() && rest <= kNegligible * totalVolume(bodies)))
    return {0, 1};
  const std::size_t number = std::strtoul(choice.shell.c_str(), nullptr, 10);
  if (number >= 1 && number <= count) return {number - 1, number};
  throw std::invalid_argument(
      choice.shell.empty()
          ? fmt::format(
                "{}: holds {} separate bodies; choose with prepare_model --shell NUMBER, --shell largest "
                "or --shell all:{}",
                name, count, list)
          : fmt::format("{}: there is no shell {}; it holds {}:{}", name, choice.shell, count, list));
}

/// Metres per unit: stated, or from the longest side of a body.
double unitOf(const BodyChoice& choice, const Eigen::AlignedBox3d& box) {
  return choice.length_m > 0.0 ? choice.length_m / box.sizes().maxCoeff() : choice.unit_m;
}

}  // namespace

WeldedSurface chosenBody(WeldedSurface surface, const BodyChoice& choice, const std::string& name,
                         Warnings* warnings) {
  Repairs done;
  done.sheets = dropSheets(name, &surface);
  done.holes = fillHoles(&surface);
  done.dust = dropDust(&surface);
  const std::vector<Shell> shells = shellsOf(surface.mesh);
  const std::vector<bool> repeated = repeatedShells(shells);
  done.repeated = dropShells(
      shells, [&](std::size_t s) { return repeated[s]; }, &surface);
  const Triangles as_read = surface.mesh.triangles;
  flipOutward(&surface);
  done.united = uniteShells(&surface);
  orientShells(&surface);
  if (done.united == 0) done.flipped = turnedOver(as_read, surface.mesh.triangles);
  const std::vector<Body> bodies = bodiesOf(surface.mesh);
  const std::string list = listOf(bodies, unitOf(choice, bodies[0].box));
  const auto [first, end] = rangeOf(bodies, choice, list, name);
  std::vector<Eigen::Index> kept;
  Eigen::AlignedBox3d box;
  for (std::size_t b = first; b < end; ++b) {
    kept.insert(kept.end(), bodies[b].triangles.begin(), bodies[b].triangles.end());
    box.extend(bodies[b].box);
  }
  const double unit_m = unitOf(choice, box);
  reportAll(done, unit_m, name, warnings);
  if (bodies.size() > 1) {
    warnings->push_back(fmt::format("{}: holds {} separate bodies; taken: {}:{}", name, bodies.size(),
                                    end - first == 1 ? fmt::format("shell {}", end) : "all",
                                    listOf(bodies, unit_m)));
    std::sort(kept.begin(), kept.end());
    keepTriangles(kept, &surface);
  }
  surface.mesh.vertices *= unit_m;
  return surface;
}

WeldedSurface wholeBody(WeldedSurface surface, double unit_m, const std::string& name, Warnings* warnings) {
  Repairs done;
  done.holes = fillHoles(&surface);
  done.flipped = orientShells(&surface);
  reportAll(done, unit_m, name, warnings);
  surface.mesh.vertices *= unit_m;
  return surface;
}

}  // namespace softbody

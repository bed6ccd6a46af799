#include "softbody_sim/cutting/binding/cuttable_surface.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "cutting/binding/cut_models.h"
#include "cutting/blade/blade_stroke.h"
#include "cutting/blade/tearing.h"
#include "cutting/volume/undo_versions.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

constexpr double kLeastTorn = 0.01;          // smallest piece that a tear may leave, over the body's volume
constexpr std::size_t kMostUnconfirmed = 4;  // edits that can be rolled back
constexpr double kNear = 0.1;  // distance from the body's bounding box beyond which a blade is ignored [m]

Eigen::AlignedBox3d boxOf(const Points& points) {
  return {Eigen::Vector3d(points.colwise().minCoeff()), Eigen::Vector3d(points.colwise().maxCoeff())};
}

/// Overhang of the tets over the visual mesh: the largest distance of a surface vertex from the nearest
/// visual one.
double overhangOf(const TetTopology& volume, const MeshTopology& visual) {
  double most = 0.0;
  for (const int v : volume.surface.reshaped()) {
    const double nearest =
        (visual.rest_vertices.rowwise() - volume.rest_vertices.row(v)).rowwise().squaredNorm().minCoeff();
    most = std::max(most, nearest);
  }
  return std::sqrt(most);
}

/// Volumes of the pieces, largest first.
std::vector<double> volumesOf(const MeshTopology& mesh) {
  std::vector<double> volumes;
  const Eigen::Vector3d origin = mesh.rest_vertices.row(0);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return mesh.rest_vertices.row(mesh.triangles(t, k)).transpose() - origin;
    };
    const std::size_t piece = mesh.triangle_pieces[static_cast<std::size_t>(t)];
    if (piece >= volumes.size()) volumes.resize(piece + 1, 0.0);
    volumes[piece] += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
  }
  std::sort(volumes.begin(), volumes.end(), std::greater<>());
  return volumes;
}

}  // namespace

struct CuttableSurface::Implementation {
  Implementation(const MeshTopology& visual, const TetTopology& volume, const CuttingConfig& config_in)
      : config(config_in),
        models{CutHistory(volume), SurfaceHistory(VisualSurface(visual, volume))},
        solid(visual),
        blade(config, meanEdgeLength(volume.rest_vertices, volume.tets), overhangOf(volume, visual)),
        tears(config.tear_strain) {}

  bool apply(const Cut& cut, const MeshState& state, std::string* reason);
  void liftAfterGap(Nanoseconds stamp);
  CutLimits limits() const {
    return {static_cast<std::size_t>(config.max_pieces),
            static_cast<std::size_t>(1e6 * config.undo_memory_mb)};
  }
  /// A blade that is still in the body must not repeat its motion since it entered.
  void forgetBlade() {
    blade.forgetStrokes();
    blade.lift();
  }

  CuttingConfig config;
  CutModels models;
  std::deque<CutModels>
      unconfirmed;  ///< state before each cut that the simulator has not confirmed, oldest first
  RestSolid solid;
  BladeStroke blade;
  TearWatch tears;
  std::optional<Nanoseconds> followed;  ///< stamp of the last blade
};

/// Works on a copy, so that tets and surface stay consistent if an edit throws.
bool CuttableSurface::Implementation::apply(const Cut& cut, const MeshState& state, std::string* reason) {
  makeRoomFor(cut, &models);
  CutModels next = models;
  const bool made =
      cut.kind == CutKind::kCut ? next.cut(cut, state, limits(), reason) : next.move(cut, limits(), reason);
  if (!made) return false;
  unconfirmed.push_back(std::move(models));
  if (unconfirmed.size() > kMostUnconfirmed) unconfirmed.pop_front();
  models = std::move(next);
  blade.noteNumber(cut.stroke);
  return true;
}

void CuttableSurface::Implementation::liftAfterGap(Nanoseconds stamp) {
  if (followed && (stamp < *followed || seconds(stamp - *followed) > config.max_gap_s)) blade.lift();
  followed = stamp;
}

CuttableSurface::CuttableSurface(const MeshTopology& visual, const TetTopology& volume,
                                 const CuttingConfig& config)
    : implementation_(std::make_unique<Implementation>(visual, volume, config)) {}
CuttableSurface::~CuttableSurface() = default;
CuttableSurface::CuttableSurface(CuttableSurface&&) noexcept = default;
CuttableSurface& CuttableSurface::operator=(CuttableSurface&&) noexcept = default;

const VisualSurface& CuttableSurface::surface() const { return implementation_->models.surface.surface(); }
const TetTopology& CuttableSurface::volume() const { return implementation_->models.tets.topology(); }
const TetTopology& CuttableSurface::uncutVolume() const { return implementation_->models.tets.uncut(); }
const EditHistory& CuttableSurface::edits() const { return implementation_->models.edits(); }

void CuttableSurface::setBody(std::uint64_t body) { implementation_->models.tets.setBody(body); }

std::size_t CuttableSurface::droppedVersions() const {
  return softbody::droppedVersions(implementation_->models);
}

void CuttableSurface::adopt(const EditHistory& edits) {
  Implementation& s = *implementation_;
  CutModels next = s.models;
  next.adopt(edits, s.limits());
  s.models = std::move(next);
  s.unconfirmed.clear();
  for (const Stroke& stroke : edits.strokes) s.blade.noteNumber(stroke.number);
  s.forgetBlade();
}

void CuttableSurface::lift() { implementation_->blade.lift(); }

std::optional<Cut> CuttableSurface::follow(const Points& blade, const MeshState& volume, Nanoseconds stamp) {
  Implementation& s = *implementation_;
  const TetTopology& topology = this->volume();
  s.liftAfterGap(stamp);
  if (volume.revision != topology.revision || volume.vertices.rows() != topology.rest_vertices.rows())
    return std::nullopt;
  if (boxOf(volume.vertices).exteriorDistance(boxOf(blade)) > kNear) {
    s.blade.lift();
    return std::nullopt;
  }
  const RestMap map(topology, volume.vertices, s.solid);
  const std::optional<BladeCut> next = s.blade.follow(blade, map, s.solid);
  if (!next) return std::nullopt;
  const Cut cut{topology.revision + 1, next->stroke, CutKind::kCut, next->patch};
  std::string reason = refusalOf(cut, edits());
  if (!reason.empty()) throw std::invalid_argument(reason);
  if (!s.apply(cut, volume, &reason)) return std::nullopt;
  s.blade.accept();
  return cut;
}

std::optional<Cut> CuttableSurface::tear(const MeshState& volume, const TargetSet& targets) {
  Implementation& s = *implementation_;
  const TetTopology& topology = this->volume();
  if (volume.revision != topology.revision || volume.vertices.rows() != topology.rest_vertices.rows())
    return std::nullopt;
  static const std::vector<Target> kNone;
  const bool usable = targets.revision == topology.revision;
  const std::optional<CutPatch> patch = s.tears.follow(topology, volume, usable ? targets.targets : kNone);
  if (!patch) return std::nullopt;
  const std::vector<double> before = volumesOf(surface().topology());
  const double least = kLeastTorn * std::accumulate(before.begin(), before.end(), 0.0);
  const auto crumbs = [least](const std::vector<double>& volumes) {
    return std::count_if(volumes.begin(), volumes.end(), [least](double v) { return v < least; });
  };
  if (crumbs(preview(*patch).volumes) > crumbs(before)) return std::nullopt;
  Cut cut = separateCut(*patch);
  std::string reason;
  if (!apply(cut, volume, &reason)) return std::nullopt;
  return cut;
}

Cut CuttableSurface::separateCut(const TriangleMesh& patch) const {
  return {volume().revision + 1,
          implementation_->blade.lastNumber() + 1,
          CutKind::kCut,
          {inSinglePrecision(patch.vertices), patch.triangles}};
}

Cut CuttableSurface::edit(CutKind kind) const {
  return {volume().revision + 1, implementation_->blade.lastNumber(), kind, {}};
}

bool CuttableSurface::apply(const Cut& cut, const MeshState& volume, std::string* reason) {
  Implementation& s = *implementation_;
  if (!s.apply(cut, volume, reason)) return false;
  s.forgetBlade();
  return true;
}

void CuttableSurface::confirm(std::uint32_t revision) {
  std::deque<CutModels>& before = implementation_->unconfirmed;
  while (!before.empty() && before.front().tets.topology().revision < revision) before.pop_front();
}

bool CuttableSurface::rollBack(std::uint32_t revision) {
  Implementation& s = *implementation_;
  if (volume().revision == revision) return true;
  const auto kept = std::find_if(s.unconfirmed.begin(), s.unconfirmed.end(), [=](const CutModels& models) {
    return models.tets.topology().revision == revision;
  });
  if (kept == s.unconfirmed.end()) return false;
  s.models = std::move(*kept);
  s.unconfirmed.erase(kept, s.unconfirmed.end());
  s.forgetBlade();
  return true;
}

CutPreview CuttableSurface::preview(const TriangleMesh& patch) const {
  const Cut cut = separateCut(patch);
  SurfaceCut surface_cut = implementation_->models.surface.preview(cut.patch, cut.stroke);
  if (surface_cut.outcome != CutOutcome::kCut) return {surface_cut.reason, {}, {}};
  const std::string refusal = refusalOf(cut, edits());
  if (!refusal.empty()) return {refusal, {}, {}};
  requireFewPieces(surface_cut.mesh, implementation_->limits());
  std::vector<double> volumes = volumesOf(surface_cut.mesh);
  return {"", std::move(volumes), std::move(surface_cut.mesh)};
}

}  // namespace softbody

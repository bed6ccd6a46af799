#include "softbody_sim/cutting/binding/cuttable_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "cutting/binding/surface_history.h"
#include "cutting/blade/blade_stroke.h"
#include "cutting/blade/tearing.h"
#include "cutting/volume/edited_volume.h"
#include "cutting/volume/undo_versions.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/time.h"

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

/// State of a body at rest.
MeshState restOf(const TetTopology& volume) {
  MeshState rest;
  rest.revision = volume.revision;
  rest.vertices = volume.rest_vertices;
  rest.confidence.assign(static_cast<std::size_t>(rest.vertices.rows()), 0.0f);
  return rest;
}

std::size_t pieceCount(const MeshTopology& mesh) {
  const auto& pieces = mesh.triangle_pieces;
  return pieces.empty() ? 0 : *std::max_element(pieces.begin(), pieces.end()) + 1;
}

/// Bounds of a body that is cut.
struct Limits {
  std::size_t pieces = 0;
  std::size_t undo_bytes = 0;
};

/// @throw std::invalid_argument if a cut leaves too many.
void requireFewPieces(const MeshTopology& mesh, const Limits& limits) {
  const std::size_t pieces = pieceCount(mesh);
  if (pieces > limits.pieces) {
    throw std::invalid_argument(
        fmt::format("the cut would leave {} pieces; max_pieces allows up to {}", pieces, limits.pieces));
  }
}

/// The state that cuts change. Copies share everything that an edit does not change.
struct Models {
  CutHistory tets;
  SurfaceHistory surface;

  bool cut(const Cut& cut, const MeshState& state, const Limits& limits, std::string* reason);
  bool move(const Cut& cut, const Limits& limits, std::string* reason);
  /// Cuts the tets, and the visual mesh where that is possible. The body is at rest.
  void cutAtRest(const CutPatch& patch, std::uint32_t stroke);
  void adopt(const EditHistory& edits, const Limits& limits);

  // The versions, as undo_versions.h uses them.
  const EditHistory& edits() const { return tets.edits(); }
  bool has(std::size_t version) const { return tets.has(version) && surface.has(version); }
  std::size_t bytes(std::size_t version) const { return tets.bytes(version) + surface.bytes(version); }
  void drop(std::size_t version) { tets.drop(version), surface.drop(version); }
  Models upTo(std::size_t version) const { return {tets.upTo(version), surface.upTo(version)}; }
  void cutStroke(const Stroke& stroke);
  void takeVersions(const Models& other);
};

bool Models::cut(const Cut& cut, const MeshState& state, const Limits& limits, std::string* reason) {
  *reason = refusalOf(cut, edits());
  if (!reason->empty()) return false;
  SurfaceCut surface_cut = surface.preview(cut.patch, cut.stroke);
  *reason = surface_cut.reason;
  if (surface_cut.outcome != CutOutcome::kCut) return false;
  requireFewPieces(surface_cut.mesh, limits);
  const TetEdit edit = tets.cutOrAdvance(cut.patch, cut.stroke);
  surface.cut(cut.patch, cut.stroke, std::move(surface_cut), edit, state);
  dropVersions(limits.undo_bytes, this);
  return true;
}

bool Models::move(const Cut& cut, const Limits& limits, std::string* reason) {
  const std::size_t version = versionAfter(cut, edits());
  if (!has(version)) restoreVersion(version, limits.undo_bytes, this);
  const std::optional<TetEdit> edit = applyCut(cut, &tets, reason);
  if (!edit) return false;
  const std::uint32_t revision = edit->topology.revision;
  if (cut.kind == CutKind::kUndo) surface.undo(revision);
  if (cut.kind == CutKind::kRedo) surface.redo(revision);
  if (cut.kind == CutKind::kReset) surface.reset(revision);
  dropVersions(limits.undo_bytes, this);
  return true;
}

void Models::cutAtRest(const CutPatch& patch, std::uint32_t stroke) {
  const MeshState rest = restOf(tets.topology());
  SurfaceCut surface_cut = surface.uncutPreview(stroke);
  try {
    SurfaceCut preview = surface.preview(patch, stroke);
    if (preview.outcome == CutOutcome::kCut) surface_cut = std::move(preview);
  } catch (const std::invalid_argument&) {
    // Another program cut the tets along a patch that the visual mesh cannot follow.
  }
  const TetEdit edit = tets.cutOrAdvance(patch, stroke);
  surface.cut(patch, stroke, std::move(surface_cut), edit, rest);
}

void Models::cutStroke(const Stroke& stroke) {
  for (const CutPatch& patch : stroke.patches) cutAtRest(patch, stroke.number);
  tets.closeStroke();
  surface.closeStroke();
}

void Models::takeVersions(const Models& other) {
  tets.takeVersions(other.tets);
  surface.takeVersions(other.surface);
}

void Models::adopt(const EditHistory& edits, const Limits& limits) {
  for (const Cut& edit : editsBetween(tets.edits(), edits)) {
    std::string reason;
    if (edit.kind == CutKind::kCut)
      cutAtRest(edit.patch, edit.stroke);
    else if (!move(edit, limits, &reason))
      throw std::invalid_argument(reason);
    dropVersions(limits.undo_bytes, this);
  }
  const bool same_strokes = sameEdits(tets.edits(), edits);
  tets.take(edits);
  surface.setRevision(edits.revision);
  if (same_strokes) return;
  surface.setStrokeCount(edits.strokes.size());
  if (!edits.is_open) surface.closeStroke();
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
  Limits limits() const {
    return {static_cast<std::size_t>(config.max_pieces),
            static_cast<std::size_t>(1e6 * config.undo_memory_mb)};
  }
  /// A blade that is still in the body must not repeat its motion since it entered.
  void forgetBlade() {
    blade.forgetStrokes();
    blade.lift();
  }

  CuttingConfig config;
  Models models;
  std::deque<Models>
      unconfirmed;  ///< state before each cut that the simulator has not confirmed, oldest first
  RestSolid solid;
  BladeStroke blade;
  TearWatch tears;
  std::optional<Nanoseconds> followed;  ///< stamp of the last blade
};

/// Works on a copy, so that tets and surface stay consistent if an edit throws.
bool CuttableSurface::Implementation::apply(const Cut& cut, const MeshState& state, std::string* reason) {
  Models next = models;
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
  Models next = s.models;
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

std::optional<Cut> CuttableSurface::tear(const MeshState& volume) {
  Implementation& s = *implementation_;
  const TetTopology& topology = this->volume();
  if (volume.revision != topology.revision || volume.vertices.rows() != topology.rest_vertices.rows())
    return std::nullopt;
  const std::optional<CutPatch> patch = s.tears.follow(topology, volume.vertices);
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
  std::deque<Models>& before = implementation_->unconfirmed;
  while (!before.empty() && before.front().tets.topology().revision < revision) before.pop_front();
}

bool CuttableSurface::rollBack(std::uint32_t revision) {
  Implementation& s = *implementation_;
  if (volume().revision == revision) return true;
  const auto kept = std::find_if(s.unconfirmed.begin(), s.unconfirmed.end(), [=](const Models& models) {
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

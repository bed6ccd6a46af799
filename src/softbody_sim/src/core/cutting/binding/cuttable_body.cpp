#include "softbody_sim/cutting/binding/cuttable_body.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "cutting/binding/body_history.h"
#include "cutting/blade/blade_stroke.h"
#include "cutting/blade/tearing.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

constexpr double kLeastTorn = 0.01;  // smallest piece that a tear may leave, over the body's volume
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

struct CuttableBody::Implementation {
  /// What decides on cuts of a visual mesh.
  struct Cutters {
    Cutters(const MeshTopology& visual, const TetTopology& volume, const CuttingConfig& config)
        : solid(visual),
          blade(config, meanEdgeLength(volume.rest_vertices, volume.tets), overhangOf(volume, visual)),
          tears(config.tear_strain) {}

    /// A blade that is still in the body must not repeat its motion since it entered.
    void forgetBlade() {
      blade.forgetStrokes();
      blade.lift();
    }

    RestSolid solid;
    BladeStroke blade;
    TearWatch tears;
    std::optional<Nanoseconds> followed;  ///< stamp of the last blade
  };

  bool apply(const Cut& cut, const MeshState& state, std::string* reason);
  void liftAfterGap(Nanoseconds stamp);
  CutLimits limits() const {
    return {static_cast<std::size_t>(config.max_pieces),
            static_cast<std::size_t>(1e6 * config.undo_memory_mb)};
  }

  CuttingConfig config;
  Follower follower;
  BodyHistory history;
  std::optional<BodyHistory> before = {};  ///< the last edit, unless it was taken back
  std::optional<Cutters> cutters = {};     ///< only with a visual mesh
};

/// Works on a copy, so that nothing has changed if an edit or the follower throws.
bool CuttableBody::Implementation::apply(const Cut& cut, const MeshState& state, std::string* reason) {
  before.reset();
  history.makeRoomFor(cut);
  BodyHistory next = history;
  const std::shared_ptr<const TetEdit> edit = next.apply(cut, state, limits(), reason);
  if (!edit) return false;
  if (follower) follower({edit});
  before = std::exchange(history, std::move(next));
  if (cutters) cutters->blade.noteNumber(cut.stroke);
  return true;
}

void CuttableBody::Implementation::liftAfterGap(Nanoseconds stamp) {
  std::optional<Nanoseconds>& followed = cutters->followed;
  if (followed && (stamp < *followed || seconds(stamp - *followed) > config.max_gap_s)) cutters->blade.lift();
  followed = stamp;
}

CuttableBody::CuttableBody(const MeshTopology& visual, const TetTopology& volume, const CuttingConfig& config,
                           Follower follower)
    : implementation_(new Implementation{config, std::move(follower),
                                         BodyHistory(volume, VisualSurface(visual, volume))}) {
  implementation_->cutters.emplace(visual, volume, config);
}

CuttableBody::CuttableBody(const TetTopology& volume, const CuttingConfig& config, Follower follower)
    : implementation_(new Implementation{config, std::move(follower), BodyHistory(volume, {})}) {}

CuttableBody::~CuttableBody() = default;
CuttableBody::CuttableBody(CuttableBody&&) noexcept = default;
CuttableBody& CuttableBody::operator=(CuttableBody&&) noexcept = default;

const VisualSurface& CuttableBody::surface() const { return implementation_->history.surface(); }
const TetTopology& CuttableBody::volume() const { return implementation_->history.topology(); }
const TetTopology& CuttableBody::uncutVolume() const { return implementation_->history.uncut(); }
const EditHistory& CuttableBody::edits() const { return implementation_->history.edits(); }
void CuttableBody::setBody(std::uint64_t body) { implementation_->history.setBody(body); }
std::size_t CuttableBody::droppedVersions() const { return implementation_->history.droppedVersions(); }

void CuttableBody::adopt(const EditHistory& edits) {
  Implementation& s = *implementation_;
  if (const std::optional<Cut> next_edit = nextEdit(this->edits(), edits)) s.history.makeRoomFor(*next_edit);
  BodyHistory next = s.history;
  const TetEdits made = next.adopt(edits, s.limits());
  if (s.follower) s.follower(made);
  s.history = std::move(next);
  s.before.reset();
  if (!s.cutters) return;
  for (const Stroke& stroke : edits.strokes) s.cutters->blade.noteNumber(stroke.number);
  s.cutters->forgetBlade();
}

std::optional<Cut> CuttableBody::follow(const Points& blade, const MeshState& volume, Nanoseconds stamp) {
  Implementation& s = *implementation_;
  BladeStroke& knife = s.cutters->blade;
  const TetTopology& topology = this->volume();
  s.liftAfterGap(stamp);
  if (volume.revision != topology.revision || volume.vertices.rows() != topology.rest_vertices.rows())
    return std::nullopt;
  if (boxOf(volume.vertices).exteriorDistance(boxOf(blade)) > kNear) {
    knife.lift();
    return std::nullopt;
  }
  const RestMap map(topology, volume.vertices, s.cutters->solid);
  const std::optional<BladeCut> next = knife.follow(blade, map, s.cutters->solid);
  if (!next) return std::nullopt;
  const Cut cut{topology.revision + 1, next->stroke, CutKind::kCut, next->patch};
  std::string reason = refusalOf(cut, edits());
  if (!reason.empty()) throw std::invalid_argument(reason);
  if (!s.apply(cut, volume, &reason)) return std::nullopt;
  knife.accept();
  return cut;
}

std::optional<Cut> CuttableBody::tear(const MeshState& volume, const TargetSet& targets) {
  Implementation& s = *implementation_;
  const TetTopology& topology = this->volume();
  if (volume.revision != topology.revision || volume.vertices.rows() != topology.rest_vertices.rows())
    return std::nullopt;
  static const std::vector<Target> kNone;
  const bool usable = targets.revision == topology.revision;
  const std::optional<CutPatch> patch =
      s.cutters->tears.follow(topology, volume, usable ? targets.targets : kNone);
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

Cut CuttableBody::separateCut(const TriangleMesh& patch) const {
  return {volume().revision + 1,
          implementation_->cutters->blade.lastNumber() + 1,
          CutKind::kCut,
          {inSinglePrecision(patch.vertices), patch.triangles}};
}

Cut CuttableBody::edit(CutKind kind) const {
  return {volume().revision + 1, implementation_->cutters->blade.lastNumber(), kind, {}};
}

bool CuttableBody::apply(const Cut& cut, const MeshState& volume, std::string* reason) {
  Implementation& s = *implementation_;
  if (!s.apply(cut, volume, reason)) return false;
  if (s.cutters) s.cutters->forgetBlade();
  return true;
}

void CuttableBody::takeBack() {
  Implementation& s = *implementation_;
  if (!s.before) return;
  s.history = *std::exchange(s.before, std::nullopt);
  if (s.cutters) s.cutters->forgetBlade();
}

CutPreview CuttableBody::preview(const TriangleMesh& patch) const {
  const Cut cut = separateCut(patch);
  SurfaceCut surface_cut = implementation_->history.preview(cut.patch, cut.stroke);
  if (surface_cut.outcome != CutOutcome::kCut) return {surface_cut.reason, {}, {}};
  const std::string refusal = refusalOf(cut, edits());
  if (!refusal.empty()) return {refusal, {}, {}};
  requireFewPieces(surface_cut.mesh, implementation_->limits());
  std::vector<double> volumes = volumesOf(surface_cut.mesh);
  return {"", std::move(volumes), std::move(surface_cut.mesh)};
}

}  // namespace softbody

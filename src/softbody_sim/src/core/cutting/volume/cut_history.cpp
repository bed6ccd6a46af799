#include "cutting/volume/cut_history.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

/// Per tet after a cut, the earlier tet that contains it.
std::vector<int> parentsOf(const TetEdit& edit) {
  std::vector<int> parents(static_cast<std::size_t>(edit.topology.tets.rows()), -1);
  for (std::size_t t = 0; t < edit.successors.size(); ++t) {
    for (const int part : edit.successors[t]) parents[static_cast<std::size_t>(part)] = static_cast<int>(t);
  }
  return parents;
}

/// Composes two cuts. A vertex of a part lies in the smallest face of the part's ancestor that contains it,
/// so the vertices of its origin are vertices of the ancestor.
TetEdit composed(const TetTopology& start, const TetEdit& first, TetEdit second) {
  const std::vector<int> parents = parentsOf(first);
  for (MaterialPoint& origin : second.vertex_origins) {
    MaterialPoint place{parents[static_cast<std::size_t>(origin.tet)], Eigen::Vector4d::Zero()};
    const Eigen::RowVector4i ancestor = start.tets.row(place.tet);
    for (int k = 0; k < 4; ++k) {
      if (origin.barycentric[k] == 0.0) continue;
      const int between = first.topology.tets(origin.tet, k);
      const MaterialPoint& corner = first.vertex_origins[static_cast<std::size_t>(between)];
      for (int j = 0; j < 4; ++j) {
        if (corner.barycentric[j] == 0.0) continue;
        const int* found = std::find(ancestor.data(), ancestor.data() + 4, start.tets(corner.tet, j));
        place.barycentric[found - ancestor.data()] += origin.barycentric[k] * corner.barycentric[j];
      }
    }
    origin = place;
  }
  std::vector<std::vector<int>> successors(first.successors.size());
  for (std::size_t t = 0; t < successors.size(); ++t) {
    for (const int part : first.successors[t]) {
      const std::vector<int>& further = second.successors[static_cast<std::size_t>(part)];
      successors[t].insert(successors[t].end(), further.begin(), further.end());
    }
  }
  second.successors = std::move(successors);
  return second;
}

/// The edit back to an earlier version. Cuts keep the indices of vertices, so every earlier vertex still
/// exists. @param parents per tet of the later topology, the earlier tet that contains it.
TetEdit inverted(const TetTopology& later, const std::vector<int>& parents, const TetEdit& earlier) {
  TetEdit edit{earlier.topology, earlier.cut, {}, {}};
  edit.vertex_origins = placesOfVertices(later);
  edit.vertex_origins.resize(static_cast<std::size_t>(earlier.topology.rest_vertices.rows()));
  for (const int parent : parents) edit.successors.push_back({parent});
  return edit;
}

/// An edit without changes.
TetEdit unchanged(const TetTopology& topology, const std::vector<bool>& cut) {
  TetEdit edit{topology, cut, placesOfVertices(topology), {}};
  for (int t = 0; t < static_cast<int>(topology.tets.rows()); ++t) edit.successors.push_back({t});
  return edit;
}

template <typename Element>
std::size_t bytesOf(const std::vector<Element>& elements) {
  return elements.size() * sizeof(Element);
}

std::size_t bytesOf(const TetEdit& edit) {
  const TetTopology& t = edit.topology;
  std::size_t bytes = static_cast<std::size_t>(t.rest_vertices.size()) * sizeof(double) +
                      static_cast<std::size_t>(t.tets.size() + t.surface.size()) * sizeof(int) +
                      bytesOf(t.vertex_parents) + bytesOf(t.tet_pieces) + edit.cut.size() / 8 +
                      bytesOf(edit.vertex_origins) + bytesOf(edit.successors);
  constexpr std::size_t kAllocation = 16;  // overhead of each
  for (const std::vector<int>& successors : edit.successors) bytes += bytesOf(successors) + kAllocation;
  return bytes;
}

}  // namespace

CutHistory::CutHistory(const TetTopology& uncut, const SubdivisionSettings& settings) : settings_(settings) {
  const std::vector<bool> none(static_cast<std::size_t>(uncut.surface.rows()), false);
  std::vector<int> own(static_cast<std::size_t>(uncut.tets.rows()));
  std::iota(own.begin(), own.end(), 0);
  versions_.push_back(makeVersion(unchanged(uncut, none), std::move(own)));
  edits_.revision = uncut.revision;
}

std::shared_ptr<const CutHistory::Version> CutHistory::makeVersion(TetEdit edit,
                                                                   std::vector<int> uncut_tets) {
  const std::size_t bytes = bytesOf(edit) + bytesOf(uncut_tets);
  return std::make_shared<Version>(Version{std::move(edit), std::move(uncut_tets), bytes});
}

std::shared_ptr<const TetEdit> CutHistory::version() const {
  const std::shared_ptr<const Version>& version = versions_[edits_.in_force];
  return {version, &version->edit};
}

CutStroke CutHistory::strokeFor(std::uint32_t number) const {
  return stroke_number_ == number ? stroke_ : CutStroke{};
}

std::optional<TetEdit> CutHistory::preview(const CutPatch& patch, std::uint32_t stroke,
                                           std::string* reason) const {
  CutStroke copy = strokeFor(stroke);
  return cutTets(topology(), cut(), patch, settings_, &copy, reason);
}

std::optional<TetEdit> CutHistory::grow(const CutPatch& patch, std::uint32_t stroke, std::string* reason) {
  CutStroke grown = strokeFor(stroke);
  std::optional<TetEdit> edit = cutTets(topology(), cut(), patch, settings_, &grown, reason);
  edits_.is_open = edits_.is_open && stroke_number_ == stroke;
  stroke_ = std::move(grown);
  stroke_number_ = stroke;
  return edit;
}

void CutHistory::record(const TetEdit& edit, const CutPatch& patch) {
  std::vector<int> uncut_tets = parentsOf(edit);
  for (int& tet : uncut_tets) tet = present().uncut_tets[static_cast<std::size_t>(tet)];
  TetEdit whole = edit;
  if (edits_.is_open)
    whole = composed(versions_[edits_.in_force - 1]->edit.topology, present().edit, std::move(whole));
  addEdit({edit.topology.revision, *stroke_number_, CutKind::kCut, patch}, &edits_);
  versions_.resize(edits_.in_force);
  versions_.push_back(makeVersion(std::move(whole), std::move(uncut_tets)));
}

std::optional<TetEdit> CutHistory::cut(const CutPatch& patch, std::uint32_t stroke, std::string* reason) {
  std::optional<TetEdit> edit = grow(patch, stroke, reason);
  if (edit) record(*edit, patch);
  return edit;
}

TetEdit CutHistory::cutOrAdvance(const CutPatch& patch, std::uint32_t stroke) {
  std::string reason;
  std::optional<TetEdit> edit = grow(patch, stroke, &reason);
  if (!edit) {
    edit = unchanged(topology(), cut());
    ++edit->topology.revision;
  }
  record(*edit, patch);
  return *edit;
}

std::optional<TetEdit> CutHistory::undo() {
  return edits_.in_force == 0 ? std::nullopt : moveTo(edits_.in_force - 1, CutKind::kUndo);
}

std::optional<TetEdit> CutHistory::redo() {
  return edits_.in_force == edits_.strokes.size() ? std::nullopt
                                                  : moveTo(edits_.in_force + 1, CutKind::kRedo);
}

std::optional<TetEdit> CutHistory::reset() {
  return edits_.in_force == 0 ? std::nullopt : moveTo(0, CutKind::kReset);
}

std::optional<TetEdit> CutHistory::moveTo(std::size_t version, CutKind kind) {
  if (!has(version)) throw std::logic_error("the version of an undo or redo was dropped");
  TetEdit edit = versions_[version]->edit;
  if (kind == CutKind::kUndo) edit = inverted(topology(), parentsOf(present().edit), edit);
  if (kind == CutKind::kReset) edit = inverted(topology(), present().uncut_tets, edit);
  edit.topology.revision = edits_.revision + 1;
  addEdit({edit.topology.revision, 0, kind, {}}, &edits_);
  setRevision(edit.topology.revision);
  closeStroke();
  return edit;
}

void CutHistory::setRevision(std::uint32_t revision) {
  edits_.revision = revision;
  if (topology().revision == revision) return;
  auto renumbered = std::make_shared<Version>(present());
  renumbered->edit.topology.revision = revision;
  versions_[edits_.in_force] = std::move(renumbered);
}

void CutHistory::closeStroke() {
  stroke_ = {};
  stroke_number_.reset();
  edits_.is_open = false;
}

void CutHistory::take(const EditHistory& edits) {
  if (!sameEdits(edits_, edits)) {
    if (!edits.is_open) closeStroke();
    versions_.resize(edits_.in_force + 1);
    versions_.resize(edits.strokes.size() + 1);
  }
  edits_ = edits;
  setRevision(edits.revision);
}

CutHistory CutHistory::upTo(std::size_t version) const {
  CutHistory copy = *this;
  copy.closeStroke();
  copy.versions_.resize(version + 1);
  copy.edits_.strokes.resize(version);
  copy.edits_.in_force = version;
  copy.edits_.revision = copy.topology().revision;
  return copy;
}

void CutHistory::cutStroke(const Stroke& stroke) {
  for (const CutPatch& patch : stroke.patches) cutOrAdvance(patch, stroke.number);
  closeStroke();
}

void CutHistory::takeVersions(const CutHistory& other) {
  for (std::size_t k = 0; k < std::min(versions_.size(), other.versions_.size()); ++k) {
    if (!versions_[k]) versions_[k] = other.versions_[k];
  }
}

}  // namespace softbody

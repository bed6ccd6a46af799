#include "cutting/volume/cut_history.h"

#include <algorithm>
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

/// The inverse of a cut. Cuts keep the indices of vertices, so every earlier vertex still exists.
TetEdit inverted(const TetEdit& cut, const TetEdit& before) {
  TetEdit edit{before.topology, before.cut, {}, {}};
  edit.vertex_origins = placesOfVertices(cut.topology);
  edit.vertex_origins.resize(static_cast<std::size_t>(before.topology.rest_vertices.rows()));
  for (const int parent : parentsOf(cut)) edit.successors.push_back({parent});
  return edit;
}

/// An edit without changes.
TetEdit unchanged(const TetTopology& topology, const std::vector<bool>& cut) {
  TetEdit edit{topology, cut, placesOfVertices(topology), {}};
  for (int t = 0; t < static_cast<int>(topology.tets.rows()); ++t) edit.successors.push_back({t});
  return edit;
}

}  // namespace

CutHistory::CutHistory(const TetTopology& uncut, const SubdivisionSettings& settings) : settings_(settings) {
  const std::vector<bool> none(static_cast<std::size_t>(uncut.surface.rows()), false);
  versions_.push_back(std::make_shared<TetEdit>(unchanged(uncut, none)));
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
  stroke_has_version_ = stroke_has_version_ && stroke_number_ == stroke;
  stroke_ = std::move(grown);
  stroke_number_ = stroke;
  return edit;
}

void CutHistory::record(const TetEdit& edit) {
  versions_.resize(at_ + 1);
  if (stroke_has_version_) {
    versions_[at_] = std::make_shared<TetEdit>(composed(versions_[at_ - 1]->topology, *versions_[at_], edit));
  } else {
    versions_.push_back(std::make_shared<TetEdit>(edit));
    ++at_;
    stroke_has_version_ = true;
  }
}

std::optional<TetEdit> CutHistory::cut(const CutPatch& patch, std::uint32_t stroke, std::string* reason) {
  std::optional<TetEdit> edit = grow(patch, stroke, reason);
  if (edit) record(*edit);
  return edit;
}

TetEdit CutHistory::cutOrAdvance(const CutPatch& patch, std::uint32_t stroke) {
  std::string reason;
  std::optional<TetEdit> edit = grow(patch, stroke, &reason);
  if (!edit) {
    edit = unchanged(topology(), cut());
    ++edit->topology.revision;
  }
  record(*edit);
  return *edit;
}

std::optional<TetEdit> CutHistory::undo() { return at_ == 0 ? std::nullopt : moveTo(at_ - 1); }

std::optional<TetEdit> CutHistory::redo() {
  return at_ + 1 == versions_.size() ? std::nullopt : moveTo(at_ + 1);
}

std::optional<TetEdit> CutHistory::reset() { return at_ == 0 ? std::nullopt : moveTo(0); }

std::optional<TetEdit> CutHistory::moveTo(std::size_t version) {
  const std::uint32_t revision = topology().revision + 1;
  TetEdit edit;
  if (version > at_) {
    edit = *versions_[version];
  } else {
    TetEdit cuts = *versions_[version + 1];
    for (std::size_t v = version + 2; v <= at_; ++v)
      cuts = composed(versions_[version]->topology, cuts, *versions_[v]);
    edit = inverted(cuts, *versions_[version]);
  }
  at_ = version;
  TetEdit renumbered = *versions_[at_];
  renumbered.topology.revision = edit.topology.revision = revision;
  versions_[at_] = std::make_shared<TetEdit>(std::move(renumbered));
  stroke_ = {};
  stroke_number_.reset();
  stroke_has_version_ = false;
  return edit;
}

}  // namespace softbody

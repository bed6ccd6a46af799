#include "cutting/volume/crack_opening.h"

#include <algorithm>
#include <numeric>

namespace softbody {
namespace {

/// A corner of a tet at the current vertex.
struct Corner {
  int tet;
  int corner;
};

/// The corners at each vertex of the cut faces; empty for other vertices.
std::vector<std::vector<Corner>> cornersAt(const Tets& tets, int vertex_count,
                                           const std::vector<Face>& cut_faces) {
  std::vector<bool> wanted(static_cast<std::size_t>(vertex_count), false);
  for (const Face& face : cut_faces) {
    for (const int vertex : face) wanted[static_cast<std::size_t>(vertex)] = true;
  }
  std::vector<std::vector<Corner>> corners(wanted.size());
  for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
    for (int k = 0; k < 4; ++k) {
      const auto vertex = static_cast<std::size_t>(tets(t, k));
      if (wanted[vertex]) corners[vertex].push_back({t, k});
    }
  }
  return corners;
}

/// A face at the vertex: its other two vertices, and the corner whose tet it belongs to.
struct Wing {
  int low, high, owner;
};

std::vector<Wing> wingsOf(const Tets& tets, const std::vector<Corner>& star) {
  std::vector<Wing> wings;
  wings.reserve(3 * star.size());
  for (int s = 0; s < static_cast<int>(star.size()); ++s) {
    const auto [tet, corner] = star[static_cast<std::size_t>(s)];
    for (int k = 1; k < 4; ++k) {  // the face without the k-th other vertex of the tet
      const int a = tets(tet, (corner + (k == 1 ? 2 : 1)) % 4),
                b = tets(tet, (corner + (k == 3 ? 2 : 3)) % 4);
      wings.push_back({std::min(a, b), std::max(a, b), s});
    }
  }
  std::sort(wings.begin(), wings.end(), [](const Wing& x, const Wing& y) {
    return std::tie(x.low, x.high, x.owner) < std::tie(y.low, y.high, y.owner);
  });
  return wings;
}

/// Per corner of the star, the first corner of its group.
std::vector<int> groupsOf(const Tets& tets, int vertex, const std::vector<Corner>& star,
                          const std::vector<Face>& cut_faces) {
  std::vector<int> leader(star.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&leader](int s) {
    while (leader[static_cast<std::size_t>(s)] != s) s = leader[static_cast<std::size_t>(s)];
    return s;
  };
  const std::vector<Wing> wings = wingsOf(tets, star);
  for (std::size_t k = 0; k + 1 < wings.size(); ++k) {
    const Wing &one = wings[k], &other = wings[k + 1];
    if (one.low != other.low || one.high != other.high) continue;
    Face face{vertex, one.low, one.high};
    std::sort(face.begin(), face.end());
    if (std::binary_search(cut_faces.begin(), cut_faces.end(), face)) continue;
    const auto [first, last] = std::minmax({find(one.owner), find(other.owner)});
    leader[static_cast<std::size_t>(last)] = first;
  }
  for (int& s : leader) s = find(s);
  return leader;
}

}  // namespace

Face faceOf(const Tets& tets, int tet, int corner) {
  Face face{tets(tet, (corner + 1) % 4), tets(tet, (corner + 2) % 4), tets(tet, (corner + 3) % 4)};
  std::sort(face.begin(), face.end());
  return face;
}

OpenedTets openCrack(const Tets& tets, int vertex_count, const std::vector<Face>& cut_faces) {
  OpenedTets result{tets, {}};
  const auto corners = cornersAt(tets, vertex_count, cut_faces);
  for (int vertex = 0; vertex < vertex_count; ++vertex) {
    const std::vector<Corner>& star = corners[static_cast<std::size_t>(vertex)];
    const std::vector<int> groups = groupsOf(tets, vertex, star, cut_faces);
    std::vector<int> copies(star.size(), -1);  // per group, at its first corner
    for (std::size_t s = 0; s < star.size(); ++s) {
      if (groups[s] == 0) continue;
      int& copy = copies[static_cast<std::size_t>(groups[s])];
      if (copy < 0) {
        copy = vertex_count + static_cast<int>(result.copied_from.size());
        result.copied_from.push_back(vertex);
      }
      result.tets(star[s].tet, star[s].corner) = copy;
    }
  }
  return result;
}

}  // namespace softbody

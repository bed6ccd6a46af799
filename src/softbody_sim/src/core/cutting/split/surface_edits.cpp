#include "cutting/split/surface_edits.h"

#include <algorithm>

namespace softbody {
namespace {

/// Half-edges that start at the given one's start.
std::vector<int> starOf(const SplitSurface& surface, int half_edge) {
  std::vector<int> star;
  int h = half_edge;
  do {
    star.push_back(h);
    h = surface.mates[previousHalfEdge(h)];
  } while (h != half_edge);
  return star;
}

std::vector<int> neighboursOf(const SplitSurface& surface, int half_edge) {
  std::vector<int> neighbours;
  for (const int h : starOf(surface, half_edge)) neighbours.push_back(endOf(surface.triangles, h));
  std::sort(neighbours.begin(), neighbours.end());
  return neighbours;
}

/// Signed number of times that the curve runs along the half-edge.
int flow(const SplitSurface& surface, int h) {
  return (surface.curve[h] >= 0 ? 1 : 0) - (surface.curve[surface.mates[h]] >= 0 ? 1 : 0);
}

int facetOf(const SplitSurface& surface, int h) {
  return std::max(surface.curve[h], surface.curve[surface.mates[h]]);
}

void setFlow(int h, int flow, int facet, SplitSurface* surface) {
  surface->curve[h] = flow > 0 ? facet : -1;
  surface->curve[surface->mates[h]] = flow < 0 ? facet : -1;
}

void makeMates(int h, int g, SplitSurface* surface) {
  surface->mates[h] = g;
  surface->mates[g] = h;
}

/// The sum of the flows of a triangle's second and third edge, which coincide when its first edge is
/// collapsed.
int joinedFlow(const SplitSurface& surface, int h) {
  return flow(surface, previousHalfEdge(h)) - flow(surface, nextHalfEdge(h));
}

/// Removes a triangle: its second and third edge become one.
void removeTriangle(int h, SplitSurface* surface) {
  const int second = nextHalfEdge(h), third = previousHalfEdge(h);
  const int joined = joinedFlow(*surface, h);
  const int facet = std::max(facetOf(*surface, second), facetOf(*surface, third));
  const int kept = surface->mates[second], other = surface->mates[third];
  makeMates(kept, other, surface);
  setFlow(kept, joined, facet, surface);
  surface->triangles[h / 3] = {-1, -1, -1};
  for (const int removed : {h, second, third}) surface->curve[removed] = -1;
}

/// Texture coordinates after bendEdgeToApex: the corner lies on the edge, in the texture of the edge's mate.
void flipTexture(int h, double along, SplitSurface* surface) {
  const int g = surface->mates[h], f = h / 3, e = g / 3;
  auto& texture = surface->texture;
  const Eigen::Vector2d at_a = texture[nextHalfEdge(g)], at_b = texture[g],
                        at_opposite = texture[previousHalfEdge(g)];
  const Eigen::Vector2d at_apex = (1.0 - along) * at_a + along * at_b;
  texture[3 * f] = at_a, texture[3 * f + 1] = at_opposite, texture[3 * f + 2] = at_apex;
  texture[3 * e] = at_b, texture[3 * e + 1] = at_apex, texture[3 * e + 2] = at_opposite;
}

/// Gives the corners at the start of a half-edge the texture coordinates of its end. Corners on another side
/// of a seam keep theirs.
void moveTexture(int half_edge, SplitSurface* surface) {
  const int mate = surface->mates[half_edge];
  auto& texture = surface->texture;
  const Eigen::Vector2d from = texture[half_edge], from_mate = texture[nextHalfEdge(mate)],
                        to = texture[nextHalfEdge(half_edge)], to_mate = texture[mate];
  for (const int h : starOf(*surface, half_edge)) {
    if (sameTexture(texture[h], from)) {
      texture[h] = to;
    } else if (sameTexture(texture[h], from_mate)) {
      texture[h] = to_mate;
    }
  }
}

}  // namespace

bool collapseEdge(int half_edge, SplitSurface* surface) {
  const int mate = surface->mates[half_edge];
  const std::vector<int> start_neighbours = neighboursOf(*surface, half_edge);
  const std::vector<int> end_neighbours = neighboursOf(*surface, mate);
  std::vector<int> common;
  std::set_intersection(start_neighbours.begin(), start_neighbours.end(), end_neighbours.begin(),
                        end_neighbours.end(), std::back_inserter(common));
  if (common.size() != 2 || start_neighbours.size() + end_neighbours.size() <= 6) return false;
  if (std::abs(joinedFlow(*surface, half_edge)) > 1 || std::abs(joinedFlow(*surface, mate)) > 1) return false;

  const int removed = startOf(surface->triangles, half_edge), kept = endOf(surface->triangles, half_edge);
  if (!surface->texture.empty()) moveTexture(half_edge, surface);
  for (const int h : starOf(*surface, half_edge)) surface->triangles[h / 3][h % 3] = kept;
  removeTriangle(half_edge, surface);
  removeTriangle(mate, surface);
  for (int& vertex : surface->node_vertices) {
    if (vertex == removed) vertex = kept;
  }
  return true;
}

bool bendEdgeToApex(int half_edge, double along, SplitSurface* surface) {
  const int h = half_edge, g = surface->mates[h];
  const int h1 = nextHalfEdge(h), h2 = previousHalfEdge(h), g1 = nextHalfEdge(g), g2 = previousHalfEdge(g);
  const int a = startOf(surface->triangles, h), b = startOf(surface->triangles, g);
  const int apex = startOf(surface->triangles, h2), opposite = startOf(surface->triangles, g2);
  const std::vector<int> neighbours = neighboursOf(*surface, h2);
  if (apex == opposite || std::binary_search(neighbours.begin(), neighbours.end(), opposite)) return false;
  const int moved = flow(*surface, h), facet = facetOf(*surface, h);
  const int flow_a = flow(*surface, h2) - moved, flow_b = flow(*surface, h1) - moved;
  if (std::abs(flow_a) > 1 || std::abs(flow_b) > 1) return false;
  setFlow(h2, flow_a, std::max(facet, facetOf(*surface, h2)), surface);
  setFlow(h1, flow_b, std::max(facet, facetOf(*surface, h1)), surface);
  setFlow(h, 0, -1, surface);

  // (a, b, apex) and (b, a, opposite) become (a, opposite, apex) and (b, apex, opposite).
  const int f = h / 3, e = g / 3;
  const std::array<int, 4> outer{g1, h2, h1, g2}, slots{3 * f, 3 * f + 2, 3 * e, 3 * e + 2};
  std::array<int, 4> mates, curves, mate_curves;
  for (int k = 0; k < 4; ++k) {
    mates[k] = surface->mates[outer[k]];
    curves[k] = surface->curve[outer[k]];
    mate_curves[k] = surface->curve[mates[k]];
  }
  if (!surface->texture.empty()) flipTexture(h, along, surface);
  surface->triangles[f] = {a, opposite, apex};
  surface->triangles[e] = {b, apex, opposite};
  surface->sources[f] = surface->sources[e];
  for (int k = 0; k < 4; ++k) {
    makeMates(slots[k], mates[k], surface);
    surface->curve[slots[k]] = curves[k];
    surface->curve[mates[k]] = mate_curves[k];
  }
  makeMates(3 * f + 1, 3 * e + 1, surface);
  surface->curve[3 * f + 1] = surface->curve[3 * e + 1] = -1;
  return true;
}

namespace {

/// Splits a triangle from the middle of its half-edge to the opposite corner. The triangle keeps the start, a
/// new one gets the end. @return the new triangle; its first half-edge runs from the middle to the end.
int halveTriangle(int h, int middle, SplitSurface* surface) {
  const int f = h / 3, second = nextHalfEdge(h), third = previousHalfEdge(h);
  const int end = endOf(surface->triangles, h), apex = startOf(surface->triangles, third);
  const int added = static_cast<int>(surface->triangles.size());
  surface->triangles.push_back({middle, end, apex});
  surface->sources.push_back(surface->sources[f]);
  surface->mates.insert(surface->mates.end(), 3, -1);
  surface->curve.insert(surface->curve.end(), {surface->curve[h], surface->curve[second], -1});
  surface->changed.push_back(added);
  if (!surface->texture.empty()) {
    auto& texture = surface->texture;
    const Eigen::Vector2d at_end = texture[second], at_apex = texture[third];
    const Eigen::Vector2d at_middle = 0.5 * (texture[h] + at_end);
    texture.insert(texture.end(), {at_middle, at_end, at_apex});
    texture[second] = at_middle;
  }
  surface->triangles[f][second % 3] = middle;
  makeMates(3 * added + 1, surface->mates[second], surface);
  makeMates(3 * added + 2, second, surface);
  surface->curve[second] = -1;
  surface->changed.push_back(f);
  return added;
}

}  // namespace

void splitEdge(int half_edge, SplitSurface* surface) {
  const int mate = surface->mates[half_edge];
  const int middle = static_cast<int>(surface->vertices.size());
  surface->vertices.push_back(0.5 * (surface->vertices[startOf(surface->triangles, half_edge)] +
                                     surface->vertices[startOf(surface->triangles, mate)]));
  const int beyond = halveTriangle(half_edge, middle, surface);
  const int beyond_mate = halveTriangle(mate, middle, surface);
  makeMates(half_edge, 3 * beyond_mate, surface);
  makeMates(mate, 3 * beyond, surface);
}

}  // namespace softbody

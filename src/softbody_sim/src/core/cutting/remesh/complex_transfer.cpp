#include "cutting/remesh/complex_transfer.h"

#include <algorithm>
#include <map>

#include "cutting/split/cut_refused.h"

namespace softbody {
namespace {

constexpr int kCompleteRings = 2;  ///< edges from the curve up to which all triangles are in the complex
constexpr int kLooseRings = 1;     ///< edges from the curve up to which vertices may leave
constexpr int kUnknown = -1, kSeveral = -2;

class Extraction {
 public:
  Extraction(const SplitSurface& surface, const CutFill& fill, const std::vector<bool>& is_cut)
      : surface_(surface),
        fill_(fill),
        is_cut_(is_cut),
        numbers_(surface.vertices.size(), -1),
        added_(surface.triangles.size(), -1) {}

  CutComplex run() {
    addSkin();
    addFill();
    for (int t = 0; t < static_cast<int>(complex_.triangles.size()); ++t) {
      ComplexTriangle& triangle = complex_.triangles[t];
      const auto& [a, b, c] = triangle.corners;
      triangle.shape = sineOfLeastAngle(complex_.at(a), complex_.at(b), complex_.at(c));
      for (const int v : triangle.corners) complex_.vertices[v].triangles.push_back(t);
    }
    return std::move(complex_);
  }

 private:
  struct Reached {
    int half_edge;  ///< starts at the vertex
    int rings;      ///< edges from the curve
  };

  void addSkin();
  void reach(int half_edge, int rings);
  void addTriangle(int triangle);
  Line lineOf(int half_edge) const;
  std::vector<int> skinVerticesOfFill() const;
  void fixSeparateEdges(const std::vector<int>& skin);
  void addFill();
  int addVertex(const Eigen::Vector3d& position, int skin) {
    complex_.vertices.push_back({position, skin, false});
    return static_cast<int>(complex_.vertices.size()) - 1;
  }

  const SplitSurface& surface_;
  const CutFill& fill_;
  const std::vector<bool>& is_cut_;
  CutComplex complex_;
  std::vector<int> numbers_;      ///< per vertex of the skin, in the complex; or -1
  std::vector<Reached> reached_;  ///< per vertex of the complex
  std::vector<int> added_;        ///< per triangle of the skin, in the complex; or -1
};

void Extraction::reach(int half_edge, int rings) {
  const int vertex = startOf(surface_.triangles, half_edge);
  if (numbers_[vertex] >= 0) return;
  numbers_[vertex] = addVertex(surface_.vertices[vertex], vertex);
  complex_.vertices.back().is_complete = rings <= kCompleteRings;
  complex_.vertices.back().may_leave = rings <= kLooseRings;
  reached_.push_back({half_edge, rings});
}

/// Breadth first from the curve.
void Extraction::addSkin() {
  for (const int h : halfEdgesOfCurve(surface_)) {
    reach(h, 0);
    reach(nextHalfEdge(h), 0);
  }
  for (std::size_t v = 0; v < reached_.size(); ++v) {
    const auto [first, rings] = reached_[v];
    if (rings > kCompleteRings) break;
    int h = first;
    do {
      reach(nextHalfEdge(h), rings + 1);
      reach(previousHalfEdge(h), rings + 1);
      addTriangle(h / 3);
      h = surface_.mates[previousHalfEdge(h)];
    } while (h != first);
  }
}

void Extraction::addTriangle(int t) {
  if (added_[t] >= 0) return;
  added_[t] = static_cast<int>(complex_.triangles.size());
  ComplexTriangle triangle;
  triangle.source = surface_.sources[t];
  triangle.place = t;
  triangle.is_fixed = is_cut_[static_cast<std::size_t>(triangle.source)];
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * t + k;
    triangle.corners[k] = numbers_[startOf(surface_.triangles, h)];
    triangle.curve[k] = surface_.curve[h];
    triangle.lines[k] = lineOf(h);
    if (!surface_.texture.empty()) triangle.texture[k] = surface_.texture[h];
  }
  complex_.triangles.push_back(triangle);
}

Line Extraction::lineOf(int h) const {
  const int mate = surface_.mates[h];
  if (surface_.curve[h] >= 0 || surface_.curve[mate] >= 0) return Line::kCurve;
  if (surface_.texture.empty()) return Line::kNone;
  const auto differ = [this](int a, int b) { return !sameTexture(surface_.texture[a], surface_.texture[b]); };
  return differ(h, nextHalfEdge(mate)) || differ(nextHalfEdge(h), mate) ? Line::kBorder : Line::kNone;
}

/// Per point of the fill, its vertex of the skin. On the two walls of an earlier cut there are several.
std::vector<int> Extraction::skinVerticesOfFill() const {
  std::vector<int> skin(fill_.points.size(), kUnknown);
  const auto note = [&](int point, int vertex) {
    skin[point] = skin[point] == kUnknown || skin[point] == vertex ? vertex : kSeveral;
  };
  for (int h = 0; h < static_cast<int>(fill_.curve.size()); ++h) {
    if (fill_.curve[h] < 0) continue;
    note(startOf(fill_.triangles, h), startOf(surface_.triangles, fill_.curve[h]));
    note(endOf(fill_.triangles, h), endOf(surface_.triangles, fill_.curve[h]));
  }
  return skin;
}

/// The skin does not change at edges of the curve that share no vertex with the fill.
void Extraction::fixSeparateEdges(const std::vector<int>& skin) {
  for (int h = 0; h < static_cast<int>(fill_.curve.size()); ++h) {
    const int on_curve = fill_.curve[h];
    if (on_curve < 0) continue;
    if (skin[startOf(fill_.triangles, h)] >= 0 && skin[endOf(fill_.triangles, h)] >= 0) continue;
    for (const int t : {on_curve / 3, surface_.mates[on_curve] / 3}) {
      complex_.triangles[added_[t]].is_fixed = true;
    }
  }
}

void Extraction::addFill() {
  const std::vector<int> skin = skinVerticesOfFill();
  fixSeparateEdges(skin);
  std::vector<int> numbers(fill_.points.size());
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    numbers[p] = skin[p] >= 0 ? numbers_[skin[p]] : addVertex(fill_.points[p], -1);
    if (skin[p] == kSeveral) complex_.vertices[numbers[p]].may_leave = false;
  }
  for (int t = 0; t < static_cast<int>(fill_.triangles.size()); ++t) {
    ComplexTriangle triangle;
    triangle.sheet = Sheet::kFill;
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * t + k, start = startOf(fill_.triangles, h), end = endOf(fill_.triangles, h);
      triangle.corners[k] = numbers[start];
      if (fill_.mates[h] < 0) triangle.lines[k] = fill_.curve[h] < 0 ? Line::kBorder : Line::kCurve;
      if (skin[start] < 0 || skin[end] < 0) triangle.curve[k] = fill_.curve[h];
    }
    complex_.triangles.push_back(triangle);
  }
}

class Writing {
 public:
  Writing(const CutComplex& complex, SplitSurface* surface, CutFill* fill)
      : complex_(complex), surface_(*surface), fill_(*fill), skin_(complex.vertices.size()) {}

  void run() {
    numberSkin();
    freePlaces();
    placeTriangles();
    pairHalfEdges(surface_.triangles, loose_, &surface_.mates);
    writeFill();
  }

 private:
  void numberSkin();
  void freePlaces();
  void placeTriangles();
  void writeTriangle(const ComplexTriangle& triangle, int place);
  void writeFill();
  void joinFill(const std::vector<const ComplexTriangle*>& triangles);

  const CutComplex& complex_;
  SplitSurface& surface_;
  CutFill& fill_;
  std::vector<int> skin_;    ///< per vertex of the complex, in the split surface; -1: of the fill only
  std::vector<int> places_;  ///< of removed triangles
  std::vector<int> loose_;   ///< half-edges to be paired
};

void Writing::numberSkin() {
  for (std::size_t v = 0; v < skin_.size(); ++v) {
    skin_[v] = complex_.vertices[v].skin;
    if (skin_[v] >= 0 || !complex_.hasSheet(static_cast<int>(v), Sheet::kSkin)) continue;
    skin_[v] = static_cast<int>(surface_.vertices.size());
    surface_.vertices.push_back(complex_.vertices[v].position);
  }
}

void Writing::freePlaces() {
  for (const ComplexTriangle& triangle : complex_.triangles) {
    if (triangle.place < 0 || triangle.used()) continue;
    places_.push_back(triangle.place);
    surface_.triangles[triangle.place] = {-1, -1, -1};
  }
  for (const int place : places_) {
    for (int h = 3 * place; h < 3 * place + 3; ++h) {
      surface_.curve[h] = -1;
      if (surface_.used(surface_.mates[h] / 3)) loose_.push_back(surface_.mates[h]);
    }
  }
}

void Writing::placeTriangles() {
  std::size_t next = 0;
  for (const ComplexTriangle& triangle : complex_.triangles) {
    if (triangle.place >= 0 || !triangle.used() || triangle.sheet == Sheet::kFill) continue;
    if (next == places_.size()) {
      places_.push_back(static_cast<int>(surface_.triangles.size()));
      surface_.triangles.emplace_back();
      surface_.sources.push_back(-1);
      surface_.curve.insert(surface_.curve.end(), 3, -1);
      surface_.mates.insert(surface_.mates.end(), 3, -1);
      if (!surface_.texture.empty()) surface_.texture.resize(surface_.texture.size() + 3);
    }
    writeTriangle(triangle, places_[next++]);
  }
}

void Writing::writeTriangle(const ComplexTriangle& triangle, int place) {
  surface_.sources[place] = triangle.source;
  surface_.changed.push_back(place);
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * place + k;
    surface_.triangles[place][k] = skin_[triangle.corners[k]];
    surface_.curve[h] = triangle.curve[k];
    if (!surface_.texture.empty()) surface_.texture[h] = triangle.texture[k];
    loose_.push_back(h);
  }
}

void Writing::writeFill() {
  std::vector<int> numbers(complex_.vertices.size(), -1);
  std::vector<const ComplexTriangle*> written;
  fill_.points.clear();
  fill_.triangles.clear();
  for (const ComplexTriangle& triangle : complex_.triangles) {
    if (!triangle.used() || triangle.sheet == Sheet::kSkin) continue;
    written.push_back(&triangle);
    fill_.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      int& number = numbers[triangle.corners[k]];
      if (number < 0) {
        number = static_cast<int>(fill_.points.size());
        fill_.points.push_back(complex_.at(triangle.corners[k]));
      }
      fill_.triangles.back()[k] = number;
    }
  }
  joinFill(written);
}

/// Finds the mates of the fill's half-edges, and the half-edges of the skin along its border.
void Writing::joinFill(const std::vector<const ComplexTriangle*>& triangles) {
  std::map<std::array<int, 2>, int> curve;
  for (const int h : halfEdgesOfCurve(surface_)) {
    curve[{startOf(surface_.triangles, h), endOf(surface_.triangles, h)}] = h;
  }
  fill_.facets.assign(triangles.size(), -1);
  fill_.curve.assign(3 * triangles.size(), -1);
  fill_.mates.assign(3 * triangles.size(), -1);
  std::vector<int> inner;
  for (int h = 0; h < static_cast<int>(fill_.mates.size()); ++h) {
    const ComplexTriangle& triangle = *triangles[h / 3];
    const int k = h % 3;
    if (!triangle.onLine(k)) {
      inner.push_back(h);
    } else if (triangle.curve[k] >= 0) {
      fill_.curve[h] = triangle.curve[k];
    } else {
      const auto found = curve.find({skin_[triangle.corners[k]], skin_[triangle.corners[(k + 1) % 3]]});
      if (found != curve.end()) {
        fill_.curve[h] = found->second;
      } else if (triangle.lines[k] == Line::kCurve) {
        throw CutRefused("the remeshed faces do not reach the whole curve");
      }
    }
  }
  pairHalfEdges(fill_.triangles, inner, &fill_.mates);
}

}  // namespace

CutComplex complexAround(const SplitSurface& surface, const CutFill& fill, const std::vector<bool>& is_cut) {
  return Extraction(surface, fill, is_cut).run();
}

void writeBack(const CutComplex& complex, SplitSurface* surface, CutFill* fill) {
  Writing(complex, surface, fill).run();
}

}  // namespace softbody

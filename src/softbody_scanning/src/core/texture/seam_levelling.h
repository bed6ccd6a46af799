#pragma once

#include <array>
#include <vector>

#include "texture/charts.h"

namespace softbody::scanning {

/// What is added to a triangle's colour at its corners: BGR, steps of 255.
using CornerColors = std::array<cv::Vec3f, 3>;

/// Two charts that meet at a vertex, and by how much the first one's colour is brighter along the seam there.
struct SeamVertex {
  int vertex, first, second;
  cv::Vec3f difference;
};

/// Colours are compared along the seams' edges, after division by the frames' gains.
std::vector<SeamVertex> compareSeams(const TriangleMesh& mesh, const EdgeNeighbors& neighbors,
                                     const Layout& layout, const std::vector<KeyFrame>& frames,
                                     const std::vector<cv::Vec3f>& gains);

/// Corrections that make the colours at seams equal and change little from vertex to vertex in a chart
/// (Lempitsky and Ivanov 2007). One entry per triangle.
std::vector<CornerColors> levelSeams(const TriangleMesh& mesh, const Layout& layout,
                                     const std::vector<SeamVertex>& seams);

}  // namespace softbody::scanning

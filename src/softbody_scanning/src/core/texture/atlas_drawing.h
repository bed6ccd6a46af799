#pragma once

#include "texture/seam_levelling.h"

namespace softbody::scanning {

/// The frames' charts in the picture, without gains and with the corrections. A border of some texels goes on
/// beyond a chart's edge. Charts that were not seen stay black.
cv::Mat3b drawSeenCharts(const TriangleMesh& mesh, const Layout& layout, const std::vector<KeyFrame>& frames,
                         const std::vector<cv::Vec3f>& gains, const std::vector<CornerColors>& corrections);

/// Paints the charts that were not seen. @param colors #V by 3: BGR, 0..255.
void drawUnseenCharts(const TriangleMesh& mesh, const Layout& layout, const Points& colors,
                      cv::Mat3b* picture);

/// Three rows (u, v, 0) per triangle.
Points textureCoordinates(const TriangleMesh& mesh, const Layout& layout,
                          const std::vector<KeyFrame>& frames);

/// Place of a corner in the picture [texels].
Eigen::Vector2d cornerTexel(const TriangleMesh& mesh, const Layout& layout,
                            const std::vector<KeyFrame>& frames, int triangle, int corner);

}  // namespace softbody::scanning

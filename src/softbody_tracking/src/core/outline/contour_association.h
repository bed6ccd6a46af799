#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>

#include "outline/contour_posterior.h"
#include "prediction/association.h"
#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/images/rasterizer.h"

namespace softbody {

/// A pixel beside a predicted contour: an outline, or a crease between two sides of the body.
struct ContourSample {
  cv::Point pixel;
  Eigen::Vector2d outward;  ///< unit, in the image, across the contour
  double to_edge = 0.0;     ///< distance from the pixel's centre to the contour, along outward [px]
  MaterialPoint place;
  std::uint32_t piece = 0;   ///< of the body
  Eigen::Vector3d position;  ///< camera frame [m]
};

/// Where a rendered body's contours are sampled.
struct ContourGrid {
  cv::Rect region;  ///< without the image's border
  int spacing_px;   ///< between neighbouring samples
};
ContourGrid contourGrid(const RasterImage& image);

/// How much contours count.
struct ContourWeight {
  double per_edge;  ///< of a contour that is one mean edge of the tets long and precise to 1 mm
  double edge_m;    ///< mean edge of the tets
};

/// Only the distance across the contour in the image counts. @param predicted position of the sample, camera
/// frame [m]. @param end on the line across the sample. @param spacing_px between neighbouring samples.
Association contourAssociation(const Pinhole& camera, const ContourSample& sample,
                               const Eigen::Vector3d& predicted, const ContourEnd& end,
                               const ContourWeight& weight, int spacing_px);

}  // namespace softbody

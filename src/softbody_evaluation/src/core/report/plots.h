#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// A line plot with axes from zero. @param x increasing.
cv::Mat3b linePlot(const std::string& title, const std::string& x_label, const std::vector<double>& x,
                   const std::vector<double>& y);

/// Marked values and a line from zero where y is x. @param x increasing.
cv::Mat3b calibrationPlot(const std::string& title, const std::string& x_label, const std::vector<double>& x,
                          const std::vector<double>& y);

/// A histogram from zero to the 99.5th percentile. Larger values are in the last bin.
/// @param scale from the unit of the values to the unit of the label.
cv::Mat3b histogram(const std::string& title, const std::string& x_label, const std::vector<float>& values,
                    double scale);

/// Draws the edges of the triangles that face the camera.
void drawWireframe(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
                   cv::Mat3b* image);

/// Pictures of equal size in rows of `columns` pictures.
cv::Mat3b contactSheet(const std::vector<cv::Mat3b>& pictures, int columns);

}  // namespace softbody::evaluation

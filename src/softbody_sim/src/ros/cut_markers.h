#pragma once

#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "softbody_sim/surface_mesh/cut_lines.h"

/// Markers that show cuts in rviz.
namespace softbody {

/// The lines where cuts meet the outer surface. Without lines, a marker that deletes them.
/// @param vertices of the mesh that the edges are of [m].
visualization_msgs::Marker makeCutLinesMarker(const Edges& lines, const Points& vertices,
                                              const std_msgs::Header& header);

/// The pieces that a cut would leave, each in its own colour and slightly above the surface, and the lines of
/// all cuts. Each message is shown for one second.
/// @param vertices of the mesh after the cut, at the present shape [m].
visualization_msgs::MarkerArray makePreviewMarkers(const MeshTopology& pieces, const Edges& lines,
                                                   const Points& vertices, const std_msgs::Header& header);

/// Deletes a preview.
visualization_msgs::MarkerArray endOfPreview(const std_msgs::Header& header);

}  // namespace softbody

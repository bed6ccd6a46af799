#pragma once

#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "softbody_sim/cutting/cut_lines.h"

/// Cuts as rviz shows them.
namespace softbody {

/// The lines at which cuts meet the skin; a marker that deletes where there are none.
/// @param vertices of the mesh that the edges are of [m].
visualization_msgs::Marker makeCutLinesMarker(const Edges& lines, const Points& vertices,
                                              const std_msgs::Header& header);

/// The pieces that a cut would leave, each in its colour and a hair's breadth outside of the surface, and the
/// lines of all cuts. They vanish if they are not renewed within a second.
/// @param vertices where the would-be mesh is now [m].
visualization_msgs::MarkerArray makePreviewMarkers(const MeshTopology& pieces, const Edges& lines,
                                                   const Points& vertices, const std_msgs::Header& header);

/// Takes a preview away.
visualization_msgs::MarkerArray endOfPreview(const std_msgs::Header& header);

}  // namespace softbody

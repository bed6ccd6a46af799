#pragma once

#include <ros/ros.h>

#include <optional>
#include <vector>

#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/surface_mesh/cut_lines.h"

namespace softbody {

/// Markers of cuts for rviz: the lines of the cuts, and a preview of the pieces. Without subscribers it does
/// nothing.
class CutDisplay {
 public:
  explicit CutDisplay(ros::NodeHandle node);

  /// Another surface is published from now on.
  void onTopologyChanged() { lines_.reset(); }

  /// Shows what a cut would do, for some seconds or until the next edit. @param volume before the cut.
  void startPreview(const CutPreview& preview, const TetTopology& volume);

  /// Publishes the markers of a stamp. @param mesh, surface topology and state of the visual mesh.
  void publish(const MeshTopology& mesh, const MeshState& surface, const MeshState& volume,
               const std_msgs::Header& header);

 private:
  /// Pieces that move with the present tets.
  struct Preview {
    MeshTopology pieces;
    Edges lines;
    TetTopology volume;
    std::vector<MaterialPoint> places;
    std::optional<ros::Time> begin;  ///< stamp of its first markers
  };
  void publishPreview(const MeshState& volume, const std_msgs::Header& header);

  ros::Publisher lines_publisher_, preview_publisher_;
  std::optional<Edges> lines_;  ///< of the surface; computed when needed
  std::optional<Preview> preview_;
};

}  // namespace softbody

#pragma once

#include <ros/ros.h>

#include <optional>
#include <vector>

#include "softbody_sim/cutting/cut_lines.h"
#include "softbody_sim/cutting/cuttable_surface.h"

namespace softbody {

/// What rviz shows of cuts: their lines on the surface, and the pieces that a cut would leave. Nothing is
/// done for it while nobody looks.
class CutDisplay {
 public:
  explicit CutDisplay(ros::NodeHandle node);

  /// Another surface is published from now on.
  void forgetLines() { lines_.reset(); }

  /// Shows what a cut would do, for some seconds or up to the next edit.
  /// @param volume as it is before the cut.
  void preview(const CutPreview& preview, const TetTopology& volume);

  /// The next instant. @param mesh, surface topology and state of the visual mesh.
  void show(const MeshTopology& mesh, const MeshState& surface, const MeshState& volume,
            const std_msgs::Header& header);

 private:
  /// Pieces that follow the tets as they are.
  struct Preview {
    MeshTopology pieces;
    Edges lines;
    TetTopology volume;
    std::vector<MaterialPoint> places;
    std::optional<ros::Time> begin;  ///< stamp of the first state that it was shown with
  };
  void showPreview(const MeshState& volume, const std_msgs::Header& header);

  ros::Publisher lines_publisher_, preview_publisher_;
  std::optional<Edges> lines_;  ///< of the surface; nothing: not looked for yet
  std::optional<Preview> preview_;
};

}  // namespace softbody

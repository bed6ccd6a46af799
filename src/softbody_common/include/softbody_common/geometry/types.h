#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace softbody {

/// #V by 3 vertex positions [m], one row a vertex.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// #F by 3 vertex indices, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// #T by 4 vertex indices, positive volume.
using Tets = Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Stamps in the core are nanoseconds since the epoch (ros::Time without ROS).
using Nanoseconds = std::int64_t;

struct TriangleMesh {
  Points vertices;
  Triangles triangles;
};

struct TetMesh {
  Points vertices;
  Tets tets;
};

/// A point of the rest body: barycentric coordinates in a tet. They sum to 1. A negative coordinate means
/// that the point is outside of the tet.
struct MaterialPoint {
  int tet = -1;
  Eigen::Vector4d barycentric = Eigen::Vector4d::Zero();
};

/// The measurement behind a target (softbody_msgs/Target).
enum class TargetKind : std::uint8_t { kFeature = 0, kDepth = 1, kVertex = 2, kManual = 3, kPrior = 4 };

/// A material point and its measured position. With a normal, only the distance along the normal counts.
struct Target {
  TargetKind kind = TargetKind::kManual;
  MaterialPoint place;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, or zero
  double weight = 1.0;                                 ///< relative to the simulator's target_stiffness, > 0
};

/// The soft constraints of one frame (softbody_msgs/Targets without its header).
struct TargetSet {
  std::uint32_t revision = 0;
  bool reset = false;  ///< discard the state and start from body_pose
  Eigen::Isometry3d body_pose = Eigen::Isometry3d::Identity();  ///< rest frame in the targets' frame
  std::vector<Target> targets;
};

/// The volumetric model at rest and its boundary (softbody_msgs/TetTopology without its header).
struct TetTopology {
  std::uint32_t revision = 0;
  Points rest_vertices;
  Tets tets;
  Triangles surface;                      ///< boundary of the tets, outward
  std::vector<int> vertex_parents;        ///< #V: index in revision 0, or -1
  std::vector<std::uint32_t> tet_pieces;  ///< #T: connected piece, 0..
  bool has_initial_pose = false;
  Eigen::Isometry3d initial_pose =
      Eigen::Isometry3d::Identity();  ///< rest frame in the colour optical frame, rough
};

/// The visual mesh at rest (softbody_msgs/MeshTopology without its header).
struct MeshTopology {
  std::uint32_t revision = 0;
  Points rest_vertices;
  Triangles triangles;
  std::vector<int> vertex_parents;             ///< #V: index in the input file, or -1
  std::vector<std::uint32_t> triangle_pieces;  ///< #F: connected piece, 0..
  std::vector<bool> cut;                       ///< #F: fills a cut
  Points texture_coordinates;  ///< empty, or 3 #F rows (u, v, 0), in the order of the triangles' corners
};

/// The positions of a topology's vertices (softbody_msgs/MeshState without its header).
struct MeshState {
  std::uint32_t revision = 0;
  Nanoseconds observed = 0;       ///< stamp of the last image that was used
  Points vertices;                ///< [m]
  std::vector<float> confidence;  ///< per vertex, 0..1
  std::vector<float> standard_deviation =
      {};  ///< per vertex, of its distance from the truth [m]; empty: not estimated
};

enum class TrackingState : std::uint8_t {
  kInitializing = 0,
  kTracking = 1,
  kDegraded = 2,
  kLost = 3,
  kRecovering = 4
};

/// The tracker's state and its quality (softbody_msgs/TrackingStatus without its header).
struct TrackingStatus {
  TrackingState state = TrackingState::kInitializing;
  std::uint32_t features_tracked = 0;
  std::uint32_t features_total = 0;
  double inlier_ratio = 0.0;
  double residual_rms = 0.0;  ///< [m]
  std::string reason;
};

}  // namespace softbody

#include "softbody_tracking/robot/robot_description.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <stdexcept>

#include "robot/solids.h"

namespace softbody {
namespace {

constexpr double kLargest_m = 1000.0;  // a size or place beyond it is no metre

/// Keeps what the parser says, while it lives.
class ParserLog : public console_bridge::OutputHandler {
 public:
  ParserLog() { console_bridge::useOutputHandler(this); }
  ~ParserLog() override { console_bridge::restorePreviousOutputHandler(); }
  ParserLog(const ParserLog&) = delete;
  ParserLog& operator=(const ParserLog&) = delete;
  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
           int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) first_ = text;
  }
  const std::string& first() const { return first_; }

 private:
  std::string first_;
};

urdf::ModelInterfaceSharedPtr parsed(const std::string& urdf) {
  const ParserLog log;
  urdf::ModelInterfaceSharedPtr model;
  std::string why;
  try {
    model = urdf::parseURDF(urdf);
    why = log.first();
  } catch (const std::exception& error) {
    why = error.what();
  }
  if (model) return model;
  const char* advice =
      urdf.find("xacro:") == std::string::npos ? "" : "; it is a xacro file: run xacro first";
  throw std::invalid_argument(
      fmt::format("the URDF cannot be read: {}{}", why.empty() ? "it is no robot" : why, advice));
}

double checkedSize(double size, const char* what) {
  if (size > 0.0 && size < kLargest_m) return size;
  throw std::invalid_argument(
      fmt::format("{} is {}, but must be above 0 and below {} m", what, size, kLargest_m));
}

TriangleMesh meshGeometry(const urdf::Mesh& geometry, const RobotMeshReader& read_mesh) {
  TriangleMesh mesh = read_mesh(geometry.filename);
  const Eigen::RowVector3d scale(geometry.scale.x, geometry.scale.y, geometry.scale.z);
  if (!scale.allFinite() || (scale.array() == 0.0).any())
    throw std::invalid_argument(geometry.filename + ": its scale must not be 0");
  mesh.vertices.array().rowwise() *= scale.array();
  if (scale.prod() < 0.0) mesh.triangles.col(1).swap(mesh.triangles.col(2));  // a mirror turns them inward
  return mesh;
}

TriangleMesh meshOf(const urdf::Geometry& geometry, const RobotMeshReader& read_mesh) {
  switch (geometry.type) {
    case urdf::Geometry::BOX: {
      const urdf::Vector3& dim = dynamic_cast<const urdf::Box&>(geometry).dim;
      return boxMesh({checkedSize(dim.x, "the box's size"), checkedSize(dim.y, "the box's size"),
                      checkedSize(dim.z, "the box's size")});
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(geometry);
      return cylinderMesh(checkedSize(cylinder.radius, "the cylinder's radius"),
                          checkedSize(cylinder.length, "the cylinder's length"));
    }
    case urdf::Geometry::SPHERE:
      return sphereMesh(
          checkedSize(dynamic_cast<const urdf::Sphere&>(geometry).radius, "the sphere's radius"));
    default:
      return meshGeometry(dynamic_cast<const urdf::Mesh&>(geometry), read_mesh);
  }
}

Eigen::Isometry3d poseOf(const urdf::Pose& pose) {
  Eigen::Quaterniond q;
  pose.rotation.getQuaternion(q.x(), q.y(), q.z(), q.w());
  const Eigen::Vector3d place(pose.position.x, pose.position.y, pose.position.z);
  if (!(place.cwiseAbs().maxCoeff() < kLargest_m && q.norm() > 0.5))
    throw std::invalid_argument("its origin is no usable pose");
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = q.normalized().toRotationMatrix();
  result.translation() = place;
  return result;
}

/// All shapes together. @param shapes urdf::Visual or urdf::Collision.
template <typename Shapes>
TriangleMesh surfaceOf(const Shapes& shapes, const RobotMeshReader& read_mesh) {
  TriangleMesh surface;
  for (const auto& shape : shapes) {
    if (!shape || !shape->geometry) continue;
    TriangleMesh mesh = meshOf(*shape->geometry, read_mesh);
    const Eigen::Isometry3d pose = poseOf(shape->origin);
    mesh.vertices = (mesh.vertices * pose.linear().transpose()).rowwise() + pose.translation().transpose();
    append(mesh, &surface);
  }
  return surface;
}

TriangleMesh linkSurface(const urdf::Link& link, const RobotMeshReader& read_mesh,
                         std::vector<std::string>* warnings) {
  std::string why;
  try {
    TriangleMesh visual = surfaceOf(link.visual_array, read_mesh);
    if (visual.triangles.rows() > 0) return visual;
  } catch (const std::exception& error) {
    why = error.what();
  }
  TriangleMesh collision;
  try {
    collision = surfaceOf(link.collision_array, read_mesh);
  } catch (const std::exception& error) {
    if (why.empty()) why = error.what();
  }
  if (why.empty()) return collision;
  if (collision.triangles.rows() > 0) {
    warnings->push_back(fmt::format(
        "link {}: its visual geometry cannot be used: {}. Its collision geometry is used", link.name, why));
  } else {
    warnings->push_back(fmt::format("link {} is left out: {}", link.name, why));
  }
  return collision;
}

}  // namespace

RobotDescription readRobotDescription(const std::string& urdf, const RobotMeshReader& read_mesh) {
  const urdf::ModelInterfaceSharedPtr model = parsed(urdf);
  RobotDescription robot;
  robot.name = model->getName();
  for (const auto& [name, link] : model->links_) {
    TriangleMesh surface = linkSurface(*link, read_mesh, &robot.warnings);
    if (surface.triangles.rows() > 0) robot.links.push_back({name, std::move(surface)});
  }
  if (robot.links.empty())
    throw std::invalid_argument(fmt::format("no link of the robot {} has a surface{}", robot.name,
                                            robot.warnings.empty() ? "" : ": " + robot.warnings.front()));
  return robot;
}

}  // namespace softbody

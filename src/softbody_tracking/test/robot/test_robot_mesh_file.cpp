#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <filesystem>
#include <stdexcept>

#include "robot/link_shapes.h"
#include "robot/robot_mesh_file.h"

namespace softbody {
namespace {

class RobotMeshFile : public testing::Test, protected test::ScratchFolder {};

const char* const kFaces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string stl() {
  const char* const corners[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string text = "solid a\n";
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int corner : face) text += fmt::format("vertex {}\n", corners[corner]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid a\n";
}

std::string dae(const char* unit, const char* up) {
  return fmt::format(R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{}"/><up_axis>{}</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>
<accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)",
                     unit, up);
}

TEST_F(RobotMeshFile, EachFormatGivesTheSameVolume) {
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  for (const std::string& path :
       {write("a.stl", stl()), write("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n") + kFaces),
        write("a.off", "OFF\n4 4 0\n" + vertices + faces),
        write("a.ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n" +
                  vertices + faces)})
    EXPECT_NEAR(signedVolume(readRobotMesh(path)), 1.0 / 6.0, 1e-6) << path;
}

TEST_F(RobotMeshFile, ColladaHasItsUnitAndIsNotTurned) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const TriangleMesh mesh = readRobotMesh(write("a.dae", dae("0.001", up)));
    EXPECT_TRUE(mesh.vertices.colwise().maxCoeff().isApprox(Eigen::RowVector3d(0.001, 0.002, 0.003), 1e-5))
        << up << ": " << mesh.vertices;
  }
}

TEST_F(RobotMeshFile, WhatCannotBeReadIsNamed) {
  for (const std::string& path : {file("gone.stl"), file(""), write("b.stl", "no mesh"),
                                  write("c.txt", "text"), write("d.dae", "<COLLADA")}) {
    const std::string said = complaint([&] { readRobotMesh(path); });
    EXPECT_TRUE(says(said, path));
    EXPECT_GT(said.size(), path.size() + 10);
  }
}

TEST_F(RobotMeshFile, NamesOfAUrdfBecomePaths) {
  const PackageFolder packages = [](const std::string& name) { return name == "arm" ? "/opt/arm" : ""; };
  EXPECT_EQ(robotFilePath("package://arm/meshes/a.stl", packages, "/x"), "/opt/arm/meshes/a.stl");
  EXPECT_EQ(robotFilePath("file:///tmp/a.stl", packages, "/x"), "/tmp/a.stl");
  EXPECT_EQ(robotFilePath("/tmp/a.stl", packages, "/x"), "/tmp/a.stl");
  EXPECT_EQ(robotFilePath("meshes/a.stl", packages, "/x"), "/x/meshes/a.stl");
  EXPECT_THROW(robotFilePath("package://leg/a.stl", packages, "/x"), std::invalid_argument);
  EXPECT_THROW(robotFilePath("http://host/a.stl", packages, "/x"), std::invalid_argument);
}

}  // namespace
}  // namespace softbody

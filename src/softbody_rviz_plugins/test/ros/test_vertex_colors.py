#!/usr/bin/env python3
"""rviz shows the colours of a mesh file's vertices: those of a PLY that an object YAML names."""
import os
import tempfile
import unittest

import numpy as np
import rospy
import rostest

from hand_made_body import BODY_DISPLAY, FRAME, SIDE, Body
from rviz_screen import Rviz, pixels_of

PIXELS_PER_M = 1000.0
VIEW = {"Class": "rviz/TopDownOrtho", "Name": "View", "Angle": 0.0, "Scale": PIXELS_PER_M, "X": 0.0, "Y": 0.0,
        "Target Frame": FRAME}
PURPLE, LIME = (160, 40, 200), (150, 230, 40)  # of the left and the right square
HEADER = ("ply", "format ascii 1.0", "element vertex 8", *(f"property float {axis}" for axis in "xyz"),
          *(f"property uchar {color}" for color in ("red", "green", "blue")), "end_header")


def write_object(folder):
    """Writes an object whose mesh file has four purple and four lime vertices. Returns its YAML."""
    rows = [f"0 0 0 {red} {green} {blue}" for red, green, blue in 4 * [PURPLE] + 4 * [LIME]]
    with open(os.path.join(folder, "body.ply"), "w", encoding="ascii") as file:
        file.write("\n".join([*HEADER, *rows, ""]))
    with open(os.path.join(folder, "object.yaml"), "w", encoding="ascii") as file:
        file.write("object: {visual_mesh: body.ply}\n")
    return file.name


class TestVertexColors(unittest.TestCase):
    def test_each_piece_has_the_colour_of_its_vertices(self):
        rospy.init_node("test_vertex_colors")
        with tempfile.TemporaryDirectory() as folder:
            rospy.set_param("/test/object", write_object(folder))
            body = Body()
            body.send_topology()
            body.send_state()
            rviz = Rviz([{**BODY_DISPLAY, "Color By": "Texture"}], VIEW)
            try:
                self.assertTrue(rviz.wait_for(self.is_painted), "the colours of the vertices are not on the screen")
            finally:
                rviz.end()

    def is_painted(self, picture):
        left, right = (pixels_of(picture, color)[1] for color in (PURPLE, LIME))
        areas = np.array([len(left), len(right)]) / PIXELS_PER_M**2
        return np.abs(areas - SIDE**2).max() < 0.03 * SIDE**2 and left.max() <= right.min()


if __name__ == "__main__":
    rostest.rosrun("softbody_rviz_plugins", "test_vertex_colors", TestVertexColors)

#!/usr/bin/env python3
"""A click on a vertex in rviz shows its number, its place and its standard deviation."""
import os
import subprocess
import unittest

import rospy
import rostest

from hand_made_body import SIDE, Body
from virtual_screen import VirtualScreen

PATIENCE_S = 40
PICK_VERTEX = os.environ["CMAKE_PREFIX_PATH"].split(":")[0] + "/lib/development/softbody_rviz_plugins/pick_vertex"


class TestPicking(unittest.TestCase):
    def picked(self, x, y):
        """What the panel Selection shows after a click near a place [m]."""
        with VirtualScreen(900, 700) as screen:
            return subprocess.run([PICK_VERTEX, str(x), str(y)], env=screen.environment, stdout=subprocess.PIPE, text=True,
                                  timeout=PATIENCE_S, check=True).stdout

    def test_a_click_shows_the_vertex(self):
        rospy.init_node("test_picking")
        body = Body()
        body.send_topology()
        body.send_state()
        shown = self.picked(SIDE, SIDE / 2)  # the upper right corner of the right square
        self.assertIn("Vertex 5\n", shown)
        self.assertIn(f"Place [m]: {SIDE:.4f}; {SIDE / 2:.4f}; 0.0000\n", shown)
        self.assertIn("Standard deviation: 5.00 mm\n", shown)
        self.assertIn("Piece: 1\n", shown)
        self.assertEqual(shown.count("Vertex "), 1)


if __name__ == "__main__":
    rostest.rosrun("softbody_rviz_plugins", "picking", TestPicking)

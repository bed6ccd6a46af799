#!/usr/bin/env python3
"""rviz on a virtual screen draws a hand-made body: what is on the screen has the right colours, sizes and places."""
import os
import subprocess
import tempfile
import time
import unittest

import numpy as np
import rospy
import rostest
import yaml

from hand_made_body import FRAME, SIDE, STRIP, Body
from virtual_screen import VirtualScreen, write_png

PIXELS_PER_M = 1000.0
LEFT, RIGHT, CUT = (86, 180, 233), (230, 159, 0), (190, 45, 45)  # pieces 0 and 1, and the default colour of cut faces
PATIENCE_S = 15.0


def configuration(folder):
    """Only the display, seen from +z with a known scale."""
    path = os.path.join(folder, "test.rviz")
    display = {"Class": "softbody_rviz_plugins/SoftBody", "Name": "Body", "Enabled": True, "Color By": "Piece",
               "Topology Topic": "/test/topology", "State Topic": "/test/state"}
    view = {"Class": "rviz/TopDownOrtho", "Name": "View", "Angle": 0.0, "Scale": PIXELS_PER_M, "X": 0.0, "Y": 0.0,
            "Target Frame": FRAME}
    config = {"Panels": [], "Visualization Manager": {
        "Class": "", "Displays": [display], "Enabled": True, "Name": "root", "Tools": [], "Value": True,
        "Global Options": {"Background Color": "0; 0; 0", "Fixed Frame": FRAME, "Frame Rate": 10},
        "Views": {"Current": view}}, "Window Geometry": {"Width": 800, "Height": 600}}
    with open(path, "w", encoding="utf-8") as file:
        yaml.safe_dump(config, file)
    return path


def pixels_of(picture, color):
    """Rows and columns of the pixels of a colour, under light of any strength."""
    values = picture.astype(float)
    length = np.linalg.norm(values, axis=2)
    cosine = values @ np.array(color, float) / np.maximum(length, 1.0) / np.linalg.norm(color)
    return np.nonzero((cosine > 0.99) & (length > 80.0))


class TestDisplay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_display")
        cls.folder = tempfile.TemporaryDirectory()
        cls.screen = VirtualScreen(800, 600)
        cls.screen.__enter__()
        cls.body = Body()
        cls.body.send_topology()
        cls.body.send_state()
        cls.rviz = subprocess.Popen(["/usr/lib/rviz/rviz", "-d", configuration(cls.folder.name)],
                                    env=cls.screen.environment, start_new_session=True)

    @classmethod
    def tearDownClass(cls):
        if output := os.environ.get("SOFTBODY_TEST_PICTURE"):
            write_png(output, cls.screen.picture())
        cls.rviz.terminate()
        cls.rviz.wait()
        cls.screen.__exit__()
        cls.folder.cleanup()

    def wait_for(self, condition, what):
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            if condition(self.screen.picture()):
                return
            self.assertIsNone(self.rviz.poll(), "rviz has ended")
            time.sleep(0.2)
        self.fail(f"{what}: not on the screen within {PATIENCE_S:.0f} s")

    def area(self, picture, color):
        """Area of a colour on the screen [m^2]."""
        return len(pixels_of(picture, color)[0]) / PIXELS_PER_M**2

    def place(self, color):
        """Middle of a colour on the screen [m]; x to the right, y up, from any fixed point."""
        rows, columns = pixels_of(self.screen.picture(), color)
        return np.array([columns.mean(), -rows.mean()]) / PIXELS_PER_M

    def shows(self, left, right, cut):
        """Whether the colours have these areas, within 3 %."""
        def fits(picture):
            return all(abs(self.area(picture, color) - area) <= 0.03 * area + 1e-4
                       for color, area in ((LEFT, left), (RIGHT, right), (CUT, cut)))
        return fits

    def start_again(self):
        self.body.send_topology()
        self.body.send_state()
        self.wait_for(self.shows(SIDE**2, SIDE**2, 0.0), "both pieces in their colours")

    def test_pieces_have_their_colours_sizes_and_places(self):
        self.start_again()
        np.testing.assert_allclose(self.place(RIGHT) - self.place(LEFT), [SIDE, 0.0], atol=2.0 / PIXELS_PER_M)

    def test_the_mesh_follows_the_states(self):
        self.start_again()
        before, offset = self.place(LEFT), np.array([0.03, -0.05])
        self.body.send_state(offset=(*offset, 0.1))
        self.wait_for(lambda _: np.abs(self.place(LEFT) - before - offset).max() < 2.0 / PIXELS_PER_M, "the moved mesh")

    def test_a_state_waits_for_its_topology_and_cut_faces_have_their_colour(self):
        self.start_again()
        self.body.send_state(revision=1, cut=True)
        time.sleep(1.0)
        self.assertTrue(self.shows(SIDE**2, SIDE**2, 0.0)(self.screen.picture()), "still the uncut body")
        self.body.send_topology(revision=1, cut=True)
        self.wait_for(self.shows(SIDE**2, SIDE**2, 2 * SIDE * STRIP), "the cut face")

    def test_a_bad_state_changes_nothing(self):
        self.start_again()
        self.body.send_state(offset=(float("nan"), 0.0, 0.0))
        time.sleep(1.0)
        self.body.send_state(cut=True)  # too many vertices
        time.sleep(1.0)
        self.assertTrue(self.shows(SIDE**2, SIDE**2, 0.0)(self.screen.picture()))
        self.assertIsNone(self.rviz.poll(), "rviz has ended")


if __name__ == "__main__":
    rostest.rosrun("softbody_rviz_plugins", "test_display", TestDisplay)

#!/usr/bin/env python3
"""rviz on a virtual screen draws a hand-made body: what is on the screen has the right colours, sizes and places."""
import time
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Point32

from hand_made_body import BODY_DISPLAY, FRAME, LEFT, RIGHT, SIDE, STRIP, Body
from rviz_screen import Rviz, pixels_of

PIXELS_PER_M = 1000.0
CUT = (190, 45, 45)  # default colour of cut faces


VIEW = {"Class": "rviz/TopDownOrtho", "Name": "View", "Angle": 0.0, "Scale": PIXELS_PER_M, "X": 0.0, "Y": 0.0,
        "Target Frame": FRAME}  # from +z, with a known scale


class TestDisplay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_display")
        cls.body = Body()
        cls.rviz = Rviz([BODY_DISPLAY], VIEW)

    @classmethod
    def tearDownClass(cls):
        cls.rviz.end()

    def wait_for(self, condition, what):
        self.assertTrue(self.rviz.wait_for(condition), f"not on the screen in time: {what}")

    def area(self, picture, color):
        """Area of a colour on the screen [m^2]."""
        return len(pixels_of(picture, color)[0]) / PIXELS_PER_M**2

    def place(self, color):
        """Middle of a colour on the screen [m]; x to the right, y up, from any fixed point."""
        rows, columns = pixels_of(self.rviz.picture(), color)
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
        self.assertTrue(self.shows(SIDE**2, SIDE**2, 0.0)(self.rviz.picture()), "still the uncut body")
        self.body.send_topology(revision=1, cut=True)
        self.wait_for(self.shows(SIDE**2, SIDE**2, 2 * SIDE * STRIP), "the cut face")

    def test_a_bad_state_changes_nothing(self):
        def one_vertex(value):
            return lambda state: setattr(state.vertices[3], "x", value)

        def all_zeros(state):
            state.vertices = [Point32() for _ in state.vertices]

        self.start_again()
        for change in (one_vertex(float("nan")), one_vertex(1e20), one_vertex(9e3), all_zeros,
                       lambda state: state.vertices.pop(), lambda state: state.vertices.clear(),
                       lambda state: setattr(state, "revision", 7),
                       lambda state: setattr(state, "standard_deviation", [float("inf")] * len(state.vertices)),
                       lambda state: setattr(state, "confidence", [float("nan")] * len(state.vertices))):
            self.body.send_state(change=change)
            time.sleep(0.5)
            self.assertTrue(self.shows(SIDE**2, SIDE**2, 0.0)(self.rviz.picture()))
        self.body.send_state(cut=True)  # too many vertices
        time.sleep(0.5)
        self.assertTrue(self.shows(SIDE**2, SIDE**2, 0.0)(self.rviz.picture()))
        self.assertTrue(self.rviz.is_alive())

    def test_a_bad_topology_is_not_drawn_and_the_next_good_one_is(self):
        self.start_again()
        for index in (8, 2**31, 2**32 - 1):
            self.body.send_topology(revision=index % 5 + 2, change=lambda topology, index=index: setattr(
                topology.triangles[1], "vertex_indices", [0, 1, index]))
            self.body.send_state(revision=index % 5 + 2)
            time.sleep(0.5)
            self.assertTrue(self.rviz.is_alive())
        self.start_again()


if __name__ == "__main__":
    rostest.rosrun("softbody_rviz_plugins", "test_display", TestDisplay)

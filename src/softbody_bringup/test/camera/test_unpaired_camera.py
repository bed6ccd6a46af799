#!/usr/bin/env python3
"""A camera of which no frame can be made from the start: soon a fault, not a start that takes long."""
import os
import re
import sys
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Log

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "shared"))
from hand_made_camera import Camera  # pylint: disable=wrong-import-position
from recorder import Recorder  # pylint: disable=wrong-import-position

NODE = "/softbody/camera_ingest"
START_S = 20.0  # that a camera which sends nothing may take


class UnpairedCamera(unittest.TestCase):
    def test_what_arrives_and_makes_no_frame_is_a_fault(self):
        recorder = Recorder(rosout=Log)
        camera = Camera(apart_s=100.0)
        said = recorder.wait_for_log(NODE, "no frame for").msg
        self.assertLess(float(re.search(r"no frame for (\d+) s", said).group(1)), START_S)
        self.assertRegex(said, "stamps of .* differ by")
        camera.stop()


if __name__ == "__main__":
    rospy.init_node("test_unpaired_camera")
    rostest.rosrun("softbody_bringup", "test_unpaired_camera", UnpairedCamera, sys.argv)

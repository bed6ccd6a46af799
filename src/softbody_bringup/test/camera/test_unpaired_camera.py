"""A camera of which no frame can be made from the start: soon a fault, not a start that takes long."""
import re
import unittest

from rosgraph_msgs.msg import Log

from hand_made_camera import Camera
from recorder import Recorder

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

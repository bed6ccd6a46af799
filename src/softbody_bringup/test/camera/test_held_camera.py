"""What camera_ingest says of its streams while /clock stands still, so early that no period in ROS time has passed."""
import threading
import time
import unittest

import rospy
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import CameraInfo

from hand_made_camera import TOPICS, Camera
from recorder import Recorder


class HeldCamera(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.camera = Camera()
        cls.recorder = Recorder(rosout=Log, softbody__rgb__camera_info=CameraInfo)

    @classmethod
    def hold(cls):
        clock = rospy.Publisher("/clock", Clock, queue_size=1)
        while True:
            clock.publish(Clock(rospy.Time(1)))
            time.sleep(0.02)

    def test_1_a_live_camera_with_a_clock_that_never_starts(self):
        said = self.recorder.wait_for_log("/softbody/camera_ingest", "/clock is silent")
        self.assertIn("rosparam set use_sim_time false", said.msg)
        self.recorder.wait_for("softbody/rgb/camera_info", 30)  # three seconds, longer than silence_timeout_s
        self.assertFalse([log.msg for log in self.recorder.messages["rosout"] if "no frame for" in log.msg])

    def test_2_what_is_wrong_is_told(self):
        threading.Thread(target=self.hold, daemon=True).start()
        for words, fault in (("camera_depth_optical_frame", {"frames": {"depth": "camera_depth_optical_frame"}}),
                             ("no frame_id", {"frames": {"color": "", "depth": ""}}),
                             (TOPICS["color"] + ": a second image", {"copies": {"color": 2}}),
                             (TOPICS["depth"] + ": an image without a stamp", {"unstamped": ("depth",)})):
            self.camera.be(**fault)
            self.recorder.wait_for_log("/softbody/camera_ingest", words)

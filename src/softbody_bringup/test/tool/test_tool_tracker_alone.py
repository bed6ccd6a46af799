"""What /diagnostics say where no frames come, where frames come that cannot be used, and where those show no tool."""
import unittest

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import CameraInfo, Image

from recorder import Recorder

WIDTH, HEIGHT = 64, 48


class ToolTrackerAlone(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(diagnostics=DiagnosticArray)
        cls.publishers = [rospy.Publisher("/softbody/" + topic, kind, queue_size=2) for topic, kind in (
            ("rgb/image_rect_color", Image), ("depth/image_rect", Image), ("rgb/camera_info", CameraInfo))]
        cls.color_encoding = None
        cls.timer = rospy.Timer(rospy.Duration(0.2), cls.publish)

    @classmethod
    def tearDownClass(cls):
        cls.timer.shutdown()

    @classmethod
    def publish(cls, _):
        if cls.color_encoding is None:
            return
        stamp, pixels = rospy.Time.now(), WIDTH * HEIGHT
        for publisher, message in zip(cls.publishers, (
                Image(height=HEIGHT, width=WIDTH, encoding=cls.color_encoding, step=3 * WIDTH, data=bytes(3 * pixels)),
                Image(height=HEIGHT, width=WIDTH, encoding="32FC1", step=4 * WIDTH, data=bytes(4 * pixels)),
                CameraInfo(height=HEIGHT, width=WIDTH, K=[60, 0, 32, 0, 60, 24, 0, 0, 1],
                           P=[60, 0, 32, 0, 0, 60, 24, 0, 0, 0, 1, 0]))):
            message.header.stamp, message.header.frame_id = stamp, "camera_color_optical_frame"
            publisher.publish(message)

    def test_each_is_told_apart(self):
        for encoding, level, words in ((None, DiagnosticStatus.WARN, "no frame from camera_ingest for over 2 s"),
                                       ("8SC3", DiagnosticStatus.ERROR, "frames come, but cannot be used"),
                                       ("bgr8", DiagnosticStatus.WARN, "not seen: ")):
            type(self).color_encoding = encoding
            self.recorder.wait_for_status("tool_tracker: tool", level, words)

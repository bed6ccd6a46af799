#!/usr/bin/env python3
"""What camera_ingest says of its streams, in the log and in /diagnostics, and what it leaves out."""
import sys
import threading
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from recorder import Recorder
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, Image

WIDTH, HEIGHT = 64, 48
OPTICAL_FRAME = "camera_color_optical_frame"


class Camera:
    """Images of nothing at 10 Hz."""

    def __init__(self):
        self.publishers = {name: rospy.Publisher(f"/camera/{topic}", kind, queue_size=10) for name, topic, kind in (
            ("color", "color/image_raw", Image), ("info", "color/camera_info", CameraInfo),
            ("depth", "aligned_depth_to_color/image_raw", Image))}
        self.lock = threading.Lock()
        self.be()
        self.timer = rospy.Timer(rospy.Duration(0.1), self.publish)

    def be(self, depth=True, copies=1, depth_frame=OPTICAL_FRAME, color_frame=OPTICAL_FRAME, late_by_s=0.0):
        with self.lock:
            self.depth, self.copies, self.late_by_s = depth, copies, late_by_s
            self.frames = {"color": color_frame, "info": color_frame, "depth": depth_frame}

    def publish(self, _):
        messages = {
            "info": CameraInfo(height=HEIGHT, width=WIDTH, K=[60, 0, 32, 0, 60, 24, 0, 0, 1],
                               P=[60, 0, 32, 0, 0, 60, 24, 0, 0, 0, 1, 0], R=[1, 0, 0, 0, 1, 0, 0, 0, 1]),
            "color": Image(height=HEIGHT, width=WIDTH, encoding="rgb8", step=3 * WIDTH, data=bytes(3 * WIDTH * HEIGHT)),
            "depth": Image(height=HEIGHT, width=WIDTH, encoding="16UC1", step=2 * WIDTH, data=bytes(2 * WIDTH * HEIGHT))}
        with self.lock:
            stamp = rospy.Time.now() - rospy.Duration(self.late_by_s)
            for name, message in messages.items():
                message.header.stamp, message.header.frame_id = stamp, self.frames[name]
                for _ in range(self.copies if name != "depth" else self.depth):
                    self.publishers[name].publish(message)


class CameraIngest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.camera = Camera()
        cls.recorder = Recorder(rosout=Log, diagnostics=DiagnosticArray, softbody__rgb__image_rect_color=Image)

    @classmethod
    def tearDownClass(cls):
        cls.camera.timer.shutdown()

    def wait_for_log(self, condition, what):
        self.recorder.wait(lambda seen: any(log.level >= Log.WARN and log.name == "/softbody/camera_ingest"
                                            and condition(log.msg) for log in seen["rosout"]), "a warning: " + what)

    def wait_for_status(self, level, words):
        self.recorder.wait(lambda seen: any("camera_ingest: frames" in status.name and status.level == level
                                            and words in status.message
                                            for message in seen["diagnostics"][-5:] for status in message.status),
                           f"diagnostics that say {words}")

    def tearDown(self):
        self.camera.be()
        self.wait_for_status(DiagnosticStatus.OK, "frames a second")

    def test_a_silent_topic_is_named(self):
        self.camera.be(depth=False)
        self.wait_for_log(lambda words: "/camera/aligned_depth_to_color/image_raw" in words
                          and "/camera/color/image_raw" not in words, "names the silent depth topic alone")
        self.wait_for_status(DiagnosticStatus.ERROR, "/camera/aligned_depth_to_color/image_raw")

    def test_an_image_counts_once(self):
        topic = "softbody/rgb/image_rect_color"
        self.camera.be(copies=2)
        self.wait_for_log(lambda words: "a second image with the stamp" in words, "an image that comes twice")
        images = self.recorder.wait_for(topic, len(self.recorder.messages[topic]) + 10)
        stamps = [image.header.stamp for image in images]
        self.assertEqual(len(stamps), len(set(stamps)))

    def test_depth_in_another_frame_is_named(self):
        self.camera.be(depth_frame="camera_depth_optical_frame")
        self.wait_for_status(DiagnosticStatus.WARN, "camera_depth_optical_frame")

    def test_a_slash_before_the_frame_is_left_out(self):
        """Old drivers and bags have one, and tf2 refuses it."""
        topic = "softbody/rgb/image_rect_color"
        self.camera.be(color_frame="/left_optical_frame", depth_frame="/left_optical_frame")
        self.recorder.wait(lambda seen: seen[topic] and seen[topic][-1].header.frame_id == "left_optical_frame",
                           "an image whose frame has no slash")

    def test_images_without_a_frame_are_named(self):
        self.camera.be(color_frame="", depth_frame="")
        self.wait_for_status(DiagnosticStatus.WARN, "no frame_id")

    def test_another_clock_is_named(self):
        for late_by_s, words in ((100.0, "100.0 s behind"), (-100.0, "100.0 s ahead")):
            self.camera.be(late_by_s=late_by_s)
            self.wait_for_status(DiagnosticStatus.WARN, words)
        self.wait_for_log(lambda words: "this machine's clock" in words, "tells of the clocks")


if __name__ == "__main__":
    rospy.init_node("test_camera_ingest")
    rostest.rosrun("softbody_bringup", "test_camera_ingest", CameraIngest, sys.argv)

"""Transports that Debian has no plugins for, and what camera_ingest advises when it cannot make a frame."""
import unittest

import numpy as np
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Image

from driver_camera import COLOR, DEPTH_M, DriverCamera, Stream
from recorder import Recorder

SIZE = (160, 120)


def color(namespace, encoding="rgb8", **more):
    return Stream(f"/{namespace}/camera/color/image_raw", encoding, COLOR, SIZE, 150, **more)


def depth(namespace, encoding="16UC1", size=SIZE, name="aligned_depth_to_color", **more):
    return Stream(f"/{namespace}/camera/{name}/image_raw", encoding, COLOR, size, 150, **more)


CAMERAS = {
    "compressed": (color("compressed", transport="compressed"), depth("compressed", transport="compressedDepth")),
    "metres": (color("metres", "bgr8"), depth("metres", "32FC1", transport="compressedDepth")),
    "grey": (color("grey", "mono8"), depth("grey")),
    "uncalibrated": (color("uncalibrated", info=False), depth("uncalibrated", info=False)),
    "flat": (color("flat"), None),
    "unregistered": (color("unregistered"), depth("unregistered", size=(80, 60), info=False)),
    "elsewhere": (color("elsewhere"), depth("elsewhere", name="depth")),
    "moved": (Stream("/d435/color/image_raw", "rgb8", COLOR, SIZE, 150),
              Stream("/d435/aligned_depth_to_color/image_raw", "16UC1", COLOR, SIZE, 150)),
}


class CameraInput(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(rosout=Log, compressed__depth__image_rect=Image, metres__depth__image_rect=Image,
                                compressed__rgb__image_rect_color=Image, grey__rgb__image_rect_color=Image,
                                unregistered__rgb__image_rect_color=Image)
        cls.cameras = [DriverCamera(*streams, 20) for streams in CAMERAS.values()]

    def expect_advice(self, namespace, *words):
        """/rosout has what the console has."""
        node = f"/{namespace}/camera_ingest"
        log = self.recorder.first("rosout", lambda log: log.name == node and all(word in log.msg for word in words),
                                  f"{node} to say: {words}")
        self.assertGreaterEqual(log.level, Log.INFO)
        return log.msg

    def expect_depth(self, namespace):
        image = self.recorder.wait_for(f"{namespace}/depth/image_rect")[-1]
        values = np.frombuffer(image.data, np.float32).reshape(image.height, image.width)
        self.assertAlmostEqual(float(values[60, 80]), DEPTH_M, delta=1e-4)
        self.assertTrue(np.isnan(values[:6, :6]).all())

    def test_compressed_images_are_decoded(self):
        self.expect_depth("compressed")
        image = self.recorder.wait_for("compressed/rgb/image_rect_color")[-1]
        pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3)
        self.assertEqual(tuple(pixels[10, 33]), (200, 0, 33))

    def test_quantised_metres_are_decoded(self):
        self.expect_depth("metres")

    def test_grey_images_are_refused(self):
        self.expect_advice("grey", "mono8", "no colours", "color:=")

    def test_a_missing_calibration_is_named(self):
        self.expect_advice("uncalibrated", "/uncalibrated/camera/color/camera_info (nobody publishes it)",
                           "color_info:=")

    def test_missing_depth_is_named(self):
        self.expect_advice("flat", "/flat/camera/aligned_depth_to_color/image_raw (nobody publishes it)", "depth:=")

    def test_depth_under_another_name_is_found(self):
        self.expect_advice("elsewhere", "depth:=", "(sensor_msgs/Image)")

    def test_a_camera_in_another_namespace_is_found(self):
        self.assertNotIn("color:=", self.expect_advice("moved", "a camera with the same names", "/d435", "set camera:="))

    def test_depth_of_another_size_needs_its_camera_info(self):
        self.expect_advice("unregistered", "not registered", "80x60 and 160x120", "depth_info:=")

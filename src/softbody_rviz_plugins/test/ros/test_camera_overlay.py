#!/usr/bin/env python3
"""rviz' Camera display draws the body on the camera's image at the pixels where a pinhole camera sees it, and with
Only On Images the 3-D view does not draw it.
"""
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

from hand_made_body import BODY_DISPLAY, FRAME, LEFT, RIGHT, SIDE, Body
from rviz_screen import Rviz, pixels_of

WIDTH, HEIGHT, FOCAL = 320, 240, 400.0
CENTER = np.array([150.0, 130.0])  # principal point [pixels]
DEPTH = 0.8  # of the body [m]
BORDER = (0, 255, 0)  # drawn around the image, to find it on the screen
CAMERA_DISPLAY = {"Class": "rviz/Camera", "Name": "Camera", "Enabled": True, "Image Topic": "/test/image",
                  "Image Rendering": "background", "Transport Hint": "raw", "Queue Size": 2}
VIEW = {"Class": "rviz/TopDownOrtho", "Name": "View", "Scale": 10.0, "X": 100.0, "Y": 100.0}  # the body is outside
VIEW_OF_BODY = {**VIEW, "Scale": 400.0, "X": 0.0, "Y": 0.0, "Target Frame": FRAME}


class Camera:
    """Publishes a black image with a border, and its calibration."""

    def __init__(self):
        self.frames = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self.image = rospy.Publisher("/test/image", Image, queue_size=1)
        self.info = rospy.Publisher("/test/camera_info", CameraInfo, queue_size=1)
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "world", FRAME
        transform.transform.rotation.w = 1.0
        self.frames.publish(TFMessage([transform]))

    def send(self):
        pixels = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        pixels[[0, -1], :], pixels[:, [0, -1]] = BORDER, BORDER
        image, info = Image(height=HEIGHT, width=WIDTH, encoding="rgb8", step=3 * WIDTH, data=pixels.tobytes()), CameraInfo()
        info.height, info.width, info.distortion_model, info.D = HEIGHT, WIDTH, "plumb_bob", [0.0] * 5
        info.K = [FOCAL, 0, CENTER[0], 0, FOCAL, CENTER[1], 0, 0, 1]
        info.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        info.P = [FOCAL, 0, CENTER[0], 0, 0, FOCAL, CENTER[1], 0, 0, 0, 1, 0]
        for message, publisher in ((image, self.image), (info, self.info)):
            message.header.frame_id, message.header.stamp = FRAME, rospy.Time.now()
            publisher.publish(message)


def box(picture, color):
    """Left, top, right and bottom edge of a colour's pixels."""
    rows, columns = pixels_of(picture, color)
    if len(rows) == 0:
        return None
    return np.array([columns.min(), rows.min(), columns.max() + 1, rows.max() + 1], float)


def measured(picture):
    """Edges of the left piece in pixels of the image, or None. A pixel's centre has whole numbers."""
    frame = box(picture, BORDER)
    if frame is None:
        return None
    left, top, right, bottom = frame.astype(int)
    piece = box(picture[top:bottom, left:right], LEFT)
    if piece is None:
        return None
    return piece * np.tile(np.array([WIDTH, HEIGHT]) / (frame[2:] - frame[:2]), 2) - 0.5


def in_view(picture):
    """How many pixels outside the image have the colour of the right piece, or None without an image.
    The left one has the blue of some buttons.
    """
    frame = box(picture, BORDER)
    if frame is None:
        return None
    left, top, right, bottom = frame.astype(int)
    view = picture.copy()
    view[top:bottom, left:right] = 0
    return len(pixels_of(view, RIGHT)[0])


class TestCameraOverlay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_camera_overlay")
        cls.camera, body = Camera(), Body()
        body.send_topology()
        body.send_state(offset=(0.0, 0.0, DEPTH))

    def test_the_mesh_lies_on_its_pixels(self):
        corners = np.array([-SIDE, -SIDE / 2, 0.0, SIDE / 2]) * FOCAL / DEPTH + np.tile(CENTER, 2)
        seen = []

        def is_there(picture):
            self.camera.send()
            seen.append(measured(picture))
            return seen[-1] is not None and np.abs(seen[-1] - corners).max() <= 1.0

        rviz = Rviz([BODY_DISPLAY, CAMERA_DISPLAY], VIEW, 1000, 600)
        try:
            self.assertTrue(rviz.wait_for(is_there), f"expected {corners}, measured {seen[-1]}")
        finally:
            rviz.end()
        print("largest distance of an edge from its place [pixels]:", np.abs(seen[-1] - corners).max())

    def test_only_on_images_means_not_in_the_view(self):
        for only, is_right in ((False, lambda pixels: pixels > 0), (True, lambda pixels: pixels == 0)):
            def is_drawn(picture, is_right=is_right):
                self.camera.send()
                return measured(picture) is not None and is_right(in_view(picture))

            rviz = Rviz([{**BODY_DISPLAY, "Only On Images": only}, CAMERA_DISPLAY], VIEW_OF_BODY, 1000, 600)
            try:
                self.assertTrue(rviz.wait_for(is_drawn), f"Only On Images: {only}")
            finally:
                rviz.end()


if __name__ == "__main__":
    rostest.rosrun("softbody_rviz_plugins", "test_camera_overlay", TestCameraOverlay)

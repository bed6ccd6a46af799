"""Masks of the user's own segmentation: only what they show is measured; frames without one are tracked without."""
import threading
import unittest

import numpy as np
import rospy
from rosgraph_msgs.msg import Log
from sensor_msgs import point_cloud2
from sensor_msgs.msg import CameraInfo, Image, PointCloud2
from softbody_msgs.msg import Targets, TrackingStatus

from recorder import Recorder

FRAMES = 5
MARGIN_PX = 3


class Segmentation:
    """Answers every rectified image with a mask: the left part of the image, everything, or nothing at all."""

    def __init__(self):
        self.columns = None  # of the mask, from the left; None: no mask is sent
        self.since = {}
        self.publisher = rospy.Publisher("/softbody/mask", Image, queue_size=10)
        self.changed = threading.Lock()
        self.subscriber = rospy.Subscriber("/softbody/rgb/image_rect_color", Image, self._answer, queue_size=10)

    def send(self, columns):
        with self.changed:
            self.columns = columns
            self.since = None

    def _answer(self, image):
        with self.changed:
            if self.since is None:
                self.since = image.header.stamp
            if self.columns is None:
                return
            mask = np.zeros((image.height, image.width), np.uint8)
            mask[:, :self.columns] = 1
            answer = Image(header=image.header, height=image.height, width=image.width, encoding="mono8",
                           step=image.width, data=mask.tobytes())
        self.publisher.publish(answer)

    def first(self, messages):
        """Messages of frames since the last send()."""
        return [m for m in messages if self.since and m.header.stamp >= self.since]


class Mask(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__targets=Targets, softbody__features=PointCloud2,
                                softbody__status=TrackingStatus, softbody__rgb__camera_info=CameraInfo, rosout=Log)
        cls.segmentation = Segmentation()
        cls.segmentation.send(10000)
        cls.camera = cls.recorder.wait_for("softbody/rgb/camera_info")[0]

    def columns_of(self, targets):
        """The image columns in which targets were measured."""
        places = np.array([[t.position.x, t.position.z] for t in targets.targets])
        return self.camera.K[0] * places[:, 0] / places[:, 1] + self.camera.K[2]

    def frames(self, columns):
        """Messages of some frames with a mask of so many columns, once the body is tracked."""
        self.recorder.first("softbody/status", lambda s: s.state == TrackingStatus.TRACKING, "TRACKING")
        self.segmentation.send(columns)
        return self.recorder.wait(
            lambda seen: len(self.segmentation.first(seen["softbody/targets"])) >= FRAMES
            and (self.segmentation.first(seen["softbody/targets"]), self.segmentation.first(seen["softbody/features"])),
            "targets of further frames")

    def test_nothing_is_measured_outside(self):
        middle = self.camera.width // 2
        whole, _ = self.frames(self.camera.width)
        for targets in whole:
            columns = self.columns_of(targets)
            self.assertLess(columns.min(), middle - 20)
            self.assertGreater(columns.max(), middle + 20)
        half, features = self.frames(middle)
        for targets in half:
            columns = self.columns_of(targets)
            self.assertGreater(len(columns), 100)
            self.assertLess(columns.max(), middle + MARGIN_PX)
        self.assertTrue(features)
        for cloud in features:
            for (u,) in point_cloud2.read_points(cloud, field_names=("u",)):
                self.assertLess(u, middle + MARGIN_PX)

    def test_without_masks_it_goes_on_and_says_so(self):
        self.frames(self.camera.width)
        for targets in self.frames(None)[0]:
            self.assertGreater(self.columns_of(targets).max(), self.camera.width // 2 + 20)
        self.recorder.wait_for_log("/softbody/feature_tracker", "no mask on /softbody/mask")

    def test_a_mask_of_another_size_is_refused_by_name(self):
        self.frames(self.camera.width)
        self.segmentation.send(None)
        self.recorder.wait(lambda _: self.segmentation.since, "a frame")
        small = Image(height=2, width=3, encoding="mono8", step=3, data=bytes(6))
        subscriber = rospy.Subscriber("/softbody/rgb/image_rect_color", Image, lambda message: self.answer(small, message))
        self.recorder.wait_for_log("/softbody/feature_tracker", "the mask is 3x2", Log.ERROR)
        self.recorder.first("softbody/status", lambda s: "the mask is 3x2" in s.reason, "a status that says so")
        subscriber.unregister()

    def answer(self, mask, image):
        mask.header = image.header
        self.segmentation.publisher.publish(mask)

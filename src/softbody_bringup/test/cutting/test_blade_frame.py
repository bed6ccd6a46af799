"""A blade in another frame than the camera's is found by tf, without an output_frame too: nothing is measured on it; where tf
does not know its frame, that is said and the body is measured as if there were none; where tf comes later than the blade, the
blade counts from then on; a blade of another clock is told of."""
import time
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import Point32, PolygonStamped, TransformStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo
from softbody_msgs.msg import Targets
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from poses import array
from recorder import Recorder

CAMERA, BENCH, LATE, NOWHERE = "camera_color_optical_frame", "bench", "late", "nowhere"
ORIGIN, SIGNS = np.array([0.3, -0.2, 0.9]), np.array([-1.0, -1.0, 1.0])  # of the bench: half a turn about z
FRAMES = 3
# Waiting in each frame, however shortly for each blade, would take longer than the recorder's patience.
MANY_FRAMES, MANY_BLADES = 60, 100
PERIOD_S = 0.2  # of frames
NEAR_M = 0.004
LATE_S = 0.08  # shorter than a frame


class BladeFrame(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__targets=Targets, rosout=Log)
        cls.broadcaster, cls.late_broadcaster = StaticTransformBroadcaster(), TransformBroadcaster()
        cls.broadcaster.sendTransform(cls.bench(BENCH))
        cls.publisher = rospy.Publisher("/softbody/tool/blade", PolygonStamped, queue_size=MANY_BLADES)
        cls.frame, cls.corners, cls.ahead_s = None, None, 0.5 * PERIOD_S
        cls.subscribers = [rospy.Subscriber("/camera/color/camera_info", CameraInfo, cls.show, queue_size=1),
                           rospy.Subscriber("/softbody/targets", Targets, cls.show_many, queue_size=1)]
        cls.middle = cls.targets_of(cls.recorder.wait_for("softbody/targets", 5)[-1]).mean(axis=0)

    @staticmethod
    def bench(name, stamp=rospy.Time(0)):
        bench = TransformStamped()
        bench.header.stamp, bench.header.frame_id, bench.child_frame_id = stamp, CAMERA, name
        bench.transform.translation.x, bench.transform.translation.y, bench.transform.translation.z = ORIGIN
        bench.transform.rotation.z = 1.0
        return bench

    @classmethod
    def publish(cls, stamp):
        blade = PolygonStamped()
        blade.header.stamp, blade.header.frame_id = stamp, cls.frame
        blade.polygon.points = [Point32(*corner) for corner in cls.corners]
        cls.publisher.publish(blade)

    @classmethod
    def show(cls, info):
        """The blade of the frame that comes, and of the next."""
        if cls.frame is None:
            return
        stamp = info.header.stamp + rospy.Duration(cls.ahead_s)
        cls.publish(stamp)
        if cls.frame == LATE:
            time.sleep(LATE_S)
            cls.late_broadcaster.sendTransform(cls.bench(LATE, stamp))

    @classmethod
    def show_many(cls, targets):
        """More blades of the next frame while the tracker is idle, as many at a time as it takes."""
        for k in range(MANY_BLADES if cls.frame == NOWHERE else 0):
            cls.publish(targets.header.stamp + rospy.Duration(PERIOD_S))
            if k % 5 == 0:
                time.sleep(0.005)

    @staticmethod
    def targets_of(message):
        return array(t.position for t in message.targets)

    def near_the_blade(self, message):
        return np.abs(self.targets_of(message)[:, 0] - self.middle[0]).min() < NEAR_M

    def wait_for_frames(self, near, what, frames=FRAMES):
        before = len(self.recorder.messages["softbody/targets"])
        self.recorder.wait(
            lambda seen: len(seen["softbody/targets"]) >= before + frames
            and all(self.near_the_blade(m) == near for m in seen["softbody/targets"][-FRAMES:]), what)

    def hold_blade(self, frame):
        """Upright along the view, through the body's middle."""
        corners = self.middle + np.array([[0, -0.1, -0.1], [0, 0.1, -0.1], [0, 0.1, 0.1], [0, -0.1, 0.1]])
        type(self).corners = (corners - ORIGIN) * SIGNS
        type(self).frame = frame

    def test_1_a_frame_of_tf(self):
        self.wait_for_frames(True, "targets where the blade will be")
        self.hold_blade(BENCH)
        self.wait_for_frames(False, "frames without a target on the blade")

    def test_2_a_frame_that_tf_does_not_know(self):
        self.hold_blade(NOWHERE)
        self.recorder.wait_for_log("/softbody/feature_tracker", NOWHERE)
        self.wait_for_frames(True, "targets as without a blade, in frames that wait for nothing", MANY_FRAMES)

    def test_3_a_frame_of_which_tf_comes_late(self):
        self.hold_blade(LATE)
        self.wait_for_frames(False, "frames without a target on the blade of the late frame")

    def test_4_a_clock_that_is_ahead(self):
        type(self).ahead_s = 50.0
        self.recorder.wait_for_log("/softbody/feature_tracker", "50.0 s ahead of the frame's")

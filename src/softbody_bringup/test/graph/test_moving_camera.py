"""A body at rest before a camera that an arm moves is at rest in output_frame; while tf says nothing of the arm, too late,
or wrongly, frames are left out with the reason, the last good state stays, and tracking goes on as soon as tf is right."""
import threading
import unittest

import numpy as np
import rospy
from softbody_msgs.msg import MeshState, TrackingStatus
from tf2_msgs.msg import TFMessage

from poses import array
from recorder import Recorder

FRAME, CAMERA = "world", "camera_link"
MAX_ERROR_M = 0.003
MISSING = "tf does not say where camera_color_optical_frame is in output_frame world"


class Arm:
    """Passes on what the arm says of itself."""

    def __init__(self):
        self.lock, self.held = threading.Lock(), []
        self.passing, self.late_by, self.offset_m = False, 0, 0.0
        self.publisher = rospy.Publisher("/tf", TFMessage, queue_size=100)
        rospy.Subscriber("/tf_of_the_arm", TFMessage, self._pass, queue_size=100)

    def set(self, passing=True, late_by=0, offset_m=0.0):
        with self.lock:
            self.passing, self.late_by, self.offset_m = passing, late_by, offset_m

    def _pass(self, message):
        with self.lock:
            for transform in message.transforms:
                if transform.child_frame_id == CAMERA:
                    transform.transform.translation.x += self.offset_m
            self.held = (self.held + [message])[-1 - self.late_by:]
            if self.passing and len(self.held) == 1 + self.late_by:
                self.publisher.publish(self.held[0])


class MovingCamera(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = Arm()
        cls.recorder = Recorder(softbody__surface__state=MeshState, ground_truth__surface__state=MeshState,
                                softbody__status=TrackingStatus, tf_of_the_arm=TFMessage)

    def wait_for_status(self, what, condition):
        """A status of a frame from now on."""
        start = rospy.Time.now()
        return self.recorder.first("softbody/status", lambda status: status.header.stamp > start and condition(status),
                                   what)

    def wait_for_skipped(self, what):
        return self.wait_for_status(what, lambda status: MISSING in status.reason)

    def errors_from(self, stamp, count, good=False):
        """Mean errors of so many states of images after a stamp. With good: of so many in a row that are, and are tracked."""
        def error(pair):
            return np.linalg.norm(array(pair[0].vertices) - array(pair[1].vertices), axis=1).mean()

        def found(seen):
            truths = {truth.header.stamp: truth for truth in seen["ground_truth/surface/state"]}
            pairs = [(state, truths[state.header.stamp]) for state in seen["softbody/surface/state"]
                     if state.header.stamp > stamp and state.header.stamp in truths
                     and state.observed == state.header.stamp]
            if good:
                pairs = pairs[-count:]
            tracked = {status.header.stamp for status in seen["softbody/status"] if status.state == TrackingStatus.TRACKING}
            return len(pairs) >= count and (not good or all(error(pair) < MAX_ERROR_M and pair[0].header.stamp in tracked
                                                            for pair in pairs)) and pairs
        pairs = self.recorder.wait(found, f"{count} states with their truths")
        for state, truth in pairs:
            self.assertEqual((state.header.frame_id, truth.header.frame_id), (FRAME, FRAME))
        return [error(pair) for pair in pairs]

    def wait_until_good(self, what):
        """Tracked again, and well in all later states."""
        status = self.wait_for_status(what, lambda status: status.state == TrackingStatus.TRACKING)
        self.assertLess(max(self.errors_from(status.header.stamp, 5)), MAX_ERROR_M)

    def camera_places(self):
        with self.recorder.changed:
            messages = list(self.recorder.messages["tf_of_the_arm"])
        return array([transform.transform.translation for message in messages for transform in message.transforms
                      if transform.child_frame_id == CAMERA])

    def test_1_waits_for_tf(self):
        status = self.wait_for_skipped("a word on the missing transform")
        self.assertEqual(status.state, TrackingStatus.INITIALIZING)

    def test_2_a_body_at_rest_is_at_rest(self):
        self.arm.set()
        self.wait_until_good("tracking")
        places = self.recorder.wait(lambda seen: len(seen["tf_of_the_arm"]) > 20, "20 poses") and self.camera_places()
        self.assertGreater(np.ptp(places, axis=0).max(), 0.03)

    def test_3_tf_is_missing(self):
        self.arm.set(passing=False)
        status = self.wait_for_skipped("a word on the frame that is left out")
        with self.recorder.changed:
            before = next(other for other in reversed(self.recorder.messages["softbody/status"])
                          if other.header.stamp < status.header.stamp)
        # A camera that stalls on a machine with other work has lost the body before.
        was_lost = before.state == TrackingStatus.LOST and MISSING not in before.reason
        self.assertEqual(status.state, TrackingStatus.LOST if was_lost else TrackingStatus.DEGRADED)
        # Six frames of the camera's motion: the body is where it was last seen.
        self.recorder.wait(lambda seen: sum(other.header.stamp > status.header.stamp
                                            for other in seen["softbody/status"]) >= 6, "six frames")
        with self.recorder.changed:
            state, truth = (self.recorder.messages[f"{whose}/surface/state"][-1] for whose in ("softbody", "ground_truth"))
        self.assertEqual(state.header.frame_id, FRAME)
        self.assertLess(np.linalg.norm(array(state.vertices) - array(truth.vertices), axis=1).mean(), MAX_ERROR_M)
        self.arm.set()
        self.wait_until_good("tracking after the gap")

    def test_4_tf_is_late(self):
        self.arm.set(late_by=15)
        self.wait_for_skipped("a word on the late transform")
        self.arm.set()
        self.wait_until_good("tracking after the delay")

    def test_5_tf_jumps(self):
        start = rospy.Time.now()
        self.arm.set(offset_m=0.05)
        self.errors_from(start, 3)
        self.arm.set()
        self.wait_for_status("a frame after the jump", lambda status: True)
        # Of two poses of the arm that one lies between, the first may be the last wrong one.
        self.errors_from(rospy.Time.now(), 3)
        # The body has jumped back too, and where frames are dropped the tracker needs some to find it.
        self.errors_from(rospy.Time.now(), 5, good=True)

"""While a bag is held /clock stands still: the service set_pose answers all the same, and the body is tracked from the pose
set once the clock goes on."""
import threading
import time
import unittest

import numpy as np
import rospy
import tf2_ros
from rosgraph_msgs.msg import Clock
from softbody_msgs.msg import Targets, TrackingStatus
from softbody_msgs.srv import SetPose

from poses import ALIKE, CORNERS_M, placed, pose_in, rotation
from recorder import PATIENCE_S, Recorder

OPTICAL_FRAME, TRUE_FRAME = "camera_color_optical_frame", "ground_truth_softbody"
ROUGH_M = 0.012  # how far off the pose is that is set
MAX_ERROR_M = 0.005
SILENCE_S = 2.0  # in which what is under way arrives
FRAMES = 8


class HeldClock(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = threading.Event()
        cls.runs.set()
        threading.Thread(target=cls.tick, daemon=True).start()
        cls.recorder = Recorder(softbody__targets=Targets, softbody__status=TrackingStatus)
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        cls.service = staticmethod(rospy.ServiceProxy("/softbody/feature_tracker/set_pose", SetPose))
        cls.recorder.first("softbody/targets", lambda targets: not targets.reset,
                           "targets that go on from the last state")
        cls.wait_for_true_frame()
        cls.hold()

    @classmethod
    def wait_for_true_frame(cls):
        end = time.monotonic() + PATIENCE_S
        while not cls.buffer.can_transform(OPTICAL_FRAME, TRUE_FRAME, rospy.Time(0)):
            assert time.monotonic() < end, "no transform of the true body"
            time.sleep(0.05)

    @classmethod
    def tick(cls):
        clock, now = rospy.Publisher("/clock", Clock, queue_size=1), 100.0
        while True:
            clock.publish(Clock(rospy.Time(now)))
            time.sleep(0.02)
            if cls.runs.is_set():
                now += 0.02

    @classmethod
    def hold(cls):
        cls.runs.clear()
        seen = -1
        while seen != len(cls.recorder.messages["softbody/targets"]):
            seen = len(cls.recorder.messages["softbody/targets"])
            time.sleep(SILENCE_S)

    def answer_to(self, pose):
        answers = []
        call = threading.Thread(target=lambda: answers.append(self.service(pose)), daemon=True)
        call.start()
        call.join(PATIENCE_S)
        self.assertTrue(answers, "no answer while the clock stands still")
        return answers[0]

    def test_1_what_tf_does_not_know_is_refused(self):
        later = pose_in(TRUE_FRAME)
        later.header.stamp = rospy.Time.now() + rospy.Duration(10)
        # tf2 says "into the future" only if its buffer has more than one transform.
        for pose, words in ((pose_in("nowhere"), "nowhere"), (later, "extrapolation")):
            response = self.answer_to(pose)
            self.assertFalse(response.success)
            self.assertIn(words, response.message)

    def test_2_the_pose_holds_when_the_clock_goes_on(self):
        # The body looks as well turned about: only what was set tells the two apart.
        turn = ALIKE[3]
        true = self.buffer.lookup_transform(OPTICAL_FRAME, TRUE_FRAME, rospy.Time(0)).transform
        expected = placed(true.translation, true.rotation, CORNERS_M @ rotation(turn).T)
        before = len(self.recorder.messages["softbody/targets"])
        response = self.answer_to(pose_in(TRUE_FRAME, (ROUGH_M, 0.5 * ROUGH_M, -ROUGH_M), turn))
        self.assertTrue(response.success, response.message)
        time.sleep(SILENCE_S)
        self.assertEqual(len(self.recorder.messages["softbody/targets"]), before, "no frame, no targets")

        self.runs.set()
        further = self.recorder.wait(lambda seen: len(seen["softbody/targets"]) >= before + FRAMES
                                     and seen["softbody/targets"][before:], "targets of further frames")
        self.assertTrue(further[0].reset)
        for targets in further:
            found = placed(targets.body_pose.position, targets.body_pose.orientation, CORNERS_M)
            self.assertLess(np.linalg.norm(found - expected, axis=1).max(), MAX_ERROR_M)
        self.recorder.wait(lambda seen: seen["softbody/status"][-1].state == TrackingStatus.TRACKING, "TRACKING")

"""Tracking starts again near a pose that the service feature_tracker/set_pose is given, in any frame of tf."""
import unittest

import numpy as np
import rospy
import tf2_ros
from softbody_msgs.msg import Targets, TrackingStatus
from softbody_msgs.srv import SetPose
from std_srvs.srv import Trigger

from poses import ALIKE, CORNERS_M, placed, pose_in, rotation
from recorder import Recorder

OPTICAL_FRAME, TRUE_FRAME = "camera_color_optical_frame", "ground_truth_softbody"
ROUGH_M = 0.012  # how far off the poses are that are set
MAX_ERROR_M = 0.005


class SetPoseByHand(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__targets=Targets, softbody__status=TrackingStatus)
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        rospy.wait_for_service("/softbody/feature_tracker/set_pose", 120)
        cls.service = staticmethod(rospy.ServiceProxy("/softbody/feature_tracker/set_pose", SetPose))
        cls.wait_for_tracking(0)
        cls.recorder.wait(lambda _: cls.buffer.can_transform(OPTICAL_FRAME, TRUE_FRAME, rospy.Time(0)), "the truth on tf")

    @classmethod
    def wait_for_tracking(cls, since):
        """Until the simulator, too, has taken the start."""
        cls.recorder.first("softbody/targets", lambda targets: not targets.reset,
                           "targets that go on from the last state", since=since)
        cls.recorder.wait(lambda seen: seen["softbody/status"][-1].state == TrackingStatus.TRACKING, "TRACKING")

    def test_the_body_is_tracked_in_the_pose_meant(self):
        true = self.buffer.lookup_transform(OPTICAL_FRAME, TRUE_FRAME, rospy.Time(0)).transform
        for turn in ALIKE:
            expected = placed(true.translation, true.rotation, CORNERS_M @ rotation(turn).T)
            before = len(self.recorder.messages["softbody/targets"])
            response = self.service(pose_in(TRUE_FRAME, (ROUGH_M, 0.5 * ROUGH_M, -ROUGH_M), turn))
            self.assertTrue(response.success, response.message)
            first = self.recorder.first("softbody/targets", lambda t: t.reset, "a start", since=before)
            found = placed(first.body_pose.position, first.body_pose.orientation, CORNERS_M)
            self.assertLess(np.linalg.norm(found - expected, axis=1).max(), MAX_ERROR_M, turn)
            self.wait_for_tracking(self.recorder.messages["softbody/targets"].index(first))

    def test_find_again_starts_without_a_pose(self):
        before = len(self.recorder.messages["softbody/targets"])
        response = rospy.ServiceProxy("/softbody/feature_tracker/find_again", Trigger)()
        self.assertTrue(response.success, response.message)
        first = self.recorder.first("softbody/targets", lambda t: t.reset, "a start", since=before)
        self.wait_for_tracking(self.recorder.messages["softbody/targets"].index(first))

    def test_what_cannot_be_a_pose_is_refused_with_its_reason(self):
        before = len(self.recorder.messages["softbody/targets"])
        for pose, words in ((pose_in("nowhere"), "nowhere"),
                            (pose_in(OPTICAL_FRAME, (0, 0, 0.5), (0, 0, 0, 0)), "quaternion"),
                            (pose_in(OPTICAL_FRAME, (0, float("nan"), 0.5)), "finite")):
            response = self.service(pose)
            self.assertFalse(response.success)
            self.assertIn(words, response.message)
        after = self.recorder.wait(lambda seen: seen["softbody/targets"][before + 5:], "targets of further frames")
        self.assertFalse(any(targets.reset for targets in after), "what is tracked stays")

"""The action recorder/record counts the time that goes by on ROS time: it begins late, and jumps back in each loop of a bag."""
import tempfile
import time
import unittest

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from rosgraph_msgs.msg import Clock
from softbody_msgs.msg import RecordAction, RecordGoal

from recorder import PATIENCE_S

BEGIN_S, LOOP_S, DURATION_S = 1000.0, 0.5, 1.2  # of the clock; the recording lasts for more than two loops
STEP_S = 0.01


class RecordLoop(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file, self.progress = f"{folder.name}/out.bag", []
        self.clock = rospy.Publisher("/clock", Clock, queue_size=1)
        self.client = actionlib.SimpleActionClient("/softbody/recorder/record", RecordAction)
        self.assertTrue(self.client.wait_for_server())

    def wait_for_feedback(self):
        end = time.monotonic() + PATIENCE_S
        while not self.progress:
            self.assertLess(time.monotonic(), end, "feedback")
            time.sleep(0.01)

    def test_the_duration_is_of_time_that_went_by(self):
        self.client.send_goal(RecordGoal(topics=["/words"], file=self.file, duration=DURATION_S), feedback_cb=self.progress.append)
        self.wait_for_feedback()
        end, steps = time.monotonic() + PATIENCE_S, 0
        while self.client.get_state() not in (GoalStatus.SUCCEEDED, GoalStatus.ABORTED):
            self.assertLess(time.monotonic(), end, f"the end of the recording, after {steps} steps of the clock")
            self.clock.publish(Clock(rospy.Time(BEGIN_S + (steps * STEP_S) % LOOP_S)))
            steps += 1
            time.sleep(0.02)
        self.assertEqual(self.client.get_state(), GoalStatus.SUCCEEDED, self.client.get_result())
        self.assertGreaterEqual(steps * STEP_S, DURATION_S)
        seconds = [progress.seconds for progress in self.progress]
        self.assertEqual(seconds, sorted(seconds))
        self.assertLess(seconds[-1], DURATION_S)

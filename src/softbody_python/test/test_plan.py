#!/usr/bin/env python3
"""Plans that cannot be are refused before they are sent. What a running prediction says once the graph is gone."""
import types
import unittest

import numpy as np
import rospy
import rostest
from actionlib import CommState
from actionlib_msgs.msg import GoalStatus
from softbody_msgs.msg import PredictPlansGoal

import softbody
from softbody.plan import plan_messages
from softbody.running_prediction import RunningPrediction


def changed(row, column, value):
    matrix = np.eye(4)
    matrix[row, column] = value
    return matrix


class Plans(unittest.TestCase):
    def test_a_matrix_that_is_not_rigid(self):
        for motion in (changed(0, 0, 1.1), changed(0, 0, -1.0), changed(0, 1, 0.1), changed(3, 0, 0.1), changed(3, 3, 2.0),
                       changed(1, 1, np.nan), changed(0, 3, np.inf)):
            with self.assertRaisesRegex(ValueError, "not rigid"):
                softbody.Plan().move("hand", [(1.0, motion)])
        with self.assertRaisesRegex(ValueError, "shape"):
            softbody.Plan().move("hand", [(1.0, np.eye(3))])

    def test_a_rigid_matrix_in_single_precision(self):
        quarter = np.array([[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]], dtype=np.float32)
        pose = softbody.Plan().move("hand", [(1.0, quarter)]).message().motions[0].poses[0]
        self.assertEqual((pose.position.x, pose.position.y, pose.position.z), (1, 2, 3))
        self.assertAlmostEqual(abs(pose.orientation.z), 0.5**0.5)
        self.assertAlmostEqual(pose.orientation.z, pose.orientation.w)

    def test_a_plan_that_is_not_in_a_list(self):
        for plans in (softbody.Plan(), {"hand": [(1.0, [0, 0, 0.1])]}):
            with self.assertRaisesRegex(ValueError, "^plans is a list of plans$"):
                plan_messages(plans)

    def test_a_simulator_that_was_started_again(self):
        handle = types.SimpleNamespace(get_comm_state=lambda: CommState.DONE, get_goal_status=lambda: GoalStatus.LOST,
                                       get_result=lambda: None)
        client = types.SimpleNamespace(ns="predict_plans", send_goal=lambda *_: handle)
        running = RunningPrediction(client, PredictPlansGoal(), None)
        self.assertRaisesRegex(rospy.ROSException, "^predict_plans: the simulator was started again", running.result)


if __name__ == "__main__":
    rostest.rosrun("softbody_python", "plan", Plans)

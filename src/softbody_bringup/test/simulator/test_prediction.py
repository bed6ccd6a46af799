#!/usr/bin/env python3
"""The service simulator/predict, with a pin that is planned to move."""
import os
import sys
import unittest

import numpy as np
import rospy
import rostest
import softbody
from geometry_msgs.msg import Point, Point32, Pose, Quaternion
from softbody_msgs.msg import MeshState, MotionPlan, PlannedMotion, Targets, TetTopology
from softbody_msgs.srv import Pin, Predict

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "shared"))
from recorder import Recorder  # pylint: disable=wrong-import-position


def array(points):
    return np.array([[p.x, p.y, p.z] for p in points])


def raised(name, height):
    return MotionPlan(motions=[PlannedMotion(name=name, times=[0.5],
                                             poses=[Pose(Point(0.0, 0.0, height), Quaternion(w=1.0))])])


class Prediction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState)
        cls.targets = rospy.Publisher("/softbody/targets", Targets, queue_size=1)
        rest = array(cls.recorder.wait_for("softbody/volume/topology")[-1].rest_vertices)
        cls.recorder.wait(lambda _: cls.targets.get_num_connections() > 0, "a simulator that listens")
        cls.predict = rospy.ServiceProxy("/softbody/simulator/predict", Predict)
        cls.unplaced = cls.predict(times=[1.0], plans=[MotionPlan()])
        low, high = rest.min(axis=0) - 0.001, rest.max(axis=0) + 0.001
        cls.held = rest[:, 0] < low[0] + 0.02
        hold = rospy.ServiceProxy("/softbody/simulator/pin", Pin)
        assert hold(name="hand", min=Point32(*low), max=Point32(low[0] + 0.02, high[1], high[2])).success
        for frame in range(3):  # the pin acts from the second frame on
            stamp = rospy.Time(100 + frame)
            message = Targets(reset=frame == 0, body_pose=Pose(orientation=Quaternion(w=1.0)))
            message.header.stamp, message.header.frame_id = stamp, "world"
            cls.targets.publish(message)
            cls.state = cls.recorder.wait(
                lambda seen, stamp=stamp: next((s for s in seen["softbody/volume/state"] if s.header.stamp == stamp), None),
                "the volume state of a frame")

    def test_plans_move_the_held_end_and_leave_the_body_alone(self):
        plans = [raised("hand", 0.0), raised("hand", 0.04)]
        result = self.predict(times=[0.5, 2.0], plans=plans)
        self.assertTrue(result.success, result.message)
        self.assertEqual(result.header.frame_id, "world")
        self.assertEqual(len(result.states), 4)
        shapes = [array(state.vertices) for state in result.states]
        present = array(self.state.vertices)
        np.testing.assert_allclose(shapes[1], present, atol=1e-4)
        np.testing.assert_allclose((shapes[2] - present)[self.held].mean(axis=0), [0.0, 0.0, 0.04], atol=1e-4)
        # Without gravity the body ends where its held end carries it, and pulls no more.
        np.testing.assert_allclose((shapes[3] - present).mean(axis=0), [0.0, 0.0, 0.04], atol=4e-3)
        self.assertEqual(result.states[3].names, ["hand"])
        pull = [abs(state.reactions[0].force.z) for state in result.states]
        self.assertGreater(pull[2], 10.0 * pull[3])
        self.assertEqual(result.states, self.predict(times=[0.5, 2.0], plans=plans).states)
        self.assertEqual(self.recorder.wait_for("softbody/volume/state")[-1].vertices, self.state.vertices)

    def test_python_gets_the_same_numbers(self):
        lifted, turned = np.eye(4), np.eye(4)
        lifted[:3, 3] = [0.0, 0.0, 0.04]
        turned[:3, :3] = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
        quarter = PlannedMotion(name="hand", times=[0.5], poses=[Pose(orientation=Quaternion(z=0.5**0.5, w=0.5**0.5))])
        body = softbody.Body()
        for motion, message in (([0.0, 0.0, 0.04], raised("hand", 0.04)), (lifted, raised("hand", 0.04)),
                                (turned, MotionPlan(motions=[quarter]))):
            raw = self.predict(times=[0.5, 2.0], plans=[message]).states
            [plan] = body.predict([{"hand": [(0.5, motion)]}], [0.5, 2.0])
            for prediction, state in zip(plan, raw):
                np.testing.assert_allclose(prediction.vertices, array(state.vertices), atol=1e-6)
                self.assertAlmostEqual(prediction.reactions["hand"][0][2], state.reactions[0].force.z, places=4)

    def test_bad_requests_are_refused_with_a_sentence(self):
        self.assertFalse(self.unplaced.success)
        self.assertIn("not placed", self.unplaced.message)
        for request, words in ((dict(times=[1.0], plans=[raised("foot", 0.1)]), "'foot'"),
                               (dict(times=[1.0, 0.5], plans=[MotionPlan()]), "ascending"),
                               (dict(times=[], plans=[MotionPlan()]), "nothing to predict"),
                               (dict(times=[1.0], plans=[MotionPlan()], time_step=-1.0), "time_step"),
                               (dict(times=[60.0], plans=2 * [MotionPlan()], time_step=0.001), "fewer plans")):
            answer = self.predict(**request)
            self.assertFalse(answer.success)
            self.assertIn(words, answer.message)


if __name__ == "__main__":
    rospy.init_node("test_prediction")
    rostest.rosrun("softbody_bringup", "prediction", Prediction)

"""The action simulator/predict_plans: progress, cancel, goals that replace others, and a graph that runs beside it."""
import random
import threading
import time
import unittest

import actionlib
import numpy as np
import rospy
import softbody
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import Point, Point32, Pose, Quaternion
from softbody_msgs.msg import (MeshState, MotionPlan, PlannedMotion, PlannedPin, PredictPlansAction, PredictPlansGoal,
                               TetTopology)
from softbody_msgs.srv import Pin, Predict

from hand_made_frames import Frames
from recorder import PATIENCE_S, Recorder

PERIOD_S = 1.0 / 30.0
LEAST_RATE_HZ = 10.0  # where other programs use all processors
SOON_S = 20.0  # the long goal takes minutes


def lifts(count):
    """Plans that lift the held end to many heights, half of them with a second grip."""
    dice = random.Random(0)
    plans = []
    for k in range(count):
        height = dice.uniform(0.0, 0.05)
        plan = MotionPlan(motions=[PlannedMotion(name="hand", times=[1.0],
                                                 poses=[Pose(Point(0.0, 0.0, height), Quaternion(w=1.0))])])
        if k % 2:
            plan.pins = [PlannedPin(name="claw", grip_time=0.5, min=Point32(0.05, -1, -1), max=Point32(1, 1, 1))]
        plans.append(plan)
    return plans


def long_goal():
    """600,000 steps."""
    return PredictPlansGoal(times=[20.0], plans=lifts(1000))


class PredictPlans(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState)
        cls.recorder.wait_for("softbody/volume/topology")
        cls.frames = Frames(cls.recorder, "world")
        cls.predict = rospy.ServiceProxy("/softbody/simulator/predict", Predict)
        hold = rospy.ServiceProxy("/softbody/simulator/pin", Pin)
        assert hold(name="hand", min=Point32(-1, -1, -1), max=Point32(-0.07, 1, 1)).success
        cls.action = cls.client()
        for frame in range(3):  # the pin acts from the second frame on
            cls.frames.step(reset=frame == 0)

    @classmethod
    def client(cls):
        client = actionlib.SimpleActionClient("/softbody/simulator/predict_plans", PredictPlansAction)
        assert client.wait_for_server(rospy.Duration(PATIENCE_S))
        return client

    def begin(self, client, goal):
        """Sends a goal, and waits until it runs."""
        runs = threading.Event()
        client.send_goal(goal, feedback_cb=lambda _: runs.set())
        self.assertTrue(runs.wait(PATIENCE_S), "no progress")

    def ended(self, client, status):
        """@return the result of a goal that ends so."""
        self.assertTrue(client.wait_for_result(rospy.Duration(SOON_S)), "the goal does not end")
        self.assertEqual(client.get_state(), status)
        return client.get_result()

    def test_progress_comes_and_the_result_is_that_of_the_service(self):
        plans, done = lifts(100), []
        self.action.send_goal(PredictPlansGoal(times=[0.5, 1.0], plans=plans), feedback_cb=done.append)
        result = self.ended(self.action, GoalStatus.SUCCEEDED)
        counts = [progress.done for progress in done]  # the last ones may come after the result
        self.assertGreater(len(counts), 10)
        self.assertEqual(counts, sorted(set(counts)))
        self.assertLessEqual(counts[-1], 100)
        self.assertEqual({progress.total for progress in done}, {100})
        answer = self.predict(times=[0.5, 1.0], plans=plans)
        for field in ("success", "message", "header", "revision", "states"):
            self.assertEqual(getattr(result, field), getattr(answer, field))
        self.assertEqual(len(result.states), 200)

    def test_a_goal_that_cannot_be_is_aborted_with_the_reason(self):
        foot = MotionPlan(motions=[PlannedMotion(name="foot")])
        self.action.send_goal(PredictPlansGoal(times=[1.0], plans=[foot]))
        result = self.ended(self.action, GoalStatus.ABORTED)
        self.assertFalse(result.success)
        self.assertIn("plan 0: motions[0] 'foot'", result.message)
        self.assertEqual(self.action.get_goal_status_text(), result.message)

    def test_cancel_ends_a_goal_soon(self):
        self.begin(self.action, long_goal())
        self.action.cancel_goal()
        result = self.ended(self.action, GoalStatus.PREEMPTED)
        self.assertFalse(result.success)
        self.assertEqual((result.message, result.states), ("the goal was cancelled", []))
        self.assertTrue(self.predict(times=[0.5], plans=lifts(1)).success)

    def test_a_second_goal_replaces_the_first(self):
        other = self.client()
        self.begin(self.action, long_goal())
        other.send_goal(PredictPlansGoal(times=[1.0], plans=lifts(2)))
        self.assertEqual(self.ended(self.action, GoalStatus.PREEMPTED).message, "another goal has come")
        self.assertEqual(len(self.ended(other, GoalStatus.SUCCEEDED).states), 2)

    def test_python_starts_cancels_and_waits(self):
        body, progress, runs = softbody.Body(), [], threading.Event()
        self.addCleanup(body.close)
        plans = [{"hand": [(0.5, [0.0, 0.0, 0.001 * k])]} for k in range(20)]
        predictions = body.predict_plans(plans, [0.5], on_progress=lambda *numbers: progress.append(numbers)).result(SOON_S)
        self.assertEqual((predictions.frame, predictions.revision), ("world", 0))
        for plan, [prediction] in zip(body.predict(plans, [0.5]), predictions):
            np.testing.assert_array_equal(prediction.vertices, plan[0].vertices)
        self.assertEqual(progress[0], (1, 20))
        running = body.predict_plans(1000 * [{}], [20.0], on_progress=lambda *_: runs.set())
        self.assertRaises(TimeoutError, running.result, 0.01)
        self.assertTrue(runs.wait(PATIENCE_S), "no progress")
        self.assertFalse(running.done())
        running.cancel()
        self.assertRaisesRegex(softbody.Cancelled, "cancelled", running.result, SOON_S)
        replaced = body.predict_plans(1000 * [{}], [20.0])
        self.assertEqual(len(body.predict_plans([{}], [0.5]).result(SOON_S)), 1)
        self.assertRaises(softbody.Cancelled, replaced.result, SOON_S)
        self.assertRaisesRegex(softbody.Refused, "'foot'", body.predict_plans([{"foot": []}], [0.5]).result, SOON_S)
        self.assertRaises(rospy.ROSException, softbody.Body("/nowhere", service_timeout_s=0.1).predict_plans, [{}], [0.5])

    def test_a_running_graph_is_not_disturbed(self):
        """Targets at 30 Hz, each answered by a state, in order, while 1000 plans are predicted. On a busy machine the
        next one waits for the answer."""
        self.action.send_goal(PredictPlansGoal(times=[1.0], plans=lifts(1000)))
        sent, rate, begin = [], rospy.Rate(1.0 / PERIOD_S), time.monotonic()
        while not self.action.wait_for_result(rospy.Duration(1e-3)):
            sent.append(self.frames.step().header.stamp)
            self.assertLess(time.monotonic() - begin, PATIENCE_S, "the goal does not end")
            rate.sleep()
        duration_s = time.monotonic() - begin
        self.assertEqual(len(self.ended(self.action, GoalStatus.SUCCEEDED).states), 1000)
        self.assertGreater(len(sent), LEAST_RATE_HZ * duration_s)
        answered = [s.header.stamp for s in self.recorder.messages["softbody/volume/state"] if s.header.stamp >= sent[0]]
        self.assertEqual(answered, sent)

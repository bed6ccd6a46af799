"""The service simulator/predict, with a pin that is planned to move."""
import unittest

import numpy as np
import rospy
import softbody
from geometry_msgs.msg import Point, Point32, Pose, Quaternion, Vector3
from softbody_msgs.msg import (MeshState, MotionPlan, PlannedMotion, PlannedObstacle, PlannedPin, PlannedRelease,
                               TetTopology)
from softbody_msgs.srv import Pin, Predict
from std_msgs.msg import Header

from hand_made_frames import Frames
from poses import array
from recorder import Recorder


def raised(name, height):
    return MotionPlan(motions=[PlannedMotion(name=name, times=[0.5],
                                             poses=[Pose(Point(0.0, 0.0, height), Quaternion(w=1.0))])])


def pin(name="claw", **fields):
    return PlannedPin(**{"name": name, "min": Point32(-1, -1, -1), "max": Point32(1, 1, 1), **fields})


def ball(name="ball", **fields):
    return PlannedObstacle(**{"name": name, "shape": "sphere", "radius": 0.02,
                              "pose": Pose(Point(0.0, 0.0, 1.0), Quaternion(w=1.0)), **fields})


def motion(times, poses, name="hand"):
    return PlannedMotion(name=name, times=times, poses=[Pose(Point(*shift), Quaternion(w=1.0)) for shift in poses])


NAN, NOWHERE, UP = float("nan"), Header(frame_id="nowhere"), [0.0, 0.0, 0.1]

# Each is refused: its plan, and words of the reason. "hand" acts at present.
REFUSED_PLANS = (
    (MotionPlan(motions=[motion([0.5], [UP], "foot")]), "motions[0] 'foot'", "no pin or obstacle", "known names: hand"),
    (MotionPlan(motions=[motion([0.5], [UP])] * 2), "motions[1] 'hand'", "twice"),
    (MotionPlan(motions=[motion([], [])] * 2), "motions[1] 'hand'", "twice"),
    (MotionPlan(motions=[motion([0.5, 0.5], [UP, UP])]), "motions[0] 'hand'", "ascending"),
    (MotionPlan(motions=[motion([NAN], [UP])]), "motions[0] 'hand'", "nan", "above 0"),
    (MotionPlan(motions=[motion([0.5, 0.6], [UP])]), "motions[0] 'hand'", "2 times with 1 poses"),
    (MotionPlan(motions=[motion([0.4, 0.5], [UP, [0.0, NAN, 0.0]])]), "motions[0] 'hand'", "poses[1]", "finite"),
    (MotionPlan(motions=[PlannedMotion(name="hand", times=[0.5], poses=[Pose()])]), "poses[0]", "quaternion"),
    (MotionPlan(pins=[pin("hand")]), "pins[0] 'hand'", "already"),
    (MotionPlan(pins=[pin(), pin()]), "pins[1] 'claw'", "already"),
    (MotionPlan(pins=[pin("claw")], obstacles=[ball("claw")]), "obstacles[0] 'claw'", "already"),
    (MotionPlan(pins=[pin("a b")]), "pins[0] 'a b'", "letters"),
    (MotionPlan(pins=[pin("")]), "pins[0] ''", "letters"),
    (MotionPlan(pins=[pin(min=Point32(1, 1, 1), max=Point32(-1, -1, -1))]), "pins[0] 'claw': the box is empty"),
    (MotionPlan(pins=[pin(max=Point32(1, NAN, 1))]), "pins[0] 'claw'", "box", "empty"),
    (MotionPlan(pins=[pin(min=Point32(0.9, 0.9, 0.9))]), "pins[0] 'claw'", "contains nothing", "enlarge"),
    (MotionPlan(pins=[pin(header=NOWHERE, in_frame=True)]), "pins[0] 'claw'", "tf does not know frame 'nowhere'"),
    (MotionPlan(pins=[pin(header=NOWHERE)]), "pins[0] 'claw'", "set in_frame"),
    (MotionPlan(pins=[pin(in_frame=True, min=Point32(0.9, 0.9, 0.9), grip_time=0.5)]), "'claw'", "nothing of the body", "0.5 s"),
    (MotionPlan(pins=[pin(grip_time=-0.1)]), "pins[0] 'claw'", "grip_time is -0.1"),
    (MotionPlan(pins=[pin(grip_time=NAN)]), "pins[0] 'claw'", "grip_time is nan"),
    (MotionPlan(pins=[pin(release_time=61.0)]), "pins[0] 'claw'", "release_time is 61", "0 to 60 s"),
    (MotionPlan(pins=[pin(grip_time=0.5, release_time=0.5)]), "pins[0] 'claw'", "not after", "later"),
    (MotionPlan(pins=[pin(grip_time=0.51, release_time=0.52)]), "pins[0] 'claw'", "no step", "longer"),
    (MotionPlan(obstacles=[ball(shape="cone")]), "obstacles[0] 'ball'", "shape", "cone", "capsule"),
    (MotionPlan(obstacles=[ball(shape="")]), "obstacles[0] 'ball'", "shape", "capsule"),
    (MotionPlan(obstacles=[ball(radius=-1.0)]), "obstacles[0] 'ball': radius is -1;"),
    (MotionPlan(obstacles=[ball(shape="box", radius=-1.0, size=Vector3(0.1, 0.1, 0.1))]), "obstacles[0] 'ball': radius is -1;"),
    (MotionPlan(obstacles=[ball(shape="capsule", length=-1.0)]), "obstacles[0] 'ball': length is -1;"),
    (MotionPlan(obstacles=[ball(shape="box", size=Vector3(0.1, 0.1, NAN))]), "obstacles[0] 'ball': size is ["),
    (MotionPlan(obstacles=[ball(shape="box", size=Vector3(0.1, 0.1, -0.1))]), "obstacles[0] 'ball': size is ["),
    (MotionPlan(obstacles=[ball(friction=NAN)]), "obstacles[0] 'ball'", "friction"),
    (MotionPlan(obstacles=[ball(pose=Pose())]), "obstacles[0] 'ball'", "quaternion"),
    (MotionPlan(obstacles=[ball(header=NOWHERE)]), "obstacles[0] 'ball'", "tf does not know frame 'nowhere'"),
    (MotionPlan(obstacles=[ball(begin_time=0.5, end_time=0.4)]), "obstacles[0] 'ball'", "end_time 0.4 s is not after"),
    (MotionPlan(obstacles=[ball(f"ball_{k}") for k in range(1001)]), "obstacles[1000]", "fewer"),
    (MotionPlan(releases=[PlannedRelease("foot", 0.5)]), "releases[0] 'foot'", "no pin or obstacle"),
    (MotionPlan(releases=[PlannedRelease("hand", 0.0), PlannedRelease("hand", 0.5)]), "releases[1] 'hand'", "twice"),
    (MotionPlan(releases=[PlannedRelease("hand", NAN)]), "releases[0] 'hand'", "time is nan"),
    (MotionPlan(pins=[pin()], releases=[PlannedRelease("claw", 0.5)]), "releases[0] 'claw'", "release_time"),
)


class Prediction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState)
        rest = array(cls.recorder.wait_for("softbody/volume/topology")[-1].rest_vertices)
        frames = Frames(cls.recorder, "world")
        cls.predict = rospy.ServiceProxy("/softbody/simulator/predict", Predict)
        cls.unplaced = cls.predict(times=[1.0], plans=[MotionPlan()])
        low, high = rest.min(axis=0) - 0.001, rest.max(axis=0) + 0.001
        cls.held = rest[:, 0] < low[0] + 0.02
        hold = rospy.ServiceProxy("/softbody/simulator/pin", Pin)
        assert hold(name="hand", min=Point32(*low), max=Point32(low[0] + 0.02, high[1], high[2])).success
        for frame in range(3):  # the pin acts from the second frame on
            cls.state = frames.step(reset=frame == 0)

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
            predicted = body.predict([{"hand": [(0.5, motion)]}], [0.5, 2.0])
            self.assertEqual((predicted.stamp, predicted.frame, predicted.revision), (self.state.header.stamp, "world", 0))
            [plan] = predicted
            for prediction, state in zip(plan, raw):
                np.testing.assert_allclose(prediction.vertices, array(state.vertices), atol=1e-6)
                self.assertAlmostEqual(prediction.reactions["hand"][0][2], state.reactions[0].force.z, places=4)

    def test_python_plans_are_the_messages(self):
        up = [(0.5, [0.0, 0.0, 0.1])]
        made = (softbody.Plan().grip("claw", [-1] * 3, [1] * 3, frame="world", begin_s=0.1, end_s=0.6, path=up)
                .grip("tail", [-1] * 3, [1] * 3)
                .add_obstacle("ball", "sphere", [0, 0, 1], radius=0.02, friction=0.5, begin_s=0.2, end_s=0.7)
                .add_obstacle("block", "box", [0, 0, 2], frame="world", size=[0.1, 0.1, 0.1])
                .release("hand", 0.3))
        message = MotionPlan(pins=[pin(header=Header(frame_id="world"), in_frame=True, grip_time=0.1, release_time=0.6),
                                   pin("tail")],
                             obstacles=[ball(friction=0.5, begin_time=0.2, end_time=0.7),
                                        ball("block", header=Header(frame_id="world"), shape="box", radius=0.0,
                                             size=Vector3(0.1, 0.1, 0.1), pose=Pose(Point(0.0, 0.0, 2.0), Quaternion(w=1.0)))],
                             releases=[PlannedRelease("hand", 0.3)], motions=[motion([0.5], [[0.0, 0.0, 0.1]], "claw")])
        self.assertEqual(made.message(), message)
        [[early, late]] = softbody.Body().predict([made], [0.25, 1.0])
        self.assertEqual((set(early.reactions), set(late.reactions)),
                         ({"ball", "block", "claw", "hand", "tail"}, {"block", "tail"}))
        self.assertEqual(late.contacts, [])

    def test_bad_requests_are_refused_with_a_sentence(self):
        self.assertFalse(self.unplaced.success)
        self.assertIn("not placed", self.unplaced.message)
        for request, words in ((dict(times=[1.0], plans=[raised("foot", 0.1)]), "'foot'"),
                               (dict(times=[1.0, 0.5], plans=[MotionPlan()]), "ascending"),
                               (dict(times=[], plans=[MotionPlan()]), "nothing to predict"),
                               (dict(times=[1.0], plans=[MotionPlan()], time_step=-1.0), "time_step"),
                               (dict(times=[1.0], plans=[MotionPlan()], time_step=NAN), "time_step"),
                               (dict(times=[NAN], plans=[MotionPlan()]), "nan s is not above 0"),
                               (dict(times=[0.0], plans=[MotionPlan()]), "times: 0 s is not above 0"),
                               (dict(times=[61.0], plans=[MotionPlan()]), "times: 61 s is too long; allowed: up to 60 s"),
                               (dict(times=[60.0], plans=2 * [MotionPlan()], time_step=0.001), "fewer plans"),
                               (dict(times=[0.1], plans=[MotionPlan(obstacles=[ball(header=Header(frame_id=f"frame_{k}"))])
                                                         for k in range(101)]), "101 frames")):
            answer = self.predict(**request)
            self.assertFalse(answer.success)
            self.assertIn(words, answer.message)

    def test_bad_plans_are_refused_by_plan_and_entry_and_the_node_goes_on(self):
        good = raised("hand", 0.01)
        expected = self.predict(times=[0.7], plans=[good])
        self.assertTrue(expected.success, expected.message)
        for plan, *words in REFUSED_PLANS:
            with self.subTest(words):
                answer = self.predict(times=[0.7], plans=[good, plan])
                self.assertFalse(answer.success)
                self.assertEqual(answer.states, [])
                for word in ["plan 1: ", *words]:
                    self.assertIn(word, answer.message)
                self.assertEqual(self.predict(times=[0.7], plans=[good]), expected)

    def test_a_frame_may_have_a_leading_slash(self):
        plan = MotionPlan(pins=[pin(header=Header(frame_id="/world"), in_frame=True)], releases=[PlannedRelease("hand", 0.0)])
        answer = self.predict(times=[0.5], plans=[plan])
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.states[0].names, ["claw"])

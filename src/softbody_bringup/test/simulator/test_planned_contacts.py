"""Plans with a grip, a release and an obstacle that comes, and the contacts that they predict."""
import time
import unittest

import numpy as np
import rospy
import softbody
import tf2_ros
from geometry_msgs.msg import Point, Point32, Pose, Quaternion, TransformStamped, Vector3
from softbody_msgs.msg import (MeshState, MotionPlan, PlannedMotion, PlannedObstacle, PlannedPin, PlannedRelease,
                               TetTopology)
from softbody_msgs.srv import Pin, Predict
from std_msgs.msg import Header

from hand_made_frames import Frames
from poses import array, vector
from recorder import PATIENCE_S, Recorder

DENSITY_KG_M3, GRAVITY_M_S2 = 30.0, 9.81
FRAMES_TO_REST = 40


def shifted(*shift):
    return Pose(Point(*shift), Quaternion(w=1.0))


class PlannedContacts(unittest.TestCase):
    """At present the body lies on the ground, and the pin "hand" holds its left end."""

    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState)
        topology = cls.recorder.wait_for("softbody/volume/topology")[-1]
        cls.rest = array(topology.rest_vertices)
        edges = cls.rest[[tet.vertex_indices for tet in topology.tets]]
        volume = np.linalg.det(edges[:, 1:] - edges[:, :1]).sum() / 6.0
        cls.weight = DENSITY_KG_M3 * GRAVITY_M_S2 * volume
        frames = Frames(cls.recorder, "world")
        cls.predict = rospy.ServiceProxy("/softbody/simulator/predict", Predict)
        cls.low, cls.high = cls.rest.min(axis=0), cls.rest.max(axis=0)
        cls.left, cls.right = cls.rest[:, 0] < cls.low[0] + 0.03, cls.rest[:, 0] > cls.high[0] - 0.03
        for frame in range(FRAMES_TO_REST):
            if frame == FRAMES_TO_REST - 2:
                hold = rospy.ServiceProxy("/softbody/simulator/pin", Pin)
                assert hold(name="hand", min=Point32(-1, -1, -1), max=Point32(cls.low[0] + 0.03, 1, 1)).success
            state = frames.step(reset=frame == 0, body_pose=shifted(0.0, 0.0, -0.03 - cls.low[2]))
        cls.present = array(state.vertices)
        cls.gripper = cls.present[cls.right].mean(axis=0)
        cls.broadcaster = tf2_ros.StaticTransformBroadcaster()
        transform = TransformStamped(child_frame_id="gripper", header=Header(frame_id="world"))
        transform.transform.translation, transform.transform.rotation = Vector3(*cls.gripper), Quaternion(w=1.0)
        cls.broadcaster.sendTransform(transform)

    def states(self, times, **plan):
        """Of one plan. tf may need a moment to know the gripper."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            answer = self.predict(times=times, plans=[MotionPlan(**plan)])
            if "tf does not know" not in answer.message or time.monotonic() > deadline:
                break
            rospy.sleep(0.1)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(len(answer.states), len(times))
        return answer.states

    def reaction(self, state, name):
        return vector(state.reactions[state.names.index(name)].force)

    def lets_go(self):
        return [PlannedRelease(name="hand", time=0.0)]

    def test_a_grip_lifts_the_body(self):
        claw = PlannedPin(header=Header(frame_id="gripper"), name="claw", in_frame=True, grip_time=0.2,
                          min=Point32(-0.05, -0.2, -0.05), max=Point32(0.05, 0.2, 0.05))
        up = PlannedMotion(name="claw", times=[0.2, 1.2], poses=[shifted(0.0, 0.0, 0.0), shifted(0.0, 0.0, 0.4)])
        before, lifted, hanging = self.states([0.1, 1.2, 5.0], pins=[claw], motions=[up], releases=self.lets_go())
        self.assertEqual(before.names, ["ground"])
        self.assertEqual(lifted.names, ["claw", "ground"])
        held = (np.abs(self.present - self.gripper) < [0.05, 0.2, 0.05]).all(axis=1)
        np.testing.assert_allclose((array(lifted.vertices) - self.present)[held].mean(axis=0), [0.0, 0.0, 0.4], atol=2e-3)
        np.testing.assert_allclose(self.reaction(hanging, "claw"), [0.0, 0.0, -self.weight], atol=0.02 * self.weight)
        self.assertEqual(hanging.contacts, [])

    def test_a_pin_in_rest_space_holds_what_is_there_when_it_grips(self):
        high = [0.0, 0.0, 0.3]
        rise = PlannedMotion(name="hand", times=[0.5], poses=[shifted(*high)])
        tail = PlannedPin(name="tail", grip_time=1.0, min=Point32(self.high[0] - 0.03, -1, -1), max=Point32(1, 1, 1))
        grips, later = self.states([1.0, 3.0], motions=[rise], pins=[tail])
        self.assertEqual((grips.names, later.names), (["ground", "hand"], ["ground", "hand", "tail"]))
        np.testing.assert_allclose(array(later.vertices)[self.right], array(grips.vertices)[self.right], atol=2e-3)

    def test_a_release_lets_the_body_fall(self):
        rise = PlannedMotion(name="hand", times=[0.5], poses=[shifted(0.0, 0.0, 0.4)])
        high, low = self.states([1.5, 5.0], motions=[rise], releases=[PlannedRelease(name="hand", time=1.5)])
        self.assertEqual((high.names, low.names), (["ground", "hand"], ["ground"]))
        np.testing.assert_allclose((array(high.vertices) - self.present)[self.left].mean(axis=0), [0.0, 0.0, 0.4], atol=2e-3)
        self.assertLess(array(low.vertices)[:, 2].mean(), -0.03 + 0.06)
        np.testing.assert_allclose(self.reaction(low, "ground"), [0.0, 0.0, -self.weight], atol=0.05 * self.weight)

    def test_an_obstacle_comes_pushes_and_goes(self):
        face = self.present[:, 0].min() - 0.01
        ram = PlannedObstacle(name="ram", shape="box", size=Vector3(0.02, 0.3, 0.1), pose=shifted(face - 0.01, 0.0, 0.0),
                              begin_time=0.2, end_time=1.5)
        push = PlannedMotion(name="ram", times=[0.2, 1.2], poses=[shifted(0.0, 0.0, 0.0), shifted(0.06, 0.0, 0.0)])
        before, pushed, after = self.states([0.1, 1.2, 2.0], obstacles=[ram], motions=[push], releases=self.lets_go())
        self.assertEqual([state.names for state in (before, pushed, after)], [["ground"], ["ground", "ram"], ["ground"]])
        np.testing.assert_allclose(array(before.vertices), self.present, atol=1e-3)
        self.assertAlmostEqual(array(pushed.vertices)[:, 0].min(), face + 0.06, delta=1e-3)
        self.assertAlmostEqual(array(pushed.vertices)[:, 0].mean(), self.present[:, 0].mean() + 0.05, delta=5e-3)
        # Friction of the ground: the ram feels it.
        self.assertAlmostEqual(self.reaction(pushed, "ram")[0], -0.3 * self.weight, delta=0.05 * self.weight)
        self.the_patches_add_up(pushed, ["ground", "ram"])
        normals = {patch.name: vector(patch.normal) for patch in pushed.contacts}
        np.testing.assert_allclose(normals["ground"], [0.0, 0.0, 1.0], atol=1e-6)
        np.testing.assert_allclose(normals["ram"], [1.0, 0.0, 0.0], atol=1e-6)

    def test_the_contacts_of_a_ball_that_drags_have_a_torque(self):
        top = [0.02, 0.01, self.present[:, 2].max()]
        ball = PlannedObstacle(name="ball", shape="sphere", radius=0.03, friction=0.5, begin_time=0.1,
                               pose=shifted(*np.add(top, [0.0, 0.0, 0.031])))
        drag = PlannedMotion(name="ball", times=[0.5, 0.8], poses=[shifted(0.0, 0.0, -0.016), shifted(0.01, 0.01, -0.016)])
        [state] = self.states([0.8], obstacles=[ball], motions=[drag])
        self.the_patches_add_up(state, ["ball", "ground"])
        [patch] = [patch for patch in state.contacts if patch.name == "ball"]
        self.assertLess(vector(patch.normal)[2], -0.9)
        self.assertGreater(vector(patch.force)[2], 0.1 * self.weight)  # the body pushes the ball up
        self.assertGreater(np.linalg.norm(vector(patch.torque)), 1e-4 * self.weight * 0.03)

        plan = softbody.Plan().add_obstacle("ball", "sphere", np.add(top, [0.0, 0.0, 0.031]), radius=0.03, friction=0.5,
                                            begin_s=0.1, path=[(0.5, [0.0, 0.0, -0.016]), (0.8, [0.01, 0.01, -0.016])])
        [[prediction]] = softbody.Body().predict([plan], [0.8])
        [python_patch] = [patch for patch in prediction.contacts if patch.name == "ball"]
        for field in ("place", "normal", "force", "torque"):
            np.testing.assert_array_equal(getattr(python_patch, field), vector(getattr(patch, field)))

    def the_patches_add_up(self, state, names):
        self.assertEqual(sorted({patch.name for patch in state.contacts}), names)
        vertices = array(state.vertices)
        for name in names:
            patches = [patch for patch in state.contacts if patch.name == name]
            reaction = state.reactions[state.names.index(name)]
            force = sum(vector(patch.force) for patch in patches)
            torque = sum(vector(patch.torque) + np.cross(vector(patch.place), vector(patch.force)) for patch in patches)
            np.testing.assert_allclose(force, vector(reaction.force), atol=1e-6 * self.weight)
            np.testing.assert_allclose(torque, vector(reaction.torque), atol=1e-7 * self.weight)
            for patch in patches:
                self.assertAlmostEqual(np.linalg.norm(vector(patch.normal)), 1.0, places=6)
                self.assertLess(vector(patch.force) @ vector(patch.normal), 0.0)
                self.assertTrue((vector(patch.place) > vertices.min(axis=0) - 1e-3).all(), patch)
                self.assertTrue((vector(patch.place) < vertices.max(axis=0) + 1e-3).all(), patch)

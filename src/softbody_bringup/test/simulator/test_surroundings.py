"""The simulator among a ground, a finger and a gripper that move with tf, with no camera."""
import time
import unittest

import numpy as np
import rospy
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Point, Point32, Pose, Quaternion, TransformStamped, Vector3, WrenchStamped
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState, PinRegion, Target, TetTopology
from softbody_msgs.srv import Pin, Release, SetMaterial, SetObstacle

from force_cases import ForceCases
from gripper_cases import GripperCases
from hand_made_frames import PERIOD, Frames
from poses import array, vector
from recorder import PATIENCE_S, Recorder

FRAME = "world"
DENSITY_KG_M3, GRAVITY_M_S2 = 30.0, 9.81
FAR = [0.0, 0.0, 5.0]
PINS = ("hold", "claw", "arm")


class Surroundings(ForceCases, GripperCases, unittest.TestCase):
    stamp = None  # of the last frame; steps are faster than time, and the next test goes on from there

    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState,
                                softbody__reaction__ground=WrenchStamped, softbody__reaction__finger=WrenchStamped,
                                # Each pinned in one test only: rospy may not come back to a topic that ended
                                # while it connected.
                                softbody__reaction__claw=WrenchStamped, softbody__reaction__arm=WrenchStamped,
                                rosout=Log, diagnostics=DiagnosticArray)
        cls.broadcaster = tf2_ros.TransformBroadcaster()
        cls.pins = rospy.Publisher("/softbody/pin", PinRegion, queue_size=10)
        topology = cls.recorder.wait_for("softbody/volume/topology")[-1]
        cls.rest = array(topology.rest_vertices)
        cls.tets = np.array([tet.vertex_indices for tet in topology.tets])
        edges = cls.rest[cls.tets[:, 1:]] - cls.rest[cls.tets[:, :1]]
        cls.weight = DENSITY_KG_M3 * GRAVITY_M_S2 * np.linalg.det(edges).sum() / 6.0
        cls.pin, cls.release, cls.set_obstacle = (
            rospy.ServiceProxy(f"/softbody/simulator/{name}", kind)
            for name, kind in (("pin", Pin), ("release", Release), ("set_obstacle", SetObstacle)))
        cls.frames = Frames(cls.recorder)
        cls.recorder.wait(lambda _: cls.pins.get_num_connections() > 0, "a simulator that listens")

    def setUp(self):
        self.places = {"finger": FAR, "gripper": FAR, "hand": FAR, "camera": [0.0, 0.0, 0.0]}
        self.camera_yaw = 0.0
        self.step(reset=True)

    def tearDown(self):
        for name in PINS:
            self.pins.publish(PinRegion(name=name, release=True))

    def broadcast(self, stamp):
        transforms = []
        for frame, place in self.places.items():
            transform = TransformStamped()
            transform.header.stamp, transform.header.frame_id, transform.child_frame_id = stamp, FRAME, frame
            yaw = self.camera_yaw if frame == "camera" else 0.0
            transform.transform.rotation.z, transform.transform.rotation.w = np.sin(0.5 * yaw), np.cos(0.5 * yaw)
            translation = transform.transform.translation
            translation.x, translation.y, translation.z = place
            transforms.append(transform)
        self.broadcaster.sendTransform(transforms)

    def step(self, reset=False, frame=FRAME, targets=()):
        """One frame of 1/30 s. @return its state, and the messages of reactions."""
        now = rospy.Time.now()
        self.stamp = now if self.stamp is None else max(now, self.stamp + PERIOD)
        Surroundings.stamp = self.stamp
        self.broadcast(self.stamp)
        rospy.sleep(0.02)  # tf arrives on a way of its own
        self.frames.frame = frame
        return self.frames.step(self.stamp, reset=reset, targets=targets)

    def reaction(self, name):
        """Of the last step."""
        return self.recorder.wait(
            lambda seen: next((w for w in reversed(seen[f"softbody/reaction/{name}"])
                               if w.header.stamp == self.stamp), None), f"the reaction on {name}")

    def at_rest(self):
        """Targets of a camera that sees the body at rest: every tet's centre."""
        return [Target(kind=Target.MANUAL, tet=i, barycentric=[0.25] * 4, weight=1.0, position=Point32(*center))
                for i, center in enumerate(self.rest[self.tets].mean(axis=1))]

    def step_until(self, condition, what, **step):
        """Frames until a condition on what was recorded is met. @return the last state."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            state = self.step(**step)
            with self.recorder.changed:
                if condition(self.recorder.messages):
                    return state
            self.assertLess(time.monotonic(), deadline, what)

    def said(self, words, since=0):
        """How often the simulator said something."""
        with self.recorder.changed:
            return sum(words in log.msg for log in self.recorder.messages["rosout"][since:]
                       if log.name == "/softbody/simulator")

    def reactions(self):
        return {name for name, _ in rospy.get_published_topics("/softbody/reaction")}

    def wait_until(self, condition, what):
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            rospy.sleep(0.05)

    def grip(self, frame, name="hold"):
        region = PinRegion(name=name)
        region.header.frame_id = frame
        region.min, region.max = Point32(-1.0, -1.0, -1.0), Point32(self.rest[:, 0].min() + 0.03, 1.0, 1.0)
        self.pins.publish(region)
        rospy.sleep(0.2)
        return self.rest[:, 0] < self.rest[:, 0].min() + 0.03

    def test_ground_carries_the_weight(self):
        for _ in range(120):
            self.step()
        wrench = self.reaction("ground")
        self.assertEqual(wrench.header.frame_id, FRAME)
        np.testing.assert_allclose(vector(wrench.wrench.force), [0.0, 0.0, -self.weight], atol=0.02 * self.weight)

    def test_gripper_takes_the_body_along_and_carries_it(self):
        held = self.grip("gripper", "claw")
        before = array(self.step().vertices)
        for height in np.linspace(0.0, 0.5, 21)[1:]:
            self.places["gripper"] = np.add(FAR, [0.0, 0.0, height])
            state = self.step()
        for _ in range(100):
            state = self.step()
        vertices = array(state.vertices)
        np.testing.assert_allclose(vertices[held], before[held] + [0.0, 0.0, 0.5], atol=1e-4)
        wrench = self.reaction("claw")
        self.assertEqual(wrench.header.frame_id, "gripper")
        np.testing.assert_allclose(vector(wrench.wrench.force), [0.0, 0.0, -self.weight], atol=0.02 * self.weight)
        # About the gripper's origin: the moment of the weight at the centre of mass, near enough the mean.
        arm = vertices.mean(axis=0) - self.places["gripper"]
        np.testing.assert_allclose(vector(wrench.wrench.torque), np.cross(arm, [0.0, 0.0, -self.weight]),
                                   atol=0.1 * self.weight * np.linalg.norm(arm[:2]) + 1e-3)

    def test_what_stands_in_the_world_stands_still_for_a_moving_camera(self):
        self.step(reset=True, frame="camera")
        held = self.grip(FRAME)
        self.places["finger"] = [0.0, 0.0, self.rest[:, 2].max() + 0.003]  # over the ground, in the body by 12 mm
        for k in range(1, 31):
            self.camera_yaw, self.places["camera"] = 0.02 * k, [0.01 * k, -0.005 * k, 0.0]
            state = self.step(frame="camera")
        self.assertEqual(state.header.frame_id, "camera")
        c, s = np.cos(self.camera_yaw), np.sin(self.camera_yaw)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        vertices = array(state.vertices) @ turn.T + self.places["camera"]
        np.testing.assert_allclose(vertices[held], self.rest[held], atol=1e-4)
        self.assertGreater(np.linalg.norm(vertices - self.places["finger"], axis=1).min(), 0.013)
        wrench = self.reaction("finger")
        self.assertEqual(wrench.header.frame_id, "finger")
        self.assertGreater(wrench.wrench.force.z, 0.0)

    def test_a_pin_that_is_not_there_is_told(self):
        self.pins.publish(PinRegion(name="griper", release=True))
        self.recorder.wait_for_log("/softbody/simulator", "'griper'")

    def test_a_pin_takes_its_topic_with_it(self):
        before = self.reactions() - {f"/softbody/reaction/{name}" for name in PINS}
        names = [f"hold_{k}" for k in range(5)]
        for name in names:
            self.grip("", name)
        self.step()
        held = before | {f"/softbody/reaction/{name}" for name in names}
        self.wait_until(lambda: held <= self.reactions(), "the topics of five pins")
        for name in names:
            self.pins.publish(PinRegion(name=name, release=True))
            rospy.sleep(0.2)
        self.wait_until(lambda: self.reactions() - {f"/softbody/reaction/{name}" for name in PINS} == before,
                        "the topics of five pins to end")

    def obstacle(self, place, **fields):
        """Sets the obstacle `ball`. @return the answer."""
        request = SetObstacle._request_class(name="ball", pose=Pose(Point(*place), Quaternion(w=1.0)), **fields)
        request.header.frame_id = FRAME
        return self.set_obstacle(request)

    def refused(self, answer, *words):
        self.assertFalse(answer.success)
        for word in words:
            self.assertIn(word, answer.message)

    def test_a_pin_by_service_holds_until_it_is_released(self):
        end = self.rest[:, 0].min() + 0.03
        request = Pin._request_class(name="hold", min=Point32(-1.0, -1.0, -1.0), max=Point32(end, 1.0, 1.0))
        request.header.frame_id = "gripper"
        answer = self.pin(request)
        held = self.rest[:, 0] < end
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.vertices, held.sum())
        before = array(self.step().vertices)
        self.places["gripper"] = np.add(FAR, [0.0, 0.0, 0.05])
        np.testing.assert_allclose(array(self.step().vertices)[held], before[held] + [0.0, 0.0, 0.05], atol=1e-4)
        self.assertTrue(self.release(name="hold").success)
        for _ in range(60):
            state = self.step()
        self.assertLess(array(state.vertices)[held][:, 2].max(), before[held][:, 2].max() + 0.03)  # it fell
        self.refused(self.release(name="hold"), "'hold'", "ground, finger")

    def test_pins_that_cannot_be_held_are_refused(self):
        box = {"min": Point32(1.0, 1.0, 1.0), "max": Point32(2.0, 2.0, 2.0)}
        self.refused(self.pin(name="hold", **box), "'hold'", "contains nothing of the body", "mm outside at [", "of the visual mesh")
        self.refused(self.pin(name="finger", **box), "'finger'", "name of an obstacle")
        self.refused(self.pin(name="hold", min=box["max"], max=box["min"]), "is empty")
        self.refused(self.pin(name="no/name", **box), "no/name")

    def test_an_obstacle_comes_moves_and_goes(self):
        top = self.rest[:, 2].max()
        self.grip("")
        self.assertTrue(self.obstacle([0.0, 0.0, top + 0.1], shape="sphere", radius=0.02).success)
        self.step()
        for height in np.linspace(0.1, 0.01, 10):
            answer = self.obstacle([0.0, 0.0, top + height])
            self.assertTrue(answer.success, answer.message)
            state = self.step()
        away = np.linalg.norm(array(state.vertices) - [0.0, 0.0, top + 0.01], axis=1)
        self.assertGreater(away.min(), 0.018)
        self.assertIn("/softbody/reaction/ball", self.reactions())
        self.assertTrue(self.release(name="ball").success)
        self.wait_until(lambda: "/softbody/reaction/ball" not in self.reactions(), "the topic of an obstacle to end")
        self.refused(self.obstacle(FAR), "'ball'", "needs a shape")

    def test_with_a_denser_material_the_ground_carries_more(self):
        set_material = rospy.ServiceProxy("/softbody/simulator/set_material", SetMaterial)
        material = {"youngs_modulus_pa": 2.0e4, "poisson_ratio": 0.2, "damping": 0.1}
        answer = set_material(density_kg_m3=2.0 * DENSITY_KG_M3, **material)
        self.addCleanup(set_material, density_kg_m3=DENSITY_KG_M3, **material)
        self.assertTrue(answer.success, answer.message)
        for _ in range(120):
            self.step()
        force = vector(self.reaction("ground").wrench.force)
        np.testing.assert_allclose(force, [0.0, 0.0, -2.0 * self.weight], atol=0.04 * self.weight)
        self.refused(set_material(density_kg_m3=-1.0, **material), "density_kg_m3", "-1", "0.1 to 30000")

    def test_obstacles_that_cannot_be_are_refused(self):
        self.refused(self.obstacle(FAR, shape="cone"), "'ball'", "shape", "capsule")
        self.refused(self.obstacle(FAR, shape="sphere"), "obstacle 'ball': radius is 0;")
        self.refused(self.obstacle(FAR, shape="box", size=Vector3(0.1, 0.1, -0.1)), "obstacle 'ball': size is [", "-0.1")
        self.refused(self.obstacle([0.0, 0.0, float("nan")], shape="plane"), "pose")
        self.refused(self.set_obstacle(name="ball", shape="plane"), "quaternion")
        self.assertNotIn("/softbody/reaction/ball", self.reactions())

    def test_a_pin_waits_for_a_frame_that_tf_does_not_know(self):
        unknown, known = "waiting for frame 'arm'", "the pose of frame 'arm' again"
        self.grip("arm", "arm")
        self.step_until(lambda _: self.said(unknown), "a warning of a frame that tf does not know")
        self.recorder.wait_for_status("simulation", DiagnosticStatus.WARN, unknown)
        with self.recorder.changed:
            self.assertNotIn(self.stamp, {w.header.stamp for w in self.recorder.messages["softbody/reaction/arm"]})
        self.places["arm"] = [0.0, 0.0, 0.0]
        self.step_until(lambda _: self.said(known), "a line about the frame that came")
        self.reaction("arm")
        self.assertEqual(self.said(unknown), 1)

    def test_a_pin_stays_where_its_silent_frame_was(self):
        silent, back = "tf has no new pose of frame 'gripper'", "the pose of frame 'gripper' again"
        held = self.grip("gripper")
        before = array(self.step().vertices)
        place = self.places.pop("gripper")
        with self.recorder.changed:
            start = len(self.recorder.messages["rosout"])
        state = self.step_until(lambda _: self.said(silent, start), "a warning of a silent frame")
        np.testing.assert_allclose(array(state.vertices)[held], before[held], atol=1e-4)
        self.recorder.wait_for_status("simulation", DiagnosticStatus.WARN, silent)
        self.places["gripper"] = np.add(place, [0.0, 0.0, 0.01])
        state = self.step_until(lambda _: self.said(back, start), "a line about the frame that is back")
        np.testing.assert_allclose(array(state.vertices)[held], before[held] + [0.0, 0.0, 0.01], atol=1e-4)
        self.assertEqual(self.said(silent, start), 1)

    def test_a_pin_that_contradicts_the_camera_is_named_and_bounded(self):
        held = self.grip("gripper")
        seen = self.at_rest()
        self.step(targets=seen)
        self.places["gripper"] = np.add(FAR, [0.005, 0.0, 0.0])
        for _ in range(60):
            state = self.step(targets=seen)
            away = np.linalg.norm(array(state.vertices) - self.rest, axis=1)
            self.assertLess(away.max(), 0.006)
        self.assertGreater(away[held].min(), 0.0002)  # between the camera and the pin
        self.assertLess(away[held].max(), 0.0048)
        self.recorder.wait_for_status("simulation", DiagnosticStatus.WARN, "pin 'hold' and the camera disagree by 4")
        self.assertEqual(self.said("and the camera disagree by"), 1)

    def test_finger_dents_the_body_and_feels_it(self):
        self.grip("")  # held where it is
        top = self.rest[:, 2].max()
        for depth in np.linspace(-0.02, 0.012, 17):
            self.places["finger"] = [0.0, 0.0, top + 0.015 - depth]
            state = self.step()
        wrench = self.reaction("finger")
        self.assertEqual(wrench.header.frame_id, "finger")
        self.assertGreater(wrench.wrench.force.z, 0.0)
        near = np.linalg.norm(array(state.vertices) - self.places["finger"], axis=1)
        self.assertGreater(near.min(), 0.013)

    def test_goes_on_without_images_and_says_so(self):
        self.step()
        last = self.stamp
        later = self.recorder.wait(
            lambda seen: [s for s in seen["softbody/volume/state"] if s.header.stamp > last + rospy.Duration(0.5)],
            "states without targets")[0]
        self.assertLess(later.observed, later.header.stamp)
        self.assertEqual(later.header.frame_id, FRAME)

"""The live body in Python: whole states during cuts, services as functions, pins, and the examples."""
import collections
import os
import subprocess
import time
import unittest
from unittest import mock

import numpy as np
import rospkg
import rospy
from sensor_msgs.msg import PointCloud2
from softbody_msgs.msg import MeshState
from softbody_msgs.srv import Release, SetPose, SetPoseResponse
from std_srvs.srv import Trigger, TriggerResponse

import softbody

from hand_made_frames import PERIOD, EndlessFrames
from recorder import Recorder

EXAMPLES = rospkg.RosPack().get_path("softbody_python") + "/examples"


def volume_of(state):
    """Of the visual mesh, by the divergence theorem."""
    a, b, c = (state.rest_vertices[state.triangles[:, k]].astype(float) for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


class PythonLive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # Own subscriptions of a program work beside those of Body, before it and after it.
        cls.recorder = Recorder(softbody__surface__state=MeshState)
        cls.body = softbody.Body(service_timeout_s=60)
        cls.frames = EndlessFrames()
        cls.frames.start()
        cls.addClassCleanup(cls.frames.stopped.set)
        cls.first = cls.body.wait(timeout_s=60)
        cls.middle = cls.first.rest_vertices.mean(axis=0)

    def test_states_are_the_messages(self):
        state = self.body.wait(timeout_s=60, after=self.first)
        message = self.recorder.first("softbody/surface/state", lambda m: m.header.stamp == state.stamp,
                                      "the same state")
        np.testing.assert_array_equal(state.vertices, np.float32([[p.x, p.y, p.z] for p in message.vertices]))
        self.assertEqual((state.frame, state.revision), ("made_by_hand", message.revision))
        self.assertIsNotNone(state.volume)

    def test_cuts_during_the_subscription(self):
        """Every state is whole: topologies, volume and positions of one revision, in order."""
        states = collections.deque()
        self.body.on_state(states.append)
        plane = {"point": self.middle, "normal": [1, 0.1, 0]}
        first = self.body.wait(timeout_s=60, after=self.body.latest())
        volumes = self.body.preview_cut(**plane)
        self.assertEqual(len(volumes), 2)
        self.assertAlmostEqual(sum(volumes) / volume_of(first), 1, delta=1e-4)
        revision = self.body.cut(**plane)
        self.assertEqual(revision, first.revision + 1)
        self.assertEqual(self.body.wait(timeout_s=60, revision=revision).triangle_pieces.max(), 1)
        for edit, pieces in ((self.body.undo, 1), (self.body.redo, 2), (self.body.reset_cuts, 1)):
            revision += 1
            self.assertEqual(edit(), revision)
            state = self.body.wait(timeout_s=60, revision=revision)
            self.assertEqual((state.revision, 1 + state.triangle_pieces.max()), (revision, pieces))
        with self.assertRaisesRegex(softbody.Refused, "/softbody/surface/undo: there is no cut to undo"):
            self.body.undo()
        self.expect_whole(list(states), first.revision, revision)

    def expect_whole(self, states, first, last):
        self.assertEqual({state.revision for state in states}, set(range(first, last + 1)))
        self.assertEqual(states, sorted(states, key=lambda state: state.stamp))
        self.assertEqual(len({state.stamp for state in states}), len(states))
        for state in states:
            self.assertEqual({state.topology.revision, state.volume.topology.revision}, {state.revision})
            self.assertEqual(state.vertices.shape, state.rest_vertices.shape)
            self.assertEqual(state.volume.vertices.shape, state.volume.topology.rest_vertices.shape)
            self.assertEqual(state.triangle_pieces.max(), state.volume.tet_pieces.max())

    def test_a_polygon_that_is_refused(self):
        bent = [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0.9, 0.1]]
        with self.assertRaisesRegex(softbody.Refused, "convex"):
            self.body.preview_cut(polygon=bent)
        for arguments in ({}, {"point": [0, 0, 0]}, {"point": [0] * 3, "normal": [1, 0, 0], "polygon": bent}):
            with self.assertRaisesRegex(ValueError, "a point and a normal, or a polygon"):
                self.body.cut(**arguments)

    def test_pin(self):
        def reacts():
            return "/softbody/reaction/grip" in [name for name, _ in rospy.get_published_topics()]

        rest = self.first.volume.topology.rest_vertices
        self.assertEqual(self.body.pin("grip", [-1, -1, -1], self.middle), np.all(rest <= self.middle, axis=1).sum())
        self.wait(reacts)
        self.body.release("grip")
        self.wait(lambda: not reacts())
        with self.assertRaisesRegex(softbody.Refused, "/softbody/simulator/release: .*'grip'"):
            self.body.release("grip")
        with self.assertRaisesRegex(softbody.Refused, "/softbody/simulator/pin: "):
            self.body.pin("grip", [5, 5, 5], [6, 6, 6])

    def test_grip(self):
        state = self.body.wait(timeout_s=60)
        self.assertEqual(self.body.grip(), len(state.volume.vertices))
        self.wait(lambda: "/softbody/reaction/gripper" in [name for name, _ in rospy.get_published_topics()])
        self.assertEqual(self.body.grip(False), 0)
        with self.assertRaisesRegex(softbody.Refused, "'gripper'"):
            self.body.release("gripper")

    def test_closest_point(self):
        state = self.body.wait(timeout_s=60)
        top = state.vertices[state.vertices[:, 2].argmax()].astype(float)
        answer = self.body.closest_point(top + [0, 0, 0.1])
        place = answer.surface_point.point
        self.assertAlmostEqual(answer.distance, 0.1, delta=0.002)
        np.testing.assert_allclose([place.x, place.y, place.z], top, atol=0.02)
        with self.assertRaisesRegex(softbody.Refused, "/softbody/surface/closest_point: .*nowhere"):
            self.body.closest_point(top, frame="nowhere")

    def test_save_mesh(self):
        name = f"python_live_{os.getpid()}.obj"
        path = self.body.save_mesh(name)
        self.addCleanup(os.remove, path)
        with open(path, encoding="ascii") as file:
            lines = file.read().splitlines()
        state = self.body.latest()
        self.assertEqual([sum(line.startswith(key) for line in lines) for key in ("v ", "f ")],
                         [len(state.vertices), len(state.triangles)])
        with self.assertRaisesRegex(softbody.Refused, "/softbody/surface/save_mesh: "):
            self.body.save_mesh(name)

    def test_set_material(self):
        """Each number reaches its own field: the reason names the one that is wrong."""
        right = {"youngs_modulus_pa": 8000.0, "poisson_ratio": 0.3, "density_kg_m3": 30.0, "damping": 0.1}
        self.body.set_material(**right)
        for name, wrong in (("youngs_modulus_pa", -1), ("poisson_ratio", 0.6), ("density_kg_m3", -1), ("damping", 2)):
            with self.assertRaisesRegex(softbody.Refused, name):
                self.body.set_material(**{**right, name: wrong})

    def test_set_obstacle(self):
        """The example presses a ball into the body: it never is inside the ball by more than 2 mm."""
        lines = self.example("press_with_ball.py", 0.03, 0.02, 1).splitlines()
        self.assertEqual(len(lines), 30)
        self.assertTrue(lines[-1].startswith("20.0 mm deep"), lines[-1])
        for line in lines:
            self.assertGreater(float(line.split(", ")[1].split(" ")[0]), 28, line)
        with self.assertRaisesRegex(softbody.Refused, "'ball'"):
            self.body.release("ball")
        with self.assertRaisesRegex(softbody.Refused, "cone"):
            self.body.set_obstacle("ball", "cone", radius=0.1)

    def wait(self, condition):
        end = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)

    def test_find_again(self):
        """A stand-in for the tracker gets the pose; its reason is that of the exception."""
        requests = []

        def answer(request):
            requests.append(request.pose)
            return SetPoseResponse(success=len(requests) == 1, message="no such frame")

        rospy.Service("/softbody/feature_tracker/set_pose", SetPose, answer)
        self.body.find_again([1, 2, 3], [0, 0, 0.6, 0.8], frame="world")
        pose = requests[0].pose
        self.assertEqual((requests[0].header.frame_id, pose.position.y, pose.orientation.w), ("world", 2, 0.8))
        with self.assertRaisesRegex(softbody.Refused, "no such frame"):
            self.body.find_again([1, 2, 3], [0, 0, 0.6, 0.8])
        rospy.Service("/softbody/feature_tracker/find_again", Trigger,
                      lambda _: TriggerResponse(message="no image yet"))
        with self.assertRaisesRegex(softbody.Refused, "no image yet"):
            self.body.find_again()

    def test_what_does_not_come(self):
        nobody = softbody.Body("/nobody", service_timeout_s=0.3)
        with self.assertRaisesRegex(TimeoutError, "no state on /nobody/surface/state within 0.2 s"):
            nobody.wait(timeout_s=0.2)
        with self.assertRaisesRegex(rospy.ROSException, "/nobody/surface/undo"):
            nobody.undo()
        with self.assertRaisesRegex(rospy.ROSException, "/nobody/simulator/release"):
            nobody.release("grip")
        rospy.Service("/nobody/simulator/release", Release, lambda _: None)  # rospy answers that it fails
        with self.assertRaisesRegex(rospy.ROSException, "/nobody/simulator/release: no answer: "):
            nobody.release("grip")
        with self.assertRaisesRegex(TimeoutError, "no state of revision 99"):
            self.body.wait(timeout_s=0.2, revision=99)
        nobody.close()

    def test_the_first_state_has_its_volume(self):
        """The volume's topics are connected half a second after those of the surface."""
        subscribe = rospy.Subscriber

        def late(name, *arguments, **options):
            rospy.sleep(0.5 if name.endswith("volume/state") else 0.0)
            return subscribe(name, *arguments, **options)

        with mock.patch("rospy.Subscriber", side_effect=late):
            body = softbody.Body()
        self.addCleanup(body.close)
        self.assertIsNotNone(body.wait(timeout_s=60).volume)

    def example(self, name, *arguments):
        run = subprocess.run(["python3", f"{EXAMPLES}/{name}", *map(str, arguments)], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stdout)
        return run.stdout

    def test_example_distance(self):
        """100 mm above the top of the body, in the direction in which its vertices lie on a plane."""
        vertices = self.body.wait(timeout_s=60).vertices
        top = vertices[vertices[:, 2].argmax()]
        output = self.example("distance_to_body.py", *(top + [0, 0, 0.1]), 3).splitlines()
        self.assertEqual(len(output), 3)
        self.assertIn(": 100.0 mm to vertex", output[-1])

    def test_example_measured_distance(self):
        """Points 3 mm outside of the middle of each triangle of the body, which is at rest."""
        state = self.body.wait(timeout_s=60)
        a, b, c = (state.vertices[state.triangles[:, k]].astype(float) for k in range(3))
        normals = np.cross(b - a, c - a)
        points = (a + b + c) / 3 + 0.003 * normals / np.linalg.norm(normals, axis=1, keepdims=True)
        cloud = PointCloud2(height=1, width=len(points), point_step=16, row_step=16 * len(points), is_dense=True,
                            data=np.float32(np.hstack([points, 0 * points[:, :1]])).tobytes())
        publisher = rospy.Publisher("/softbody/points", PointCloud2, queue_size=10)

        def publish(message):  # before the state of its frame is there
            cloud.header.stamp = message.header.stamp + 3 * PERIOD
            publisher.publish(cloud)

        subscriber = rospy.Subscriber("/softbody/surface/state", MeshState, publish)
        self.addCleanup(subscriber.unregister)
        lines = self.example("measured_distance.py", 60).splitlines()
        self.assertTrue(lines)
        for line in lines:
            self.assertIn(f": {len(points)} points, mean +3.00 mm", line)

    def test_example_pin(self):
        self.assertRegex(self.example("pin_to_gripper.py", "gripper", 0.5), "^[1-9][0-9]* vertices of the volume follow gripper")

    def test_example_grip(self):
        lines = [line for line in self.example("predict_grip.py", 0.05).splitlines() if line.startswith("gripped")]
        self.assertEqual(len(lines), 5)
        self.assertIn("at 0.8 to 1.0 of the length: force", lines[-1])

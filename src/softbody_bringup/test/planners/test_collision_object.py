"""The program collision_object: the newest state as an obstacle of MoveIt, at a bounded rate, with a stand-in for MoveIt."""
import os
import signal
import subprocess
import tempfile
import time
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import Point32
from rosgraph_msgs.msg import Clock
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import MeshState, MeshTopology, Tetrahedron, TetTopology

import moveit_stand_in
from recorder import PATIENCE_S

MESSAGES = tempfile.mkdtemp()
moveit_stand_in.make(MESSAGES)
from moveit_msgs.msg import CollisionObject  # pylint: disable=import-error,wrong-import-position,wrong-import-order

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
PROGRAM = ["rosrun", "softbody_bringup", "collision_object"]
TICK = rospy.Duration(nsecs=20000000)


def points(array):
    return [Point32(*row) for row in array]


class Body:
    """Publishes a tetrahedron: the surface, and tets around it that are larger by a half."""

    def __init__(self, namespace):
        self.revision = 0
        self.publishers = {name: rospy.Publisher(f"{namespace}/{name}", kind, queue_size=100, latch="topology" in name)
                           for name, kind in (("surface/topology", MeshTopology), ("surface/state", MeshState),
                                              ("volume/topology", TetTopology), ("volume/state", MeshState))}
        self.send_topologies()

    def send_topologies(self):
        triangles = [MeshTriangle(face) for face in FACES]
        self.publishers["surface/topology"].publish(MeshTopology(
            revision=self.revision, rest_vertices=points(CORNERS), triangles=triangles, vertex_parents=range(4),
            triangle_bodies=[0] * 4, cut_triangles=[False] * 4))
        self.publishers["volume/topology"].publish(TetTopology(
            revision=self.revision, rest_vertices=points(1.5 * CORNERS), tets=[Tetrahedron([0, 1, 2, 3])],
            surface_triangles=triangles, vertex_parents=range(4), tet_bodies=[0]))

    def send_state(self, stamp, shift):
        for name, scale in (("volume/state", 1.5), ("surface/state", 1.0)):
            state = MeshState(observed=stamp, revision=self.revision, vertices=points(scale * CORNERS + [shift, 0, 0]))
            state.header.stamp, state.header.frame_id = stamp, "camera"
            self.publishers[name].publish(state)


class Collision(unittest.TestCase):
    clock = rospy.Time(100)

    @classmethod
    def setUpClass(cls):
        cls.clock_publisher = rospy.Publisher("/clock", Clock, queue_size=1)
        cls.received = []
        cls.subscribe()
        cls.body = Body("/left/softbody")

    @classmethod
    def subscribe(cls):
        cls.subscriber = rospy.Subscriber("/collision_object", CollisionObject, cls.received.append, queue_size=1000)

    def setUp(self):
        self.received.clear()

    def start(self, *arguments, with_moveit=True):
        environment = dict(os.environ)
        if with_moveit:
            environment["PYTHONPATH"] = f"{MESSAGES}:{environment['PYTHONPATH']}"
        program = subprocess.Popen(PROGRAM + ["_namespace:=/left/softbody", *arguments], env=environment,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(program.stderr.close)
        self.addCleanup(program.wait)
        self.addCleanup(program.send_signal, signal.SIGINT)
        return program

    def tick(self):
        """Lets a state come, and time pass."""
        Collision.clock += TICK
        self.clock_publisher.publish(Clock(self.clock))
        self.body.send_state(self.clock, 0.001 * self.clock.to_sec())
        time.sleep(0.002)

    def tick_until(self, condition, what):
        end = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            self.tick()

    def expect_mesh(self, message, scale):
        shift = 0.001 * message.header.stamp.to_sec()
        self.assertEqual((message.operation, message.header.frame_id), (CollisionObject.ADD, "camera"))
        [mesh] = message.meshes
        np.testing.assert_allclose([[p.x, p.y, p.z] for p in mesh.vertices], scale * CORNERS + [shift, 0, 0], atol=1e-6)
        self.assertEqual([list(triangle.vertex_indices) for triangle in mesh.triangles], FACES)
        self.assertEqual([message.pose.orientation.w] + [pose.orientation.w for pose in message.mesh_poses], [1.0, 1.0])

    def test_the_stand_in_is_moveits_message(self):
        self.assertEqual(CollisionObject._md5sum, "dbba710596087da521c07564160dfccb")  # of MoveIt for ROS Noetic

    def test_newest_state_at_a_bounded_rate(self):
        program = self.start("_rate:=5")
        self.tick_until(lambda: self.received, "an object")
        before, begin = len(self.received), self.clock
        self.tick_until(lambda: self.clock > begin + rospy.Duration(10), "ten seconds")
        messages = list(self.received)
        self.assertLessEqual(len(messages) - before, 5 * 10 + 1)
        self.assertGreater(len(messages), before)
        for message in messages:
            self.assertEqual(message.id, "left_softbody")
            self.expect_mesh(message, 1.0)
        stamps = [message.header.stamp for message in messages]
        self.assertEqual(stamps, sorted(set(stamps)))
        program.send_signal(signal.SIGINT)
        self.tick_until(lambda: self.received[-1].operation == CollisionObject.REMOVE, "that the object is removed")
        self.assertEqual((self.received[-1].id, self.received[-1].meshes), ("left_softbody", []))

    def test_a_new_subscriber_gets_the_object_of_a_body_that_stands_still(self):
        self.start()
        self.tick_until(lambda: self.received, "an object")
        self.subscriber.unregister()
        self.received.clear()
        self.subscribe()
        end = time.monotonic() + PATIENCE_S
        while not self.received:  # no state comes, and no time passes
            self.assertLess(time.monotonic(), end, "the object again")
            time.sleep(0.01)
        self.expect_mesh(self.received[0], 1.0)

    def test_the_coarse_mesh_is_that_of_the_tets(self):
        self.start("_coarse:=true", "_id:=sponge")
        self.tick_until(lambda: self.received, "an object")
        self.assertEqual(self.received[0].id, "sponge")
        self.expect_mesh(self.received[0], 1.5)

    def test_without_moveit(self):
        program = self.start(with_moveit=False)
        self.tick_until(lambda: program.poll() is not None, "its end")
        self.assertEqual(program.returncode, 1)
        self.assertIn("collision_object: MoveIt's messages are not installed (No module named 'moveit_msgs')",
                      program.stderr.read())

    def test_a_wrong_rate(self):
        program = self.start("_rate:=0")
        self.tick_until(lambda: program.poll() is not None, "its end")
        self.assertEqual(program.returncode, 1)
        self.assertIn("rate is 0; allowed: above 0 to 30 Hz", program.stderr.read())

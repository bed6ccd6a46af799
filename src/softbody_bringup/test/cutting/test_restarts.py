"""Simulator and surface have the same cuts: after cuts that one of them cannot make, and after either was killed."""
import copy
import os
import signal
import time
import unittest
from xmlrpc.client import ServerProxy

import numpy as np
import rosgraph
import rospy
from geometry_msgs.msg import Point, Point32, Pose, Quaternion, Vector3
from rosgraph_msgs.msg import Log
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import Cut, CutHistory, MeshState, MeshTopology, Targets, TetTopology
from softbody_msgs.srv import CutBody
from std_srvs.srv import Trigger

from recorder import Recorder

VOLUME, SURFACE = "softbody/volume/topology", "softbody/surface/topology"
SIMULATOR_NODE, SURFACE_NODE = "/softbody/simulator", "/softbody/surface"


def kill(node):
    """Ends a process as a crash does. @return its process id."""
    pid = ServerProxy(rosgraph.Master("/test_restarts").lookupNode(node)).getPid("/test_restarts")[2]
    os.kill(pid, signal.SIGKILL)
    return pid


class Restarts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__surface__topology=MeshTopology,
                                softbody__volume__cuts=CutHistory, softbody__surface__cuts=CutHistory,
                                softbody__surface__state=MeshState, rosout=Log)
        cls.targets = rospy.Publisher("/softbody/targets", Targets, queue_size=1)
        cls.cuts = rospy.Publisher("/softbody/cut", Cut, queue_size=1)
        cls.topologies = rospy.Publisher("/" + VOLUME, TetTopology, queue_size=1)
        cls.edits = rospy.Publisher("/softbody/volume/cuts", CutHistory, queue_size=1)
        cls.rest = np.array([[p.x, p.y, p.z] for p in cls.recorder.wait_for(SURFACE)[-1].rest_vertices])
        cls.listen()
        cls.stamp = rospy.Time(1000)

    @classmethod
    def listen(cls):
        cls.recorder.wait(lambda _: cls.targets.get_num_connections() > 0 and cls.cuts.get_num_connections() > 1
                          and cls.topologies.get_num_connections() > 1 and cls.edits.get_num_connections() > 1, "nodes that listen")

    @staticmethod
    def service(name, kind=Trigger):
        rospy.wait_for_service("/softbody/surface/" + name, 30)
        return rospy.ServiceProxy("/softbody/surface/" + name, kind)

    def pieces(self, name):
        last = self.recorder.messages[name][-1]
        return 1 + max(last.tet_bodies if name == VOLUME else last.triangle_bodies)

    def revision(self):
        return self.recorder.messages[VOLUME][-1].revision

    def step(self, reset=False):
        """A frame without targets. Sent again until it is answered: nodes that come up miss some."""
        for _ in range(60):
            type(self).stamp = self.stamp + rospy.Duration(nsecs=33333333)
            message = Targets(revision=self.revision(), reset=reset,
                              body_pose=Pose(orientation=Quaternion(w=1.0)))
            message.header.stamp, message.header.frame_id = self.stamp, "made_by_hand"
            self.targets.publish(message)
            for _ in range(40):
                states = self.recorder.messages["softbody/surface/state"]
                if states and states[-1].header.stamp == self.stamp:
                    return states[-1]
                rospy.sleep(0.05)
        return self.fail("no frame is answered")

    def expect_agreement(self, revision, pieces, reset=False):
        """Both nodes, and the states that they send from now on."""
        for name in (VOLUME, "softbody/volume/cuts"):
            self.recorder.wait(lambda seen, name=name: seen[name] and seen[name][-1].revision == revision,
                               f"revision {revision} on {name}")
        self.assertEqual(self.step(reset).revision, revision)
        self.recorder.wait(lambda seen: seen[SURFACE][-1].revision == revision, f"revision {revision} of the surface")
        self.assertEqual((self.pieces(VOLUME), self.pieces(SURFACE)), (pieces, pieces))

    def cut(self, x=0.0):
        answer = self.service("cut", CutBody)(point=Point(*(self.rest.mean(axis=0) + [x, 0, 0])),
                                              normal=Vector3(1.0, 0.1, 0.0))
        self.assertTrue(answer.success, answer.message)

    def start_with_two_pieces(self):
        self.step(reset=True)
        if self.pieces(VOLUME) > 1:
            whole = self.revision() + 1
            self.assertTrue(self.service("reset")().success)
            self.expect_agreement(whole, 1)
        revision = self.revision() + 1
        self.cut()
        self.expect_agreement(revision, 2)
        return revision

    def restart(self, *nodes):
        """Kills nodes, and forgets what they said."""
        for name in (VOLUME, SURFACE, "softbody/volume/cuts", "softbody/surface/cuts", "softbody/surface/state"):
            self.recorder.messages[name].clear()
        for node in nodes:
            kill(node)
        for name in (VOLUME, SURFACE):
            self.recorder.wait_for(name)
        self.listen()

    def test_1_cuts_that_only_one_of_them_could_make(self):
        """A patch beside the body, and none."""
        revision = self.start_with_two_pieces()
        beside = [Point32(5, 5, 5), Point32(6, 5, 5), Point32(5, 6, 5)]
        for vertices in (beside, []):
            self.recorder.messages["rosout"].clear()
            self.cuts.publish(Cut(revision=revision + 1, stroke=90, patch_vertices=vertices,
                                  patch_triangles=[MeshTriangle([0, 1, 2])] if vertices else []))
            self.recorder.wait_for_log(SURFACE_NODE, "is not made")
            self.expect_agreement(revision, 2)
        self.assertTrue(self.service("undo")().success)
        self.expect_agreement(revision + 1, 1)

    def test_2_a_cut_by_another_program(self):
        revision = self.start_with_two_pieces()
        middle = self.rest.mean(axis=0)
        corners = [middle + [0.02, y, z] for y, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        self.cuts.publish(Cut(revision=revision + 1, stroke=91, patch_vertices=[Point32(*c) for c in corners],
                              patch_triangles=[MeshTriangle([0, 1, 2]), MeshTriangle([0, 2, 3])]))
        self.expect_agreement(revision + 1, 3)
        self.assertTrue(self.service("undo")().success)
        self.expect_agreement(revision + 2, 2)

    def test_3_a_topology_that_no_cut_explains(self):
        revision = self.start_with_two_pieces()
        forged = copy.deepcopy(self.recorder.messages[VOLUME][-1])
        forged.revision += 1
        self.topologies.publish(forged)
        self.recorder.wait_for_log(SURFACE_NODE, "waiting for the cuts that explain")
        self.recorder.wait(lambda seen: seen[VOLUME][-1].revision == revision, "the simulator's topology")
        self.expect_agreement(revision, 2)
        self.cut(0.03)
        self.expect_agreement(revision + 1, 3)

    def test_3_a_topology_of_another_body(self):
        """The surface waits for cuts that explain it, and stays with the simulator's body."""
        revision = self.start_with_two_pieces()
        forged = copy.deepcopy(self.recorder.messages[VOLUME][-1])
        for vertex in forged.rest_vertices:
            vertex.x *= 1.1
        self.recorder.messages["rosout"].clear()
        for _ in range(3):  # longer than a surface waits that has no simulator
            self.topologies.publish(forged)
            rospy.sleep(0.4)
        self.expect_agreement(revision, 2)
        self.assertEqual([log.msg for log in self.recorder.messages["rosout"] if "starts uncut" in log.msg], [])
        self.assertTrue(self.service("undo")().success)
        self.expect_agreement(revision + 1, 1)

    def test_3_edits_of_another_body(self):
        """As if from the simulator. The surface takes them over, and the simulator refuses them at once."""
        revision = self.start_with_two_pieces()
        forged = copy.deepcopy(self.recorder.messages["softbody/volume/cuts"][-1])
        forged.revision += 1
        for vertex in forged.uncut.rest_vertices:
            vertex.x *= 1.1
        seen_before = len(self.recorder.messages["softbody/surface/cuts"])
        self.edits.publish(forged)
        taken = self.recorder.wait(lambda seen: seen["softbody/surface/cuts"][seen_before:], "the forged edits")
        self.assertEqual(taken[0].revision, revision + 1)
        began = time.monotonic()
        self.recorder.wait(lambda seen: seen["softbody/surface/cuts"][-1].revision == revision, "the simulator's edits")
        self.assertLess(time.monotonic() - began, 2.5)  # a cut that is not made is taken back after 3 s
        self.cut(0.03)
        self.expect_agreement(revision + 1, 3)

    def test_4_the_surface_is_killed(self):
        revision = self.start_with_two_pieces()
        self.restart(SURFACE_NODE)
        self.expect_agreement(revision, 2)
        self.assertTrue(self.service("undo")().success)
        self.expect_agreement(revision + 1, 1)
        self.assertTrue(self.service("redo")().success)
        self.expect_agreement(revision + 2, 2)

    def test_5_the_simulator_is_killed(self):
        revision = self.start_with_two_pieces()
        self.restart(SIMULATOR_NODE)
        self.expect_agreement(revision, 2, reset=True)
        self.cut(0.03)
        self.expect_agreement(revision + 1, 3)
        self.assertTrue(self.service("reset")().success)
        self.expect_agreement(revision + 2, 1)

    def test_6_both_are_killed(self):
        """Then nobody knows the cuts."""
        self.start_with_two_pieces()
        self.restart(SIMULATOR_NODE, SURFACE_NODE)
        self.expect_agreement(0, 1, reset=True)
        self.cut()
        self.expect_agreement(1, 2)

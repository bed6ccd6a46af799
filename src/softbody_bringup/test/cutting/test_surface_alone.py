"""The surface under a volume made by hand, with no simulator: a box of tets around the visual mesh."""
import os
import copy
import itertools
import time
import unittest

import numpy as np
import rospy
import tf2_ros
from geometry_msgs.msg import Point, Point32, TransformStamped, Vector3
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rosgraph_msgs.msg import Log
from shape_msgs.msg import Mesh, MeshTriangle
from softbody_msgs.msg import Cut, MeshState, MeshTopology, TetTopology, Tetrahedron
from sensor_msgs.msg import PointCloud2
from sensor_msgs import point_cloud2
from softbody_msgs.srv import ClosestPoint, CutBody, SaveMesh

from poses import array
from recorder import Recorder

FRAME = "made_by_hand"
HALF_SIZE_M = np.array([0.11, 0.06, 0.03])


def points32(rows):
    return [Point32(*row) for row in rows]


def box_tets():
    """A box as six tets around its diagonal (Kuhn), each with positive volume, and its corners."""
    corners = np.array(list(itertools.product([-1, 1], repeat=3))) * HALF_SIZE_M
    tets = []
    for order in itertools.permutations([4, 2, 1]):
        a, b, c, d = 0, order[0], order[0] + order[1], 7
        volume = np.linalg.det(corners[[b, c, d]] - corners[a])
        tets.append([a, b, c, d] if volume > 0 else [a, c, b, d])
    return corners, tets


def boundary(tets):
    """Triangles of one tet only, outward."""
    faces = [(t[i], t[j], t[k]) for t in tets for i, j, k in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))]
    keys = [tuple(sorted(face)) for face in faces]
    return [face for face, key in zip(faces, keys) if keys.count(key) == 1]


class SurfaceAlone(unittest.TestCase):
    seconds = 0  # of the last state

    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__surface__topology=MeshTopology, softbody__surface__state=MeshState,
                                softbody__cut=Cut, rosout=Log, diagnostics=DiagnosticArray)
        cls.corners, tets = box_tets()
        cls.topology = TetTopology(
            rest_vertices=points32(cls.corners), tets=[Tetrahedron(vertex_indices=tet) for tet in tets],
            surface_triangles=[MeshTriangle(vertex_indices=face) for face in boundary(tets)],
            vertex_parents=range(8), tet_bodies=[0] * len(tets))
        cls.topology.header.frame_id = "softbody"
        cls.topology_publisher = rospy.Publisher("/softbody/volume/topology", TetTopology, queue_size=1, latch=True)
        cls.state_publisher = rospy.Publisher("/softbody/volume/state", MeshState, queue_size=1)
        cls.topology_publisher.publish(cls.topology)
        cls.surface = cls.recorder.wait_for("softbody/surface/topology")[-1]
        cls.recorder.wait(lambda _: cls.state_publisher.get_num_connections() > 0, "a surface that listens")

    def surface_for(self, corners, seconds, revision=0):
        # Only time that stays elsewhere is believed: two states before this one go there too.
        goes_on, type(self).seconds = 0 < seconds - self.seconds <= 1, seconds
        for earlier in () if goes_on else (0.2, 0.1):
            state = MeshState(vertices=points32(self.corners), confidence=[1.0] * 8, revision=revision)
            state.header.stamp = state.observed = rospy.Time(seconds - earlier)
            state.header.frame_id = FRAME
            self.state_publisher.publish(state)
            rospy.sleep(0.05)
        state = MeshState(vertices=points32(corners), confidence=[1.0] * 8, revision=revision)
        state.header.stamp = state.observed = rospy.Time(seconds)
        state.header.frame_id = FRAME
        self.state_publisher.publish(state)
        return self.recorder.first("softbody/surface/state", lambda s: s.header.stamp == state.header.stamp,
                                   f"the surface state of {seconds} s")

    def test_reproduces_affine_maps(self):
        rest = array(self.surface.rest_vertices)
        random = np.random.default_rng(7)
        for i in range(3):
            linear = np.eye(3) + 0.3 * random.uniform(-1, 1, (3, 3))
            offset = random.uniform(-0.5, 0.5, 3)
            state = self.surface_for(self.corners @ linear.T + offset, 10 + i)
            np.testing.assert_allclose(array(state.vertices), rest @ linear.T + offset, atol=2e-6)
            self.assertEqual(state.header.frame_id, FRAME)
            self.assertEqual(state.revision, self.surface.revision)

    def test_answers_with_the_closest_point(self):
        state = self.surface_for(self.corners, 14)
        vertices = array(state.vertices)
        ask = rospy.ServiceProxy("/softbody/surface/closest_point", ClosestPoint)
        request = ClosestPoint._request_class()
        request.point.point = Point(0.01, -0.02, 0.5)  # above the sponge, whose top is a plane
        answer = ask(request)
        self.assertTrue(answer.success, answer.message)
        top = vertices[:, 2].max()
        np.testing.assert_allclose([getattr(answer.surface_point.point, axis) for axis in "xyz"],
                                   [0.01, -0.02, top], atol=1e-6)
        np.testing.assert_allclose([getattr(answer.normal, axis) for axis in "xyz"], [0.0, 0.0, 1.0], atol=1e-6)
        self.assertAlmostEqual(answer.distance, 0.5 - top, places=6)
        self.assertEqual(answer.surface_point.header.stamp, state.header.stamp)
        self.assertEqual((answer.surface_point.header.frame_id, answer.piece, answer.revision), (FRAME, 0, 0))
        self.assertTrue(np.isnan(answer.standard_deviation))  # the state that was made by hand has none
        # The frame of a hand 1 m above, turned by a quarter about x: its y axis points up.
        hand = TransformStamped(child_frame_id="hand")
        hand.header.frame_id = FRAME
        hand.transform.translation.z = 1.0
        hand.transform.rotation.x = hand.transform.rotation.w = np.sqrt(0.5)
        tf2_ros.StaticTransformBroadcaster().sendTransform(hand)
        request.point.header.frame_id, request.point.point = "hand", Point(0.01, -0.5, 0.02)
        deadline = time.monotonic() + 30.0
        while not answer.success or answer.surface_point.header.frame_id != "hand":
            self.assertLess(time.monotonic(), deadline, answer.message)
            rospy.sleep(0.1)
            answer = ask(request)
        np.testing.assert_allclose([getattr(answer.surface_point.point, axis) for axis in "xyz"],
                                   [0.01, top - 1.0, 0.02], atol=1e-6)
        np.testing.assert_allclose([getattr(answer.normal, axis) for axis in "xyz"], [0.0, 1.0, 0.0], atol=1e-6)
        request.point.header.frame_id = "nowhere"
        self.assertIn("'nowhere'", ask(request).message)
        request.point.header.frame_id, request.point.point.x = "", float("inf")
        self.assertIn("inf", ask(request).message)

    def test_becomes_a_file_as_it_is(self):
        state = self.surface_for(self.corners * [1.5, 1.0, 1.0], 15)
        save = rospy.ServiceProxy("/softbody/surface/save_mesh", SaveMesh)
        name = f"surface_{os.getpid()}.obj"
        answer = save(name)
        self.assertTrue(answer.success, answer.message)
        with open(answer.path, encoding="utf-8") as file:
            lines = [line.split() for line in file]
        self.addCleanup(os.remove, answer.path)
        vertices = np.array([line[1:4] for line in lines if line and line[0] == "v"], dtype=float)
        np.testing.assert_allclose(vertices, array(state.vertices), atol=1e-6)
        self.assertEqual(sum(line[:1] == ["f"] for line in lines), len(self.surface.triangles))
        self.assertEqual((answer.frame_id, answer.stamp), (FRAME, state.header.stamp))
        self.assertIn("exists already", save(name).message)
        for bad in ("../up.obj", "/tmp/x.obj", "x.ply", ".obj", ""):
            self.assertIn("allowed", save(bad).message)

    def test_becomes_standard_messages_for_planners(self):
        planner = Recorder(softbody__surface__mesh=Mesh, softbody__surface__points=PointCloud2)
        for subscriber in planner.subscribers:
            self.recorder.wait(lambda _: subscriber.get_num_connections() > 0, "a surface that publishes")
        rospy.sleep(0.5)
        state = self.surface_for(self.corners, 16)
        mesh, cloud = (planner.wait_for(f"softbody/surface/{name}")[-1] for name in ("mesh", "points"))
        vertices = array(state.vertices)
        np.testing.assert_allclose(array(mesh.vertices), vertices, atol=1e-6)
        self.assertEqual([t.vertex_indices for t in mesh.triangles], [t.vertex_indices for t in self.surface.triangles])
        points = np.array(list(point_cloud2.read_points(cloud, ("x", "y", "z", "normal_x", "normal_y", "normal_z"))))
        np.testing.assert_allclose(points[:, :3], vertices, atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(points[:, 3:], axis=1), 1.0, atol=1e-5)
        self.assertTrue((np.einsum("ij,ij->i", points[:, 3:], vertices - vertices.mean(axis=0)) > 0.0).all())
        self.assertEqual(cloud.header.frame_id, FRAME)

    def test_becomes_a_warning_when_the_volume_drifts(self):
        name = "softbody/surface: visual mesh"
        said = []
        for i in range(60):
            self.surface_for(self.corners * [1.5, 1.0, 1.0], 17 + 0.01 * i)
            rospy.sleep(0.1)
            with self.recorder.changed:
                said = [status for message in self.recorder.messages["diagnostics"] for status in message.status
                        if status.name == name and "volume differs from that at rest by 50 %" in status.message]
            if said:
                break
        self.assertTrue(said, self.recorder.messages["diagnostics"][-1:])
        self.assertEqual(said[0].level, DiagnosticStatus.WARN)
        self.assertIn("rate [Hz]", [value.key for value in said[0].values])
        self.recorder.wait_for_status(name, DiagnosticStatus.WARN, "no state of the volume")

    def test_holds_a_state_of_an_unknown_revision(self):
        state = MeshState(vertices=points32(self.corners), confidence=[1.0] * 8, revision=5)
        state.header.stamp = rospy.Time(20)
        self.state_publisher.publish(state)
        self.surface_for(self.corners, 21)
        stamps = [message.header.stamp for message in self.recorder.messages["softbody/surface/state"]]
        self.assertNotIn(rospy.Time(20), stamps)

    def test_publishes_a_state_that_came_before_its_topology(self):
        state = MeshState(vertices=points32(self.corners), confidence=[1.0] * 8, revision=7)
        state.header.stamp = rospy.Time(22)
        self.state_publisher.publish(state)
        rospy.sleep(0.5)  # two topics have no common order
        later = copy.deepcopy(self.topology)
        later.revision = 7
        self.topology_publisher.publish(later)
        answer = self.recorder.first("softbody/surface/state", lambda s: s.header.stamp == state.header.stamp,
                                     "the state that was held")
        self.assertEqual(answer.revision, 7)
        self.recorder.wait(lambda seen: seen["softbody/surface/topology"][-1].revision == 7, "revision 7")
        self.topology_publisher.publish(self.topology)
        self.recorder.wait(lambda seen: seen["softbody/surface/topology"][-1].revision == 0, "revision 0 again")

    def test_refuses_a_volume_without_surface(self):
        bare = copy.deepcopy(self.topology)
        bare.revision, bare.surface_triangles = 1, []
        self.topology_publisher.publish(bare)
        self.recorder.wait_for_log("/softbody/surface", "surface_triangles is empty", Log.ERROR)
        self.assertEqual(self.surface_for(self.corners, 23).revision, 0)
        self.topology_publisher.publish(self.topology)

    def test_publishes_an_edit_with_its_first_state(self):
        edited = copy.deepcopy(self.topology)
        edited.revision, edited.header.stamp = 1, rospy.Time(40)
        before = len(self.recorder.messages["softbody/surface/topology"])
        self.topology_publisher.publish(edited)
        rospy.sleep(1.5)  # topologies are sent every second
        self.assertEqual(self.surface_for(self.corners, 41).revision, 0)
        topologies = self.recorder.messages["softbody/surface/topology"][before:]
        self.assertEqual({topology.revision for topology in topologies}, {0})
        self.assertEqual(self.surface_for(self.corners, 42, revision=1).revision, 1)
        topology = self.recorder.first("softbody/surface/topology", lambda t: t.revision == 1,
                                       "the surface's topology of revision 1")
        self.assertEqual(topology.header.stamp, rospy.Time(40))
        self.topology_publisher.publish(self.topology)
        self.recorder.wait(lambda seen: seen["softbody/surface/topology"][-1].revision == 0, "revision 0 again")

    def test_takes_back_a_cut_that_no_simulator_makes(self):
        def cut():
            rospy.wait_for_service("/softbody/surface/cut", 30)
            return rospy.ServiceProxy("/softbody/surface/cut", CutBody)(point=Point(0.01, 0, 0), normal=Vector3(1, 0.1, 0))

        self.surface_for(self.corners, 50)
        answer = cut()
        self.assertTrue(answer.success, answer.message)
        self.assertIn("on its way", cut().message)

        def taken_back(seen):
            if time.monotonic() > taken_back.next:  # as a simulator does every second
                self.topology_publisher.publish(self.topology)
                taken_back.next = time.monotonic() + 0.9
            return [log for log in seen["rosout"] if log.level >= Log.ERROR and "takes it back" in log.msg]

        taken_back.next = 0.0
        self.recorder.wait(taken_back, "an error that tells of the cut")
        for second in (51, 52):
            state = self.surface_for(self.corners, second)
            self.assertEqual(state.revision, 0)
            np.testing.assert_allclose(array(state.vertices), array(self.surface.rest_vertices), atol=2e-6)
        answer = cut()
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.revision, 1)
        self.recorder.messages["rosout"].clear()
        self.recorder.wait(taken_back, "the same of the second cut")

    def test_tears_where_it_is_stretched(self):
        before = len(self.recorder.messages["softbody/cut"])
        self.surface_for(self.corners * [2.9, 1.0, 1.0], 60)
        self.assertEqual(len(self.recorder.messages["softbody/cut"]), before)
        self.surface_for(self.corners * [4.0, 1.0, 1.0], 64)
        cut = self.recorder.wait(lambda seen: seen["softbody/cut"][before:], "a tear")[0]
        self.assertEqual((cut.kind, cut.revision, cut.header.stamp), (Cut.CUT, 1, rospy.Time(64)))
        patch = array(cut.patch_vertices)
        self.assertLess(np.ptp(patch[:, 0]), 1e-6)
        self.assertTrue((np.ptp(patch, axis=0)[1:] > 2 * HALF_SIZE_M[1:]).all())

    def test_refuses_an_open_volume_and_keeps_the_last_one(self):
        open_topology = copy.deepcopy(self.topology)
        open_topology.surface_triangles.pop()
        self.topology_publisher.publish(open_topology)
        self.recorder.wait_for_log("/softbody/surface", "topology", Log.ERROR)
        state = self.surface_for(self.corners, 30)
        np.testing.assert_allclose(array(state.vertices), array(self.surface.rest_vertices), atol=2e-6)
        self.topology_publisher.publish(self.topology)

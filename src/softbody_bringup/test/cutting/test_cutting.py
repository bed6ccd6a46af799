"""Cuts by service and by a blade made by hand; simulator and surface keep step."""
import time
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import Point, Point32, PolygonStamped, Pose, Quaternion, TransformStamped, Vector3
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import Cut, MeshState, MeshTopology, Targets, TetTopology
from softbody_msgs.srv import CutBody, PreviewCut
from std_srvs.srv import Trigger
from tf2_ros import StaticTransformBroadcaster
from visualization_msgs.msg import Marker, MarkerArray

from poses import array
from recorder import Recorder

FRAME = "made_by_hand"


class Cutting(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState,
                                softbody__surface__topology=MeshTopology, softbody__surface__state=MeshState,
                                softbody__cut=Cut, softbody__cut__marker=Marker,
                                softbody__preview__marker=MarkerArray, rosout=Log)
        cls.targets = rospy.Publisher("/softbody/targets", Targets, queue_size=1)
        cls.blade = rospy.Publisher("/softbody/tool/blade", PolygonStamped, queue_size=1)
        cls.rest = array(cls.recorder.wait_for("softbody/surface/topology")[-1].rest_vertices)
        cls.recorder.wait(lambda _: cls.targets.get_num_connections() > 0 and cls.blade.get_num_connections() > 0,
                          "nodes that listen")
        cls.stamp = rospy.Time(1000)
        cls.revision = 0

    def service(self, name, kind):
        rospy.wait_for_service("/softbody/surface/" + name, 30)
        return rospy.ServiceProxy("/softbody/surface/" + name, kind)

    def step(self, stamp=None, **fields):
        """A frame without targets. @return the surface's state."""
        type(self).stamp = stamp or self.stamp + rospy.Duration(nsecs=33333333)
        self.publish_frame(**fields)
        return self.recorder.wait(
            lambda seen: next((s for s in reversed(seen["softbody/surface/state"]) if s.header.stamp == self.stamp),
                              None), f"the surface's state of {self.stamp.to_sec():.3f}")

    def publish_frame(self, **fields):
        fields.setdefault("revision", self.revision)
        message = Targets(**{"body_pose": Pose(orientation=Quaternion(w=1.0)), **fields})
        message.header.stamp, message.header.frame_id = self.stamp, FRAME
        self.targets.publish(message)

    def expect_revision(self, revision, pieces):
        """The next frame is answered with it, also where its targets are of the revision before."""
        self.recorder.wait(lambda seen: seen["softbody/volume/topology"][-1].revision == revision,
                           f"revision {revision} of the volume")
        state = self.step()
        type(self).revision = revision
        self.assertEqual(state.revision, revision)
        volume, surface = (self.recorder.wait(
            lambda seen, name=name: next((t for t in reversed(seen[name]) if t.revision == revision), None),
            f"revision {revision} on {name}") for name in ("softbody/volume/topology", "softbody/surface/topology"))
        self.assertEqual(1 + max(volume.tet_bodies), pieces)
        self.assertEqual(1 + max(surface.triangle_bodies), pieces)
        self.assertEqual(len(surface.rest_vertices), len(state.vertices))
        return surface

    def expect_preview(self):
        """Two pieces in two colours, a little outside of the body, and nothing once it is cut."""
        state = self.step()
        markers = self.recorder.wait(
            lambda seen: next((m.markers for m in seen["softbody/preview/marker"]
                               if m.markers[0].header.stamp == self.stamp), None), "a preview")
        self.assertEqual([m.ns for m in markers], ["pieces", "lines"])
        pieces, lines = (array(m.points) for m in markers)
        body = array(state.vertices)
        self.assertTrue((pieces.min(axis=0) < body.min(axis=0)).all() and (pieces.max(axis=0) > body.max(axis=0)).all())
        self.assertLess(np.abs(pieces.max(axis=0) - body.max(axis=0)).max(), 0.003)
        hues = {tuple(np.round(np.array([c.r, c.g, c.b]) / max(c.r, c.g, c.b), 2)) for c in markers[0].colors}
        self.assertEqual(len(hues), 2)
        self.assertLess(np.abs(lines[:, 0] - lines[:, 0].mean()).max(), 0.02)

    def expect_cut_lines(self, state_stamp):
        lines = self.recorder.first("softbody/cut/marker", lambda m: m.header.stamp == state_stamp, "cut lines")
        self.assertEqual(lines.action, Marker.ADD)
        self.assertGreater(len(lines.points), 8)
        self.recorder.wait(
            lambda seen: [m.action for m in seen["softbody/preview/marker"][-1].markers] == [Marker.DELETEALL],
            "the end of the preview")

    def test_0_before_the_body_has_a_place(self):
        """Such a cut holds from the first frame on, whatever the clock says."""
        middle = self.rest.mean(axis=0)
        cut = self.service("cut", CutBody)(point=Point(*middle), normal=Vector3(1.0, 0.1, 0.0))
        self.assertTrue(cut.success, cut.message)
        topology = self.recorder.wait(lambda seen: next(
            (t for t in seen["softbody/volume/topology"] if t.revision == 1), None), "revision 1 of the volume")
        self.assertEqual(topology.header.stamp, rospy.Time(0))
        type(self).revision = 1
        self.assertEqual(self.step(reset=True).revision, 1)
        for name in ("softbody/volume/topology", "softbody/surface/topology"):
            self.recorder.wait(lambda seen, name=name: [t for t in seen[name] if t.revision == 1
                                                        and t.header.stamp == self.stamp],
                               f"revision 1 on {name} with the first frame's stamp")
        self.assertTrue(self.service("reset", Trigger)().success)
        self.expect_revision(2, 1)

    def test_1_services(self):
        first = self.revision
        self.step(reset=True)
        middle = self.rest.mean(axis=0)
        plane = {"point": Point(*middle), "normal": Vector3(1.0, 0.1, 0.0)}
        preview = self.service("preview", PreviewCut)(**plane)
        self.assertTrue(preview.success, preview.message)
        self.assertEqual(len(preview.volumes), 2)
        self.expect_preview()
        cut = self.service("cut", CutBody)(**plane)
        self.assertTrue(cut.success, cut.message)
        self.assertEqual(cut.revision, first + 1)
        after = self.expect_revision(first + 1, 2)
        self.assertIn(True, list(after.cut_triangles))
        self.assertIn(-1, after.vertex_parents)
        self.expect_cut_lines(state_stamp=self.stamp)
        self.assertTrue(self.service("undo", Trigger)().success)
        before = self.expect_revision(first + 2, 1)
        self.recorder.wait(lambda seen: seen["softbody/cut/marker"][-1].action == Marker.DELETE, "no cut lines")
        self.assertTrue(np.array_equal(array(before.rest_vertices), self.rest))
        self.assertTrue(self.service("redo", Trigger)().success)
        self.expect_revision(first + 3, 2)
        self.assertTrue(self.service("reset", Trigger)().success)
        self.expect_revision(first + 4, 1)
        answer = self.service("undo", Trigger)()
        self.assertFalse(answer.success)
        self.assertEqual(answer.message, "there is no cut to undo")
        away = self.service("cut", CutBody)(point=Point(*(middle + 9.0)), normal=Vector3(1.0, 0.0, 0.0))
        self.assertFalse(away.success)
        self.assertNotEqual(away.message, "")
        bent = [Point32(0, 0, 0), Point32(0, 1, 0), Point32(0, 1, 1), Point32(0, 0.9, 0.1)]
        self.assertIn("convex", self.service("preview", PreviewCut)(polygon=bent).message)

    def blades(self, frame=FRAME, offset=np.zeros(3)):
        """From above, through the body and beyond. @param offset of the frame in that of the states."""
        low, high = self.rest.min(axis=0), self.rest.max(axis=0)
        x = 0.55 * low[0] + 0.45 * high[0]
        for z in np.arange(high[2] + 0.02, low[2] - 0.01, -0.002):
            corners = [(x, y, h) for y, h in ((low[1] - 0.02, z), (high[1] + 0.02, z),
                                              (high[1] + 0.02, z + 0.06), (low[1] - 0.02, z + 0.06))]
            blade = PolygonStamped()
            blade.header.frame_id = frame
            blade.polygon.points = [Point32(*(np.array(corner) - offset)) for corner in corners]
            yield blade

    def publish(self, blade, stamp):
        blade.header.stamp = stamp
        self.blade.publish(blade)
        rospy.sleep(0.05)

    def frames(self):
        """Frames as a camera sends them, until the surface answers one: not where a cut comes between its two nodes."""
        first = self.stamp
        while True:
            type(self).stamp += rospy.Duration(nsecs=33333333)
            self.publish_frame()
            deadline = time.monotonic() + 1
            states = self.recorder.messages["softbody/surface/state"]
            while time.monotonic() < deadline:
                if states[-1].header.stamp > first:
                    return states[-1]
                time.sleep(0.002)
            self.assertLess(self.stamp - first, rospy.Duration(2), "no state of the surface")

    def stroke(self, frame=FRAME, offset=np.zeros(3)):
        self.step(reset=True)
        first = self.revision
        for blade in self.blades(frame, offset):
            type(self).revision = self.frames().revision
            self.publish(blade, self.stamp)
        type(self).revision = self.frames().revision
        self.assertGreater(self.revision, first)
        self.expect_revision(self.revision, 2)
        cuts = [cut for cut in self.recorder.messages["softbody/cut"] if cut.revision > first]
        self.assertEqual(len({cut.stroke for cut in cuts}), 1)
        return np.concatenate([array(cut.patch_vertices) for cut in cuts])

    def test_2_blade(self):
        """Where it is told in another frame, at a known place in that of the states, it makes the same cut."""
        patches = self.stroke()
        self.assertTrue(self.service("reset", Trigger)().success)
        self.expect_revision(self.revision + 1, 1)
        offset = np.array([0.3, -0.2, 0.7])
        broadcaster = StaticTransformBroadcaster()
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = FRAME, "elsewhere"
        transform.transform.translation, transform.transform.rotation.w = Vector3(*offset), 1.0
        broadcaster.sendTransform(transform)
        again = self.stroke("elsewhere", offset)
        np.testing.assert_allclose(again.min(axis=0), patches.min(axis=0), atol=2e-3)
        np.testing.assert_allclose(again.max(axis=0), patches.max(axis=0), atol=2e-3)

    def test_3_a_fast_blade_waits_for_its_states(self):
        """A body is simulated later than a blade is found: the whole stroke, and more, before its first state."""
        self.assertTrue(self.service("reset", Trigger)().success)
        self.expect_revision(self.revision + 1, 1)
        period = rospy.Duration(0.005)
        blades = list(self.blades())
        stamps = [self.stamp + (k + 1) * period for k in range(2 * len(blades))]
        for k, stamp in enumerate(stamps):
            self.publish(blades[min(k, len(blades) - 1)], stamp)
        cuts = len(self.recorder.messages["softbody/cut"])
        for stamp in stamps:
            type(self).revision = self.step(stamp).revision
        self.assertGreater(len(self.recorder.messages["softbody/cut"]), cuts, "the blade has not cut")
        self.expect_revision(self.revision, 2)

    def test_4_time_that_jumps_back_makes_it_whole(self):
        type(self).revision = 0
        # A single stamp is an outlier: only time that stays back is a loop, for the simulator and then for the surface.
        for frame in range(10):
            message = Targets(body_pose=Pose(orientation=Quaternion(w=1.0)), reset=True)
            message.header.stamp, message.header.frame_id = rospy.Time(500, frame * 33333333), FRAME
            self.targets.publish(message)
            rospy.sleep(0.1)
        state = self.step(stamp=rospy.Time(501), reset=True)
        self.assertEqual(state.revision, 0)
        self.assertEqual(len(state.vertices), len(self.rest))

    def test_5_a_blade_that_cannot_cut_is_told(self):
        self.step()
        blade = PolygonStamped()
        blade.header.frame_id = FRAME
        for stamp, corners, words in ((rospy.Time(), 4, "no stamp"), (self.stamp, 2, "2 corners; allowed: 3 to")):
            blade.header.stamp, blade.polygon.points = stamp, [Point32(0.01 * k, 0.01 * k * k, 5) for k in range(corners)]
            for _ in range(6):
                self.blade.publish(blade)
                rospy.sleep(0.05)
            self.recorder.wait_for_log("/softbody/surface", words)

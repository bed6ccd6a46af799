"""The whole graph on a bag that is played again and again."""
import unittest

import rosnode
import rospy
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import CameraInfo, Image, PointCloud2
from softbody_msgs.msg import Forces, MeshState, MeshTopology, StageTiming, Targets, TetTopology, TrackingStatus
from visualization_msgs.msg import Marker, MarkerArray

from recorder import Recorder

OPTICAL_FRAME = "camera_color_optical_frame"
BACKGROUND, BODY = 1, 3  # labels of pixels
NODES = ["camera_ingest", "feature_tracker", "simulator", "surface"]
FRAME_OUTPUTS = ["rgb/image_rect_color", "rgb/camera_info", "depth/image_rect", "points", "features",
                 "features/marker", "labels", "targets", "status", "volume/state",
                 "surface/state", "surface/marker"]


class Graph(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(
            camera__color__image_raw=Image, softbody__rgb__image_rect_color=Image,
            softbody__rgb__camera_info=CameraInfo, softbody__depth__image_rect=Image, softbody__points=PointCloud2,
            softbody__features=PointCloud2, softbody__features__marker=Marker,
            softbody__labels=Image, softbody__targets=Targets,
            softbody__status=TrackingStatus, softbody__volume__topology=TetTopology,
            softbody__volume__state=MeshState, softbody__surface__topology=MeshTopology,
            softbody__surface__state=MeshState, softbody__surface__marker=Marker, softbody__timing=StageTiming)

    def test_every_node_answers(self):
        self.recorder.wait_for("softbody/surface/state")
        for name in NODES:
            self.assertTrue(rosnode.rosnode_ping(f"/softbody/{name}", max_count=1), name)

    def test_a_frames_outputs_carry_its_stamp_and_frame(self):
        for name in FRAME_OUTPUTS:
            # Before the first image, the status has no stamp.
            messages = self.recorder.wait(lambda seen: len(seen[f"softbody/{name}"]) >= 10 and [
                message for message in seen[f"softbody/{name}"] if not message.header.stamp.is_zero()], f"messages of {name}")
            stamps = {message.header.stamp for message in messages[:5]}
            self.recorder.wait(
                lambda seen: stamps <= {image.header.stamp for image in seen["camera/color/image_raw"]},
                f"/softbody/{name}: stamps of colour images")
            self.assertEqual({message.header.frame_id for message in messages}, {OPTICAL_FRAME}, name)

    def test_states_belong_to_the_latched_topologies(self):
        for body in ("volume", "surface"):
            topology = self.recorder.wait_for(f"softbody/{body}/topology")[-1]
            self.assertTrue(self.recorder.latched(f"softbody/{body}/topology"), body)
            self.assertEqual(topology.header.frame_id, "softbody")
            for state in self.recorder.wait_for(f"softbody/{body}/state", 3):
                self.assertEqual(len(state.vertices), len(topology.rest_vertices))
                self.assertEqual(len(state.confidence), len(state.vertices))
                self.assertEqual(state.revision, topology.revision)
                self.assertEqual(state.observed, state.header.stamp)

    def test_the_sponge_has_the_papers_vertex_counts(self):
        volume = self.recorder.wait_for("softbody/volume/topology")[-1]
        surface = self.recorder.wait_for("softbody/surface/topology")[-1]
        self.assertEqual((len(volume.rest_vertices), len(volume.tets), len(volume.surface_triangles)),
                         (132, 300, 260))
        self.assertEqual((len(surface.rest_vertices), len(surface.triangles)), (522, 1040))

    def test_the_body_is_tracked(self):
        self.recorder.first("softbody/status", lambda status: status.state == TrackingStatus.TRACKING,
                            "a status of TRACKING")

    def test_targets_name_tets_of_the_topology(self):
        tets = len(self.recorder.wait_for("softbody/volume/topology")[-1].tets)
        targets = self.recorder.wait(
            lambda seen: [target for message in seen["softbody/targets"] for target in message.targets], "targets")
        for target in targets:
            self.assertLess(target.tet, tets)
            self.assertAlmostEqual(sum(target.barycentric), 1.0, places=4)

    def test_labels_are_those_of_the_whole_image(self):
        label, image = (self.recorder.wait_for(f"softbody/{name}")[-1]
                        for name in ("labels", "rgb/image_rect_color"))
        self.assertEqual((label.encoding, label.width, label.height), ("mono8", image.width, image.height))
        self.assertIn(BODY, label.data)
        self.assertIn(BACKGROUND, label.data)

    def test_forces_on_the_body_come_while_somebody_listens(self):
        recorder = Recorder(softbody__forces=Forces, softbody__forces__marker=MarkerArray)
        bent = recorder.first("softbody/forces", lambda m: m.patches, "forces on the body")
        self.assertEqual((bent.header.frame_id, bent.wrench_frame), (OPTICAL_FRAME, "camera_link"))
        self.assertFalse(bent.in_newtons)  # the sponge's stiffness is a guess
        arrows = recorder.wait(lambda seen: next((m.markers for m in seen["softbody/forces/marker"]
                                                  if m.markers[0].header.stamp == bent.header.stamp), None), "arrows")
        self.assertEqual(len(arrows), 1 + len(bent.patches))
        for subscriber in recorder.subscribers:
            subscriber.unregister()

    def test_every_node_tells_its_stage_times(self):
        for name in NODES:
            self.recorder.first("softbody/timing", lambda timing: timing.node == name, f"stage times of {name}")

    def test_the_aggregator_has_a_group_for_each_node_and_leaves_nothing_over(self):
        groups = {"Camera": "camera_ingest", "Tracking": "feature_tracker", "Simulation": "simulator", "Surface": "surface"}

        def is_complete(array):
            return all(any(s.name.startswith(f"/softbody/{group}/softbody {node}: ") for s in array.status)
                       for group, node in groups.items())

        array = Recorder(diagnostics_agg=DiagnosticArray).first("diagnostics_agg", is_complete, "a status in each group")
        names = {status.name for status in array.status}
        self.assertEqual({name for name in names if name.count("/") < 3}, {"/softbody"} | {f"/softbody/{g}" for g in groups})

    def test_tf_leads_from_the_camera_to_the_body(self):
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        self.recorder.wait(lambda seen: buffer.can_transform(OPTICAL_FRAME, "softbody", rospy.Time(0)),
                           f"tf from {OPTICAL_FRAME} to softbody")
        depth_m = buffer.lookup_transform(OPTICAL_FRAME, "softbody", rospy.Time(0)).transform.translation.z
        self.assertTrue(0.3 < depth_m < 0.7, depth_m)
        listener.unregister()

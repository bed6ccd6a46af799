"""The interactive marker, used as rviz does: moved, and told to track from there."""
import unittest

import numpy as np
import rospy
import tf2_ros
from softbody_msgs.msg import MeshTopology, Targets, TetTopology
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit, InteractiveMarkerUpdate

from poses import CORNERS_M, placed, pose_in, rotation
from recorder import Recorder

OPTICAL_FRAME, TRUE_FRAME = "camera_color_optical_frame", "ground_truth_softbody"
HALF_TURN = (0, 0, 1, 0)
MAX_ERROR_M = 0.005


class PoseMarker(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(
            softbody__pose_marker__update_full=InteractiveMarkerInit, softbody__pose_marker__update=InteractiveMarkerUpdate,
            softbody__targets=Targets, softbody__surface__topology=MeshTopology, softbody__volume__topology=TetTopology)
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        cls.feedback = rospy.Publisher("/softbody/pose_marker/feedback", InteractiveMarkerFeedback, queue_size=5)
        cls.recorder.wait(lambda _: cls.feedback.get_num_connections() > 0, "a marker that listens")

    def marker(self):
        """As a client that connects now is told."""
        recorder = Recorder(softbody__pose_marker__update_full=InteractiveMarkerInit)
        return recorder.wait(
            lambda seen: [m for init in seen["softbody/pose_marker/update_full"] for m in init.markers], "the marker")[-1]

    def send(self, event, pose, menu_entry_id=0):
        message = InteractiveMarkerFeedback(header=pose.header, client_id="test", marker_name="body", pose=pose.pose,
                                            event_type=event, menu_entry_id=menu_entry_id)
        self.feedback.publish(message)

    def test_it_is_the_visual_mesh_at_the_objects_pose(self):
        mesh = self.recorder.wait_for("softbody/surface/topology")[-1]
        start = self.recorder.wait_for("softbody/volume/topology")[-1].initial_pose
        marker = self.marker()
        self.assertEqual(marker.header.frame_id, OPTICAL_FRAME)
        self.assertEqual(len(marker.controls[0].markers[0].points), 3 * len(mesh.triangles))
        self.assertEqual([entry.title for entry in marker.menu_entries], ["track from here"])
        self.assertAlmostEqual(marker.pose.position.z, start.position.z)

    def test_track_from_here(self):
        self.recorder.first("softbody/targets", lambda t: not t.reset, "a body that is followed")
        self.recorder.wait(lambda _: self.buffer.can_transform(OPTICAL_FRAME, TRUE_FRAME, rospy.Time(0)), "the truth on tf")
        true = self.buffer.lookup_transform(OPTICAL_FRAME, TRUE_FRAME, rospy.Time(0)).transform
        expected = placed(true.translation, true.rotation, CORNERS_M @ rotation(HALF_TURN).T)
        at, q = true.translation, true.rotation
        pose = pose_in(OPTICAL_FRAME, (at.x + 0.01, at.y + 0.005, at.z - 0.01),
                       (q.y, -q.x, q.w, -q.z))  # q times the half turn
        marker = self.marker()
        self.send(InteractiveMarkerFeedback.POSE_UPDATE, pose)
        self.recorder.wait(
            lambda seen: [p for update in seen["softbody/pose_marker/update"] for p in update.poses
                          if p.pose == pose.pose], "the marker at its new pose")
        before = len(self.recorder.messages["softbody/targets"])
        rospy.sleep(1.0)
        self.assertFalse(any(t.reset for t in self.recorder.messages["softbody/targets"][before:]), "moving alone does nothing")
        before = len(self.recorder.messages["softbody/targets"])
        self.send(InteractiveMarkerFeedback.MENU_SELECT, pose, marker.menu_entries[0].id)
        first = self.recorder.first("softbody/targets", lambda t: t.reset, "a start", since=before)
        found = placed(first.body_pose.position, first.body_pose.orientation, CORNERS_M)
        self.assertLess(np.linalg.norm(found - expected, axis=1).max(), MAX_ERROR_M)

"""A recorded cut is played: the body falls into two pieces, whether the knife is tracked by its marker or known by tf."""
import unittest

import rospy
from geometry_msgs.msg import PoseStamped, TransformStamped
from softbody_msgs.msg import MeshTopology
from tf2_ros import TransformBroadcaster

from recorder import Recorder


class RecordedCut(unittest.TestCase):
    def test_body_falls_into_two_pieces(self):
        broadcaster = TransformBroadcaster()
        poses = rospy.Subscriber("/ground_truth/tool/pose", PoseStamped, self.send, broadcaster)
        recorder = Recorder(softbody__surface__topology=MeshTopology)
        whole = recorder.wait_for("softbody/surface/topology")[0]
        self.assertEqual(set(whole.triangle_bodies), {0})
        cut = recorder.first("softbody/surface/topology", lambda topology: max(topology.triangle_bodies) > 0,
                             "two pieces")
        self.assertEqual(set(cut.triangle_bodies), {0, 1})
        self.assertTrue(any(cut.cut_triangles))
        poses.unregister()

    @staticmethod
    def send(pose, broadcaster):
        """The true pose of the knife, as a robot would send it."""
        transform = TransformStamped(header=pose.header, child_frame_id="robot_tool")
        for axis in "xyz":
            setattr(transform.transform.translation, axis, getattr(pose.pose.position, axis))
        transform.transform.rotation = pose.pose.orientation
        broadcaster.sendTransform(transform)

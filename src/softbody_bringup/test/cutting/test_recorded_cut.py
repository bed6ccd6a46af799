#!/usr/bin/env python3
"""A recorded cut is played: the body falls into two pieces, whether the knife is tracked by its marker or known by tf."""
import os
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped, TransformStamped
from softbody_msgs.msg import MeshTopology
from tf2_ros import TransformBroadcaster

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "shared"))
from recorder import Recorder  # pylint: disable=wrong-import-position


class RecordedCut(unittest.TestCase):
    def test_body_falls_into_two_pieces(self):
        broadcaster = TransformBroadcaster()
        poses = rospy.Subscriber("/ground_truth/tool/pose", PoseStamped, self.send, broadcaster)
        recorder = Recorder(softbody__surface__topology=MeshTopology)
        whole = recorder.wait_for("softbody/surface/topology")[0]
        self.assertEqual(set(whole.triangle_bodies), {0})
        cut = recorder.wait(lambda seen: next((topology for topology in seen["softbody/surface/topology"]
                                               if max(topology.triangle_bodies) > 0), None), "two pieces")
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


if __name__ == "__main__":
    rospy.init_node("test_recorded_cut")
    rostest.rosrun("softbody_bringup", "test_recorded_cut", RecordedCut, sys.argv)

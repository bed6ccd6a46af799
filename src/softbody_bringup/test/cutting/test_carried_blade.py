"""A blade that a frame of tf carries: without the frame the log says so and nothing is cut; with it tool/pose, tool/blade
and the tf of the tool come with the stamp of each image, and the blade cuts the body in two."""
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import PolygonStamped, PoseStamped, PoseWithCovarianceStamped, TransformStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo
from softbody_msgs.msg import MeshTopology
from tf2_msgs.msg import TFMessage
from tf2_ros import TransformBroadcaster

from recorder import Recorder


def place(pose):
    return np.array([pose.position.x, pose.position.y, pose.position.z])


class CarriedBlade(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__tool__pose=PoseWithCovarianceStamped, softbody__tool__blade=PolygonStamped,
                                softbody__surface__topology=MeshTopology, rosout=Log, tf=TFMessage,
                                ground_truth__tool__pose=PoseStamped, camera__color__camera_info=CameraInfo)
        cls.broadcaster = TransformBroadcaster()

    def send(self, pose):
        """The true pose of the knife, as a robot would send it."""
        transform = TransformStamped(header=pose.header, child_frame_id="robot_tool")
        for axis in "xyz":
            setattr(transform.transform.translation, axis, getattr(pose.pose.position, axis))
        transform.transform.rotation = pose.pose.orientation
        self.broadcaster.sendTransform(transform)

    def test_1_a_frame_that_tf_does_not_know(self):
        self.recorder.wait_for_log("/softbody/tool_tracker", "tf does not say where robot_tool is")
        self.assertFalse(self.recorder.messages["softbody/tool/pose"])
        self.assertFalse(self.recorder.messages["softbody/tool/blade"])

    def test_2_the_blade_follows_the_frame_and_cuts(self):
        poses = rospy.Subscriber("/ground_truth/tool/pose", PoseStamped, self.send)
        cut = self.recorder.first("softbody/surface/topology", lambda topology: max(topology.triangle_bodies) > 0,
                                  "two pieces")
        poses.unregister()
        self.assertEqual(set(cut.triangle_bodies), {0, 1})
        seen = self.recorder.wait_for("softbody/tool/pose")
        blades = self.recorder.wait_for("softbody/tool/blade")
        images = {info.header.stamp for info in self.recorder.messages["camera/color/camera_info"]}
        truths = {pose.header.stamp: place(pose.pose) for pose in self.recorder.messages["ground_truth/tool/pose"]}
        self.assertLessEqual({blade.header.stamp for blade in blades}, images)
        for pose in seen:
            np.testing.assert_allclose(place(pose.pose.pose), truths[pose.header.stamp], atol=1e-6)
        sent = {t.header.stamp for message in self.recorder.messages["tf"] for t in message.transforms
                if t.child_frame_id == "tool"}
        self.assertTrue(sent)
        self.assertLessEqual(sent, images)

"""The tool of the virtual scene `cut` is tracked live: pose against the truth, blade, transform, diagnostics."""
import unittest

import numpy
import rospkg
import tf2_msgs.msg
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PolygonStamped, PoseStamped, PoseWithCovarianceStamped
from softbody_msgs.msg import StageTiming

from poses import array, rotation, vector
from recorder import Recorder

FRAMES = 10
MAX_ERROR_M, MAX_ERROR_RAD = 0.002, 0.035  # 2 mm and 2 degrees, noise on


def matrix(pose):
    """4 x 4 of a geometry_msgs/Pose."""
    result = numpy.eye(4)
    result[:3, :3], result[:3, 3] = rotation(pose.orientation), vector(pose.position)
    return result


def same_stamps(first, second):
    """Pairs of messages with the same stamp."""
    by_stamp = {message.header.stamp: message for message in second}
    return [(message, by_stamp[message.header.stamp]) for message in first if message.header.stamp in by_stamp]


def tool_transforms(messages):
    return [t for message in messages for t in message.transforms if t.child_frame_id == "tool"]


class Tool(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__tool__pose=PoseWithCovarianceStamped, softbody__tool__blade=PolygonStamped,
                                ground_truth__tool__pose=PoseStamped, softbody__timing=StageTiming,
                                tf=tf2_msgs.msg.TFMessage, diagnostics=DiagnosticArray)

    def test_pose_is_near_the_truth(self):
        pairs = self.recorder.wait(
            lambda seen: len(same_stamps(seen["softbody/tool/pose"], seen["ground_truth/tool/pose"])) >= FRAMES
            and same_stamps(seen["softbody/tool/pose"], seen["ground_truth/tool/pose"]), "tool poses with a truth")
        # Where the tool is out of view its pose is predicted for a moment, and says so by its covariance.
        seen = [(a, b) for a, b in pairs if a.pose.covariance[0] < 1e-5]
        self.assertGreaterEqual(len(seen), FRAMES // 2)
        for answer, truth in seen:
            difference = numpy.linalg.inv(matrix(truth.pose)) @ matrix(answer.pose.pose)
            angle = numpy.arccos(numpy.clip((numpy.trace(difference[:3, :3]) - 1) / 2, -1, 1))
            self.assertLess(numpy.linalg.norm(difference[:3, 3]), MAX_ERROR_M)
            self.assertLess(angle, MAX_ERROR_RAD)
            self.assertEqual(answer.header.frame_id, "camera_color_optical_frame")

    def test_blade_and_transform_are_those_of_the_pose(self):
        with open(rospkg.RosPack().get_path("softbody_bringup") + "/config/knife.yaml", encoding="utf-8") as file:
            blade = numpy.array(yaml.safe_load(file)["tool"]["blade"])
        pairs = self.recorder.wait(
            lambda seen: same_stamps(seen["softbody/tool/pose"], seen["softbody/tool/blade"]), "a blade")
        pose, polygon = pairs[0]
        expected = (matrix(pose.pose.pose) @ numpy.c_[blade, numpy.ones(len(blade))].T).T[:, :3]
        corners = array(polygon.polygon.points)
        numpy.testing.assert_allclose(corners, expected, atol=1e-6)
        transform = self.recorder.wait(
            lambda seen: [t for t in tool_transforms(seen["tf"]) if t.header.stamp == pose.header.stamp],
            "the tool's transform")[0]
        numpy.testing.assert_allclose(vector(transform.transform.translation), matrix(pose.pose.pose)[:3, 3], atol=1e-9)

    def test_timing_and_diagnostics(self):
        self.recorder.first("softbody/timing", lambda message: message.node == "tool_tracker", "timing of tool_tracker")
        self.recorder.wait(
            lambda seen: any("tool_tracker: tool" in status.name and status.message == "seen"
                             for message in seen["diagnostics"] for status in message.status),
            "diagnostics of a tool that is seen")

"""A tool is seen where tf never places the camera in output_frame, too; the log and /diagnostics say what that costs and
why, until tf places it."""
import unittest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from rosgraph_msgs.msg import Log
from tf2_ros import StaticTransformBroadcaster
from visualization_msgs.msg import MarkerArray

from recorder import Recorder

REASON = "tf does not say where camera_color_optical_frame is in output_frame bench"


class ToolWithoutTf(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__tool__pose=PoseWithCovarianceStamped, softbody__tool__marker=MarkerArray,
                                rosout=Log, diagnostics=DiagnosticArray)

    def test_1_the_reason_is_told(self):
        self.recorder.wait_for_log("/softbody/tool_tracker", REASON + ": tf does not know the frame 'bench'")
        self.recorder.wait_for_status("tool_tracker: tool", DiagnosticStatus.WARN, "not predicted: " + REASON)
        self.recorder.wait_for("softbody/tool/pose")
        self.assertFalse(self.recorder.messages["softbody/tool/marker"])

    def test_2_until_tf_places_the_camera(self):
        bench = TransformStamped()
        bench.header.frame_id, bench.child_frame_id = "bench", "camera_link"
        bench.transform.rotation.w = 1.0
        StaticTransformBroadcaster().sendTransform(bench)
        self.recorder.wait_for_status("tool_tracker: tool", DiagnosticStatus.OK, "seen")
        marker = self.recorder.wait_for("softbody/tool/marker")[0].markers[0]
        self.assertEqual(marker.header.frame_id, "bench")

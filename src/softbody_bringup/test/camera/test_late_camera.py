"""What camera_ingest says before a camera that starts later, and of one that falls silent."""
import unittest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rosgraph_msgs.msg import Log

from hand_made_camera import TOPICS, Camera
from recorder import Recorder

NODE, WAITING, SILENT = "/softbody/camera_ingest", "waiting for the first frame", "no frame for"


class LateCamera(unittest.TestCase):
    def test_a_start_is_no_fault_and_silence_is(self):
        recorder = Recorder(rosout=Log, diagnostics=DiagnosticArray)
        said = recorder.wait_for_log(NODE, WAITING, Log.INFO)
        self.assertEqual(said.level, Log.INFO)
        self.assertIn(f"{TOPICS['color']} (nobody publishes it)", said.msg)
        recorder.wait_for_status("camera_ingest: frames", DiagnosticStatus.WARN, WAITING)
        camera = Camera()
        recorder.wait_for_status("camera_ingest: frames", DiagnosticStatus.OK, "frames a second")
        self.assertFalse([log.msg for log in recorder.messages["rosout"] if log.name == NODE and log.level > Log.INFO])
        camera.be(copies={name: 0 for name in TOPICS})
        recorder.wait_for_log(NODE, SILENT)
        recorder.wait_for_status("camera_ingest: frames", DiagnosticStatus.ERROR, SILENT)
        camera.be(unstamped=("color", "depth"))
        said = recorder.wait_for_log(NODE, f"{TOPICS['color']} (the stamp of its images is 0)")
        self.assertIn(f"the sender of {TOPICS['color']} must set header.stamp", said.msg)
        self.assertNotIn("ROS_IP", said.msg)
        camera.stop()

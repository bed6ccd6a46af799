"""/diagnostics and the log tell how far colour and depth are apart in time, and that the camera has another clock."""
import unittest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rosgraph_msgs.msg import Log

from hand_made_camera import Camera
from recorder import Recorder

NODE, SYNC = "/softbody/camera_ingest", "camera_ingest: sync offset"
OK, WARN = DiagnosticStatus.OK, DiagnosticStatus.WARN


def offsets(status):
    values = {value.key: float(value.value) for value in status.values}
    return values["mean offset [ms]"], values["worst offset [ms]"], values["colour images without depth"]


class CameraTimes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(rosout=Log, diagnostics=DiagnosticArray)
        cls.camera = Camera()

    @classmethod
    def tearDownClass(cls):
        cls.camera.stop()

    def settled(self, level, mean_ms):
        """The offsets, once the images of before are forgotten."""
        before = len(self.recorder.messages["diagnostics"])
        return self.recorder.wait(lambda seen: next(
            (offsets(status) for message in seen["diagnostics"][before:] for status in message.status
             if status.name.endswith(SYNC) and status.level == level and abs(offsets(status)[0] - mean_ms) < 0.01), None),
            f"a mean offset of {mean_ms} ms, level {level}")

    def test_1_streams_with_equal_stamps(self):
        self.assertEqual(self.settled(OK, 0.0)[1:], (0.0, 0.0))

    def test_2_an_offset_that_pairing_tolerates(self):
        self.camera.be(apart_s=-0.004)
        self.assertEqual(self.settled(OK, 4.0)[1:], (4.0, 0.0))

    def test_3_an_offset_that_makes_no_frame(self):
        self.camera.be(apart_s=-0.04)
        _, worst_ms, alone = self.settled(WARN, 40.0)
        self.assertEqual(worst_ms, 40.0)
        self.assertGreater(alone, 0)

    def test_4_a_clock_that_is_ahead(self):
        self.camera.be(late_by_s=-20.0)
        said = self.recorder.wait_for_log(NODE, "ahead of this machine's clock").msg
        self.assertIn("synchronise the camera's clock", said)
        self.recorder.wait_for_status("camera_ingest: frames", WARN, "ahead of this machine's clock")

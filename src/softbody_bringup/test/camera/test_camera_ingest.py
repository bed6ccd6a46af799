"""What camera_ingest says of its streams, in the log and in /diagnostics, and what it leaves out."""
import unittest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Image

from hand_made_camera import TOPICS, Camera
from recorder import Recorder

DEPTH_FRAME = "camera_depth_optical_frame"
RESULT = "softbody/rgb/image_rect_color"


class CameraIngest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.camera = Camera()
        cls.recorder = Recorder(rosout=Log, diagnostics=DiagnosticArray, softbody__rgb__image_rect_color=Image)

    @classmethod
    def tearDownClass(cls):
        cls.camera.stop()

    def wait_for_log(self, words):
        self.recorder.wait_for_log("/softbody/camera_ingest", words)

    def wait_for_status(self, level, words):
        self.recorder.wait_for_status("camera_ingest: frames", level, words)

    def tearDown(self):
        self.be_well()

    def be_well(self):
        self.camera.be()
        self.wait_for_status(DiagnosticStatus.OK, "frames a second")

    def test_a_silent_topic_is_named(self):
        self.camera.be(copies={"depth": 0})
        words = "no usable message on /camera/aligned_depth_to_color/image_raw (publishers: 1, but silent)"
        self.wait_for_log(words)
        self.wait_for_status(DiagnosticStatus.ERROR, words)

    def test_an_image_counts_once(self):
        for name in ("color", "depth"):
            self.camera.be(copies={name: 2})
            self.wait_for_log(f"{TOPICS[name]}: a second image with the stamp")
            images = self.recorder.wait_for(RESULT, len(self.recorder.messages[RESULT]) + 10)
            stamps = [image.header.stamp for image in images]
            self.assertEqual(len(stamps), len(set(stamps)), name)

    def test_images_without_a_stamp_are_named(self):
        for name in ("color", "depth"):
            self.be_well()
            self.camera.be(unstamped=(name,))
            self.wait_for_log(f"{TOPICS[name]}: an image without a stamp is dropped")
            self.wait_for_status(DiagnosticStatus.ERROR, f"{TOPICS[name]} (the stamp of its images is 0)")
        self.assertFalse([image for image in self.recorder.messages[RESULT] if image.header.stamp.is_zero()])

    def test_depth_in_a_frame_that_tf_does_not_know_is_refused_by_name(self):
        self.camera.be(frames={"depth": DEPTH_FRAME})
        self.wait_for_log(f"depth is in frame '{DEPTH_FRAME}'")
        self.wait_for_status(DiagnosticStatus.ERROR, DEPTH_FRAME)

    def test_a_clock_that_is_behind_is_named(self):
        self.camera.be(late_by_s=100.0)
        self.wait_for_status(DiagnosticStatus.WARN, "100.0 s behind")
        self.wait_for_log("this machine's clock")

    def test_a_slash_before_the_frame_is_left_out(self):
        """Old drivers and bags have one, and tf2 refuses it."""
        self.camera.be(frames={"color": "/left_optical_frame", "depth": "/left_optical_frame"})
        self.recorder.wait(lambda seen: seen[RESULT] and seen[RESULT][-1].header.frame_id == "left_optical_frame",
                           "an image whose frame has no slash")

    def test_images_without_a_frame_are_named(self):
        self.camera.be(frames={"color": "", "depth": ""})
        self.wait_for_status(DiagnosticStatus.WARN, "no frame_id")

    def test_a_clock_that_is_ahead_is_named(self):
        self.camera.be(late_by_s=-100.0)
        self.wait_for_status(DiagnosticStatus.WARN, "100.0 s ahead")

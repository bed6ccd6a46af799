"""playback.launch finds out whether a bag has raw or compressed images, and takes the transports that it is given."""
import os
import signal
import subprocess
import tempfile
import unittest

import rospy
from softbody.compress_bag import compress
from softbody_msgs.msg import MeshState, TrackingStatus

from compressed_bag import BAG, SHARE, copy_bag
from recorder import Recorder


class CompressedPlayback(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.compressed = copy_bag(os.path.join(scratch.name, "compressed.bag"), compress)

    def expect_tracking(self, bag, *arguments):
        recorder = Recorder(softbody__surface__state=MeshState, softbody__status=TrackingStatus)
        launch = subprocess.Popen(["roslaunch", "softbody_bringup", "playback.launch", f"bag:={bag}", "loop:=true",
                                   f"object:={SHARE}/config/sponge.yaml", *arguments])
        try:
            recorder.first("softbody/status", lambda status: status.state == TrackingStatus.TRACKING,
                           f"TRACKING in {bag} with {arguments}")
            recorder.wait_for("softbody/surface/state", 5)
            return [rospy.get_param(f"/softbody/camera_ingest/{stream}_transport") for stream in ("color", "depth")]
        finally:
            launch.send_signal(signal.SIGINT)
            launch.wait(60)

    def test_transports_that_are_given(self):
        given = self.expect_tracking(self.compressed, "color_transport:=compressed", "depth_transport:=compressedDepth")
        self.assertEqual(given, ["compressed", "compressedDepth"])

    def test_compressed_images_are_found(self):
        self.expect_tracking(self.compressed)

    def test_raw_images_are_found(self):
        self.expect_tracking(BAG)

"""The launch file of a camera's driver, with what this driver publishes: rectified colour, depth and their CameraInfo."""
import sys
import unittest

import numpy as np
import rosgraph
import rospy
from sensor_msgs.msg import CameraInfo, Image
from softbody_msgs.msg import MeshTopology, TetTopology, TrackingStatus

from driver_camera import DEPTH_M, DRIVERS, DriverCamera
from recorder import Recorder

DRIVER = sys.argv[sys.argv.index("--driver") + 1]


class CameraDriver(unittest.TestCase):
    def test_frames_come_out(self):
        color, depth, rate = DRIVERS[DRIVER]
        recorder = Recorder(softbody__rgb__image_rect_color=Image, softbody__depth__image_rect=Image,
                            softbody__depth__camera_info=CameraInfo)
        camera = DriverCamera(color, depth, rate)
        image = recorder.wait_for("softbody/rgb/image_rect_color")[-1]
        self.assertEqual((image.header.frame_id, image.width, image.height), (color.frame, *color.size))
        self.assertEqual(recorder.wait_for("softbody/depth/camera_info")[-1].width, color.size[0])
        seen = recorder.first("softbody/depth/image_rect",
                              lambda m: np.isfinite(np.frombuffer(m.data, np.float32)).any(), "an image with depth")
        self.assertEqual((seen.encoding, seen.header.frame_id), ("32FC1", color.frame))
        values = np.frombuffer(seen.data, np.float32).reshape(seen.height, seen.width)
        self.assertAlmostEqual(float(values[seen.height // 2, seen.width // 2]), DEPTH_M, places=3)
        if depth.size == color.size and depth.frame == color.frame:
            self.assertTrue(np.isnan(values[:6, :6]).all(), "NaN where nothing was measured (REP-118)")
        self.assertFalse((values == 0.0).any())
        camera.stop()

    def test_the_nodes_run_in_the_drivers_manager(self):
        recorder = Recorder(softbody__surface__topology=MeshTopology, softbody__volume__topology=TetTopology,
                            softbody__status=TrackingStatus)
        for topic in recorder.messages:  # the nodelets are loaded one after the other
            recorder.wait_for(topic)
        publishers = dict(rosgraph.Master(rospy.get_name()).getSystemState()[0])
        for topic in ("rgb/image_rect_color", "status", "volume/topology", "surface/topology"):
            self.assertEqual(publishers[f"/softbody/{topic}"], ["/driver/manager"], topic)

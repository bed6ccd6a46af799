#!/usr/bin/env python3
"""A camera whose depth never comes: the log names the topic."""
import sys
import unittest

import rospy
import rostest
from recorder import Recorder
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, Image

WIDTH, HEIGHT = 64, 48


class SilentTopic(unittest.TestCase):
    def test_depth_is_named(self):
        color = rospy.Publisher("/camera/color/image_raw", Image, queue_size=1)
        info = rospy.Publisher("/camera/color/camera_info", CameraInfo, queue_size=1)

        def publish(_):
            image = Image(height=HEIGHT, width=WIDTH, encoding="rgb8", step=3 * WIDTH, data=bytes(3 * WIDTH * HEIGHT))
            camera = CameraInfo(height=HEIGHT, width=WIDTH, K=[60, 0, 32, 0, 60, 24, 0, 0, 1],
                                P=[60, 0, 32, 0, 0, 60, 24, 0, 0, 0, 1, 0], R=[1, 0, 0, 0, 1, 0, 0, 0, 1])
            image.header.stamp = camera.header.stamp = rospy.Time.now()
            color.publish(image)
            info.publish(camera)

        timer = rospy.Timer(rospy.Duration(0.1), publish)
        recorder = Recorder(rosout=Log)
        warning = recorder.wait(
            lambda seen: [log.msg for log in seen["rosout"]
                          if log.level >= Log.WARN and log.name == "/softbody/camera_ingest"
                          and "/camera/aligned_depth_to_color/image_raw" in log.msg
                          and "/camera/color/image_raw" not in log.msg],
            "a warning of /softbody/camera_ingest that names the silent depth topic alone")
        timer.shutdown()
        self.assertTrue(warning)


if __name__ == "__main__":
    rospy.init_node("test_silent_topic")
    rostest.rosrun("softbody_bringup", "test_silent_topic", SilentTopic, sys.argv)

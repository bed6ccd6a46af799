#!/usr/bin/env python3
"""A robot's link is a known surface where tf says that it is; where tf does not say it, the link is left out."""
import os
import sys
import unittest

import numpy as np
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Image
from softbody_msgs.msg import TrackingStatus

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "shared"))
from recorder import Recorder  # pylint: disable=wrong-import-position

OCCLUDER, BODY = 2, 3
FRAMES = 5


def pixels(image):
    return np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)[:, :image.width]


class Robot(unittest.TestCase):
    def test_a_link_is_an_occluder_once_tf_says_where_it_is(self):
        recorder = Recorder(softbody__labels=Image, softbody__status=TrackingStatus, rosout=Log)
        recorder.wait(lambda seen: any(s.state == TrackingStatus.TRACKING for s in seen["softbody/status"]), "TRACKING")
        recorder.wait_for_log("/softbody/feature_tracker", "link block is left out")
        body = pixels(recorder.wait_for("softbody/labels", FRAMES)[-1]) == BODY
        self.assertGreater(body.sum(), 1000)

        link = TransformStamped()  # half of the sponge becomes the link
        link.header.frame_id, link.child_frame_id = "ground_truth_softbody", "block"
        link.transform.rotation.w = 1.0
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(link)

        def half_is_covered(seen):
            labels = pixels(seen["softbody/labels"][-1])[body]
            return 0.3 < np.mean(labels == OCCLUDER) and 0.3 < np.mean(labels == BODY)

        recorder.wait(half_is_covered, "labels that show the link on half of the body")
        labels = pixels(recorder.messages["softbody/labels"][-1])
        columns = {label: np.nonzero(body & (labels == label))[1].mean() for label in (OCCLUDER, BODY)}
        self.assertGreater(abs(columns[OCCLUDER] - columns[BODY]), 30.0, "link and body lie side by side")


if __name__ == "__main__":
    rospy.init_node("test_robot")
    rostest.rosrun("softbody_bringup", "test_robot", Robot, sys.argv)

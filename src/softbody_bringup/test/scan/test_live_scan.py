"""The scanner shows the surface while the camera walks round the object, and writes the model when it is told to."""
import os
import re
import shutil
import unittest

import rospy
from geometry_msgs.msg import PointStamped
from softbody_msgs.msg import MeshState, MeshTopology
from std_msgs.msg import String
from std_srvs.srv import Trigger

OUTPUT = "/tmp/softbody_test_live_scan"  # as in live_scan.test


def views():
    """Number of views so far."""
    found = re.search(r"(\d+) views", rospy.wait_for_message("/scan/progress", String, 30.0).data)
    return int(found.group(1))


def progress_says(text):
    return text in rospy.wait_for_message("/scan/progress", String, 30.0).data


def wait_for(condition):
    """Ends with the test's time limit."""
    while not condition():
        rospy.sleep(1.0)


class LiveScan(unittest.TestCase):
    def setUp(self):
        self.addCleanup(shutil.rmtree, OUTPUT, True)
        self.clicks = rospy.Publisher("/clicked_point", PointStamped, queue_size=1)

    def call(self, name):
        rospy.wait_for_service("/scanner/" + name, 30.0)
        return rospy.ServiceProxy("/scanner/" + name, Trigger)()

    def click(self, frame, x, y, z):
        message = PointStamped()
        message.header.frame_id = frame
        message.point.x, message.point.y, message.point.z = x, y, z
        self.clicks.publish(message)

    def test_a_model_is_written_when_the_walk_is_over(self):
        wait_for(lambda: views() >= 3)
        answer = self.call("finish")
        self.assertFalse(answer.success)
        self.assertIn("the scan goes on", answer.message)
        self.assertFalse(os.path.exists(OUTPUT))
        wait_for(lambda: views() >= 45)
        topology = rospy.wait_for_message("/scan/topology", MeshTopology, 30.0)
        state = rospy.wait_for_message("/scan/state", MeshState, 30.0)
        self.assertEqual(topology.header.frame_id, "scan")
        self.assertGreater(len(topology.triangles), 500)
        self.assertGreater(max(state.confidence), 0.9)
        self.click("scan", float("nan"), 0.0, 0.0)
        wait_for(lambda: progress_says("the clicked point is not used: (nan, 0, 0) must be finite"))
        self.click("nowhere", 0.0, 0.0, 0.0)
        wait_for(lambda: progress_says("tf does not know the frame 'nowhere'"))
        self.click("scan", 0.2, 0.2, 0.2)
        wait_for(lambda: progress_says("nothing stands at (0.200, 0.200, 0.200) m"))
        self.click("scan", 0.0, 0.0, 0.04)
        wait_for(lambda: progress_says("the object as clicked: "))
        answer = self.call("finish")
        self.assertTrue(answer.success, answer.message)
        self.assertIn("written to " + OUTPUT, answer.message)
        self.assertTrue(os.path.exists(OUTPUT + "/object.yaml"))
        self.assertTrue(self.call("discard").success)
        wait_for(lambda: views() == 0)  # the text is sent every two seconds

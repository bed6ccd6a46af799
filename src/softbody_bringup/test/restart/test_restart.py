"""Each of `nodes` that ends is started again, whatever ended it, and the graph tracks again without help."""
import signal
import unittest

import rospy
from softbody_msgs.msg import MeshState, TrackingStatus

from processes import kill, wait_for_another
from recorder import Recorder


class Restart(unittest.TestCase):
    def setUp(self):
        self.recorder = Recorder(softbody__surface__state=MeshState, softbody__status=TrackingStatus)
        self.expect_tracking_after(rospy.Time())

    def expect_tracking_after(self, moment):
        self.recorder.first("softbody/surface/state", lambda state: state.header.stamp > moment,
                            f"a state of an image after {moment.to_sec():.3f}")
        self.recorder.first("softbody/status", lambda s: s.header.stamp > moment and s.state == TrackingStatus.TRACKING,
                            "TRACKING")

    def expect_return(self, node, number):
        process = kill(node, number)
        moment = rospy.Time.now()
        wait_for_another(node, process)
        self.expect_tracking_after(moment)
        print(f"{node}: tracking again {(rospy.Time.now() - moment).to_sec():.2f} s after signal {number}")

    def test_every_node_comes_back(self):
        for node in rospy.get_param("~nodes"):
            for number in (signal.SIGINT, signal.SIGKILL):
                self.expect_return(node, number)

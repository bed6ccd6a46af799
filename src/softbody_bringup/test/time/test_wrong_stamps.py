#!/usr/bin/env python3
"""One image in twenty is stamped two seconds ahead: it is dropped, and a cut stays."""
import os
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, Vector3
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState
from softbody_msgs.srv import CutBody

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "shared"))
from recorder import Recorder  # pylint: disable=wrong-import-position

FRAMES = 100
LATEST_S = 1.0  # a stamp that far ahead of the clock is a wrong one


class WrongStamps(unittest.TestCase):
    def test_a_cut_stays(self):
        recorder = Recorder(softbody__surface__state=MeshState, rosout=Log)
        states = recorder.messages["softbody/surface/state"]
        recorder.wait_for("softbody/surface/state", 20)
        rospy.wait_for_service("/softbody/surface/cut", 30)
        answer = rospy.ServiceProxy("/softbody/surface/cut", CutBody)(point=Point(), normal=Vector3(1, 0, 0))
        self.assertTrue(answer.success, answer.message)
        recorder.wait(lambda _: states[-1].revision == answer.revision, "a state of the cut")
        first = len(states)
        recorder.wait(lambda _: len(states) >= first + FRAMES, f"{FRAMES} states after the cut")
        self.assertEqual({state.revision for state in states[first:]}, {answer.revision})
        now = rospy.Time.now().to_sec()
        self.assertLess(max(state.header.stamp.to_sec() for state in states), now + LATEST_S)
        recorder.wait_for_log("/softbody/camera_ingest", "odd stamp")


if __name__ == "__main__":
    rospy.init_node("test_wrong_stamps")
    rostest.rosrun("softbody_bringup", "test_wrong_stamps", WrongStamps, sys.argv)

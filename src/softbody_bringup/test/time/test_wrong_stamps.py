"""One image in twenty is stamped two seconds ahead: it is dropped, and a cut stays."""
import unittest

import rospy
from geometry_msgs.msg import Point, Vector3
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState
from softbody_msgs.srv import CutBody

from recorder import Recorder

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

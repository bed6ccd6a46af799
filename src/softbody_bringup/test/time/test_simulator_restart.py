"""A simulator that is killed and started again before a live camera: the status tells of it, and states come back."""
import os
import signal
import unittest
import xmlrpc.client

import rospy
from softbody_msgs.msg import MeshState, TetTopology, TrackingStatus

from recorder import Recorder

SIMULATOR = "/softbody/simulator"
FRAMES = 10


def process_of(node):
    uri = rospy.get_master().lookupNode(node)[2]
    return xmlrpc.client.ServerProxy(uri).getPid("/test")[2]


class SimulatorRestart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__state=MeshState, softbody__volume__topology=TetTopology,
                                softbody__surface__state=MeshState, softbody__status=TrackingStatus)

    def count(self, name):
        return len(self.recorder.messages[name])

    def wait_for_more(self, name, count=FRAMES):
        before = self.count(name)
        self.recorder.wait(lambda seen: len(seen[name]) >= before + count, f"{count} more messages on {name}")

    def test_states_come_back(self):
        self.wait_for_more("softbody/surface/state")
        for _ in range(2):
            topologies = self.count("softbody/volume/topology")
            os.kill(process_of(SIMULATOR), signal.SIGKILL)
            self.wait_for_silence()
            before = self.count("softbody/status")
            said = self.recorder.first("softbody/status", lambda s: "no state from the simulator" in s.reason,
                                       "a status that tells of it", since=before)
            self.assertEqual(said.state, TrackingStatus.DEGRADED)
            self.recorder.wait(lambda seen: len(seen["softbody/volume/topology"]) > topologies, "the new simulator")
            self.wait_for_more("softbody/volume/state", 1)
            before = self.count("softbody/status")
            self.wait_for_more("softbody/surface/state")
            self.recorder.first("softbody/status", lambda status: status.state == TrackingStatus.TRACKING, "TRACKING",
                                since=before)

    def wait_for_silence(self):
        states = -1
        while states != self.count("softbody/volume/state"):
            states = self.count("softbody/volume/state")
            self.wait_for_more("softbody/status", 3)

"""The whole graph gets another object without a restart; nodes that are killed come back with it; the first one is tracked
again when it comes back."""
import signal
import unittest

import rospkg
import rospy
import softbody
from softbody_msgs.msg import MeshState, MeshTopology, TetTopology, TrackingStatus

from processes import kill, wait_for_another
from recorder import Recorder

CONFIG = rospkg.RosPack().get_path("softbody_bringup") + "/config"
SPONGE, DOLL = f"{CONFIG}/sponge.yaml", f"{CONFIG}/doll.yaml"
VERTICES = {SPONGE: 522, DOLL: 18650}
NODES = ("/softbody/simulator", "/softbody/surface", "/softbody/feature_tracker")


class LoadObjectLive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__surface__topology=MeshTopology, softbody__surface__state=MeshState,
                                softbody__volume__topology=TetTopology, softbody__status=TrackingStatus)
        cls.body = softbody.Body(service_timeout_s=120)

    def expect_tracking(self, path, revision):
        """The camera shows the sponge."""
        moment = rospy.Time.now()
        self.recorder.first("softbody/status", lambda s: s.header.stamp > moment and s.state == TrackingStatus.TRACKING,
                            f"TRACKING of {path}")
        self.recorder.first("softbody/surface/state", lambda s: s.header.stamp > moment and s.revision >= revision
                            and len(s.vertices) == VERTICES[path], f"a state of {path}")

    def expect_topologies(self, path, revision):
        """From now on there are topologies of this object, of one revision or later."""
        before = {name: len(self.recorder.messages[name]) for name in ("softbody/surface/topology",
                                                                       "softbody/volume/topology")}
        for name, count in before.items():
            self.recorder.wait(lambda seen, name=name, count=count: any(
                topology.revision >= revision for topology in seen[name][count:]), f"revision {revision} on {name}")
        newest = self.recorder.messages["softbody/surface/topology"][-1]
        self.assertEqual(len(newest.rest_vertices), VERTICES[path])
        self.assertEqual([rospy.get_param(f"{node}/object") for node in NODES], [path] * 3)

    def test_another_object_and_back(self):
        self.expect_tracking(SPONGE, 0)
        revision = self.body.load_object(DOLL)
        self.expect_topologies(DOLL, revision)
        for node in NODES:
            wait_for_another(node, kill(node, signal.SIGKILL))
            self.expect_topologies(DOLL, revision)
        again = self.body.load_object(SPONGE)
        self.assertGreater(again, revision)
        self.expect_topologies(SPONGE, again)
        self.expect_tracking(SPONGE, again)
        for state in list(self.recorder.messages["softbody/surface/state"]):
            if state.revision in (revision, again):
                self.assertEqual(len(state.vertices), VERTICES[DOLL if state.revision == revision else SPONGE])

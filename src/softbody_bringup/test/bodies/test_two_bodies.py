"""Two bodies pass each other before one camera. Each has its own graph, and each follows its own body."""
import unittest

import numpy as np
import rospy
from softbody_msgs.msg import MeshState, TrackingStatus

from poses import array
from recorder import Recorder

MAX_MEAN_M = 0.004  # the bodies are 200 mm long, and lie 230 mm beside each other at the start


def errors(states, truths):
    """Mean error [m] of each state whose truth came."""
    exact = {truth.header.stamp: array(truth.vertices) for truth in truths}
    return [np.linalg.norm(array(state.vertices) - exact[state.header.stamp], axis=1).mean()
            for state in states if state.header.stamp in exact]


class TwoBodies(unittest.TestCase):
    def test_each_graph_follows_its_own_body(self):
        recorder = Recorder(first__surface__state=MeshState, second__surface__state=MeshState,
                            first__status=TrackingStatus, second__status=TrackingStatus,
                            ground_truth__surface__state=MeshState, ground_truth__second__surface__state=MeshState)
        for name in ("first", "second"):
            recorder.wait(lambda seen, name=name: any(status.state == TrackingStatus.TRACKING
                                                      for status in seen[f"{name}/status"]), f"{name} to be tracked")
        count = None
        while count != len(recorder.messages["ground_truth/surface/state"]):  # the camera ends with the scene
            count = len(recorder.messages["ground_truth/surface/state"])
            rospy.sleep(3.0)
        with recorder.changed:
            seen = {name: list(messages) for name, messages in recorder.messages.items()}
        for name, truth in (("first", "ground_truth"), ("second", "ground_truth/second")):
            found = errors(seen[f"{name}/surface/state"], seen[f"{truth}/surface/state"])
            print(f"\n{name}: {len(found)} states, mean {1e3 * np.mean(found):.2f} mm, worst {1e3 * max(found):.2f} mm")
            self.assertGreater(len(found), 10)
            self.assertLess(np.mean(found), MAX_MEAN_M)
            known = rospy.get_param(f"/{name}/feature_tracker/known_surfaces")
            self.assertEqual(known, [{"first": "/second/surface", "second": "/first/surface"}[name]])

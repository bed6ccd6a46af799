"""A virtual gripper takes the sponge at one end, lifts it, sets it down and lets go. The graph holds what the gripper holds,
and only then; the end between the fingers stays where it is in the truth."""
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import WrenchStamped
from softbody_msgs.msg import MeshState, MeshTopology, TrackingStatus
from std_msgs.msg import Bool

from poses import array
from recorder import Recorder

HELD_X_M = 0.05  # rest vertices beyond it are near the fingers
MAX_MEAN_M, MAX_HELD_M = 0.002, 0.004
ANSWER = rospy.Duration(0.5)  # to the gripper, besides the age of states and the time between forces; it is closed for 2.3 s


class Grasp(unittest.TestCase):
    def test_what_is_gripped_is_held_until_it_is_let_go(self):
        recorder = Recorder(softbody__surface__topology=MeshTopology, softbody__surface__state=MeshState,
                            ground_truth__surface__state=MeshState, softbody__status=TrackingStatus,
                            softbody__reaction__gripper=WrenchStamped, gripper__closed=Bool)
        recorder.wait(lambda seen: [m for m in seen["gripper/closed"] if m.data], "a gripper that closes")
        closed = recorder.arrivals["gripper/closed"][-1]
        recorder.wait(lambda seen: not seen["gripper/closed"][-1].data, "a gripper that opens")
        opened = recorder.arrivals["gripper/closed"][-1]
        recorder.wait(lambda seen: seen["softbody/surface/state"][-1].header.stamp > opened + ANSWER, "a state after it")
        with recorder.changed:
            seen = {name: list(messages) for name, messages in recorder.messages.items()}
            ages = [time - state.header.stamp for time, state in zip(recorder.arrivals["softbody/surface/state"],
                                                                     seen["softbody/surface/state"]) if time > closed]

        held = [w.header.stamp for w in seen["softbody/reaction/gripper"]]
        gripped = [stamp for stamp in held if closed < stamp < opened]
        self.assertGreater(len(gripped), 1, "nothing was held")
        delay = ANSWER + max(ages) + max(later - earlier for earlier, later in zip(gripped, gripped[1:]))
        self.assertLess(held[0], closed + delay)
        self.assertGreater(held[0], closed - delay)
        self.assertLess(held[-1], opened + delay)
        self.assertGreater(held[-1], opened - delay)

        end = array(seen["softbody/surface/topology"][0].rest_vertices)[:, 0] > HELD_X_M
        truths = {t.header.stamp: array(t.vertices) for t in seen["ground_truth/surface/state"]}
        errors = {s.header.stamp: np.linalg.norm(array(s.vertices) - truths[s.header.stamp], axis=1)
                  for s in seen["softbody/surface/state"] if s.header.stamp in truths}
        lifted = [error for stamp, error in errors.items() if closed < stamp < opened]
        mean, at_end = np.mean(lifted), np.mean([error[end].mean() for error in lifted])
        last = max(errors)  # the body is simulated on when the scene has ended
        lost = sum(s.state == TrackingStatus.LOST for s in seen["softbody/status"])
        print(f"\ngrasp: mean {1e3 * mean:.2f} mm, held end {1e3 * at_end:.2f} mm, "
              f"afterwards {1e3 * errors[last].mean():.2f} mm, {lost} frames LOST, {len(lifted)} states")
        self.assertGreater(len(lifted), 5)
        self.assertEqual(lost, 0)
        self.assertGreater(last, opened)
        self.assertLess(mean, MAX_MEAN_M)
        self.assertLess(at_end, MAX_HELD_M)
        self.assertLess(errors[last].mean(), MAX_MEAN_M)

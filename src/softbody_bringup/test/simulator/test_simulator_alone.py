"""The simulator under targets made by hand, with no camera."""
import unittest

import numpy as np
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point32, Pose
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState, Target, TetTopology

from hand_made_frames import Frames
from poses import array
from recorder import Recorder

FRAME = "made_by_hand"
TURN_Z_90 = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


class SimulatorAlone(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState, rosout=Log,
                                diagnostics=DiagnosticArray)
        cls.topology = cls.recorder.wait_for("softbody/volume/topology")[-1]
        cls.rest = array(cls.topology.rest_vertices)
        cls.frames = Frames(cls.recorder, FRAME)

    def step(self, targets):
        return self.frames.step(targets=targets)

    def centers(self, rotation, translation):
        """A target for every tet's centre, moved rigidly."""
        targets = []
        for i, tet in enumerate(self.topology.tets):
            center = self.rest[list(tet.vertex_indices)].mean(axis=0)
            targets.append(Target(kind=Target.MANUAL, tet=i, barycentric=[0.25] * 4, weight=1.0,
                                  position=Point32(*(rotation @ center + translation))))
        return targets

    def place(self, **fields):
        return self.frames.step(reset=True, **fields)

    def diagnosis(self, condition, what):
        """The values of the first diagnosis of the simulation that meets a condition on them."""
        def find(seen):
            for message in seen["diagnostics"]:
                for status in message.status:
                    values = {value.key: value.value for value in status.values}
                    if status.name.endswith("simulation") and condition(values):
                        return status, values
            return None
        return self.recorder.wait(find, what)

    def test_refused_targets_of_the_future_do_not_turn_time_back(self):
        self.place()
        bad = self.centers(np.eye(3), np.zeros(3))
        bad[0].tet = len(self.topology.tets)
        self.frames.send(self.frames.stamp + rospy.Duration(100), targets=bad)
        status, _ = self.diagnosis(lambda values: int(values["messages refused"]) > 0, "refused targets in a diagnosis")
        self.assertEqual(status.level, status.WARN)
        # Time that jumped back would have taken the body's place: no state would come.
        self.step(self.centers(np.eye(3), np.zeros(3)))

    def test_targets_with_an_odd_stamp_change_nothing(self):
        self.place()
        last = self.step(self.centers(np.eye(3), np.zeros(3)))
        bad = self.centers(np.eye(3), np.zeros(3))
        bad[0].tet = len(self.topology.tets)
        for targets in ([], bad):
            for odd in (rospy.Time(), rospy.Time(0, 1), self.frames.stamp - rospy.Duration(100),
                        self.frames.stamp + rospy.Duration(100), rospy.Time(4294967295, 999999999)):
                self.frames.send(odd, targets=targets, reset=True)
                # Targets without reset are refused by a simulation that starts again.
                state = self.step(self.centers(np.eye(3), np.zeros(3)))
                np.testing.assert_allclose(array(state.vertices), array(last.vertices), atol=1e-3)
                self.assertEqual(state.revision, last.revision)
        states = self.recorder.messages["softbody/volume/state"]
        self.assertLess(max(state.header.stamp for state in states), self.frames.stamp + rospy.Duration(60))

    def test_diagnostics_tell_how_the_steps_ended(self):
        self.place()
        self.step(self.centers(1.01 * np.eye(3), np.zeros(3)))
        # The step that places the body has no iterations.
        _, values = self.diagnosis(lambda values: int(values["iterations of the last step"]) > 0, "iterations in a diagnosis")
        self.assertGreater(int(values["steps"]), 0)
        # A body turned inside out at once takes more iterations than a step has.
        self.step(self.centers(-np.eye(3), np.zeros(3)))
        status, values = self.diagnosis(lambda values: int(values["steps not converged"]) > 0,
                                        "a step that did not converge in a diagnosis")
        self.assertEqual(status.level, status.WARN)
        self.assertGreater(float(values["last move [mm]"]), 0.0)

    def test_reset_places_the_rest_shape(self):
        pose = Pose()
        pose.position.z = 0.5
        pose.orientation.z = pose.orientation.w = np.sqrt(0.5)
        state = self.place(body_pose=pose)
        expected = self.rest @ TURN_Z_90.T + [0.0, 0.0, 0.5]
        np.testing.assert_allclose(array(state.vertices), expected, atol=1e-5)
        self.assertEqual(state.header.frame_id, FRAME)
        self.assertEqual(state.revision, self.topology.revision)

    def test_follows_rigidly_moved_targets(self):
        self.place()
        translation = np.array([0.02, -0.01, 0.03])
        expected = self.rest + translation
        targets = self.centers(np.eye(3), translation)
        for _ in range(100):
            error = np.abs(array(self.step(targets).vertices) - expected).max()
            if error < 1e-3:
                break
        self.assertLess(error, 1e-3)

    def test_refuses_targets_beyond_the_topology_and_goes_on(self):
        self.place()
        bad = self.centers(np.eye(3), np.zeros(3))
        bad[0].tet = len(self.topology.tets)
        refused = self.frames.send(targets=bad)
        self.recorder.wait_for_log("/softbody/simulator", "targets")
        after = self.step(self.centers(np.eye(3), np.zeros(3)))
        self.assertEqual(len(after.vertices), len(self.rest))
        stamps = [state.header.stamp for state in self.recorder.messages["softbody/volume/state"]]
        self.assertNotIn(refused, stamps)

    def test_inverted_targets_give_finite_vertices(self):
        self.place()
        state = self.step(self.centers(-np.eye(3), np.zeros(3)))
        self.assertTrue(np.isfinite(array(state.vertices)).all())

"""States in another frame than the camera's, a static one of tf: the body is where the truth is, and the knife, which is
tracked in the camera's frame, cuts it there."""
import unittest

import numpy as np
import rospy
import tf2_ros
from softbody_msgs.msg import Cut, MeshState

from poses import array, placed
from recorder import Recorder

FRAME, CAMERA = "rig", "camera_color_optical_frame"
MAX_ERROR_M = 0.005


class OutputFrame(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__surface__state=MeshState, ground_truth__surface__state=MeshState,
                                softbody__cut=Cut)
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)

    def pairs(self, seen):
        """Whole states and truths of the same stamp."""
        truths = {truth.header.stamp: truth for truth in seen["ground_truth/surface/state"]}
        return [(state, truths[state.header.stamp]) for state in seen["softbody/surface/state"]
                if state.header.stamp in truths and state.revision == truths[state.header.stamp].revision == 0]

    def test_1_states_are_where_the_truth_is(self):
        state, truth = self.recorder.wait(self.pairs, "a state with its truth")[0]
        self.assertEqual(state.header.frame_id, FRAME)
        self.assertEqual(truth.header.frame_id, CAMERA)
        transform = self.buffer.lookup_transform(FRAME, CAMERA, rospy.Time(0), rospy.Duration(30)).transform
        expected = placed(transform.translation, transform.rotation, array(truth.vertices))
        errors = np.linalg.norm(array(state.vertices) - expected, axis=1)
        self.assertLess(errors.mean(), MAX_ERROR_M)

    def test_2_the_knife_cuts_there(self):
        """The cut lies at rest where the scene's knife passes: across the body, near its middle."""
        cut = self.recorder.wait_for("softbody/cut")[0]
        patch = array(cut.patch_vertices)
        self.assertLess(np.abs(patch[:, 0] - 0.015).max(), 0.008)
        self.recorder.wait(lambda seen: seen["softbody/surface/state"][-1].revision > 0, "a state of the cut body")

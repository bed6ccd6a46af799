"""A prediction between an edit of the body and the next step: its pins are those of the edited body."""
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import Point, Point32, Pose, Quaternion
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import Cut, MeshState, MotionPlan, PlannedMotion, TetTopology
from softbody_msgs.srv import Pin, Predict

from hand_made_frames import Frames
from poses import array
from recorder import Recorder


class PredictAfterEdit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState)
        cls.cuts = rospy.Publisher("/softbody/cut", Cut, queue_size=1)
        cls.frames = Frames(cls.recorder)
        cls.recorder.wait(lambda _: cls.cuts.get_num_connections() > 0, "a simulator that listens")
        cls.predict = rospy.ServiceProxy("/softbody/simulator/predict", Predict)
        hold = rospy.ServiceProxy("/softbody/simulator/pin", Pin)
        assert hold(name="hand", min=Point32(-1, -1, -1), max=Point32(0, 1, 1)).success
        for frame in range(3):  # the pin acts from the second frame on
            cls.frames.step(reset=frame == 0)

    def edit(self, revision, **fields):
        """@return the topology after it."""
        message = Cut(revision=revision, stroke=1, **fields)
        message.header.stamp = self.frames.stamp
        self.cuts.publish(message)
        return self.recorder.first("softbody/volume/topology", lambda t: t.revision == revision, "an edit")

    def expect_lift(self, topology):
        """The held vertices, with those that the cut has made, move with the pin."""
        up = PlannedMotion(name="hand", times=[0.5], poses=[Pose(Point(0.0, 0.0, 0.04), Quaternion(w=1.0))])
        answer = self.predict(times=[0.5], plans=[MotionPlan(), MotionPlan(motions=[up])])
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.revision, topology.revision)
        still, lifted = (array(state.vertices) for state in answer.states)
        held = array(topology.rest_vertices)[:, 0] <= 0.0
        self.assertEqual(len(still), len(held))
        np.testing.assert_allclose((lifted - still)[held].mean(axis=0), [0.0, 0.0, 0.04], atol=1e-4)

    def test_cut_and_undo(self):
        first = self.recorder.wait_for("softbody/volume/topology")[-1]
        corners = [[-0.05, -1, -1], [-0.05, 1, -1], [-0.05, 1, 1], [-0.05, -1, 1]]
        cut = self.edit(1, kind=Cut.CUT, patch_vertices=[Point32(*corner) for corner in corners],
                        patch_triangles=[MeshTriangle([0, 1, 2]), MeshTriangle([0, 2, 3])])
        self.assertGreater(len(cut.rest_vertices), len(first.rest_vertices))
        self.expect_lift(cut)
        self.frames.step(revision=1)
        undone = self.edit(2, kind=Cut.UNDO)
        self.assertEqual(len(undone.rest_vertices), len(first.rest_vertices))
        self.expect_lift(undone)

"""A prediction between an edit of the body and the next step: its pins are those of the edited body."""
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import Point, Point32, Pose, Quaternion
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import Cut, MeshState, MotionPlan, PlannedMotion, Targets, TetTopology
from softbody_msgs.srv import Pin, Predict

from recorder import Recorder


def array(points):
    return np.array([[p.x, p.y, p.z] for p in points])


class PredictAfterEdit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState)
        cls.targets = rospy.Publisher("/softbody/targets", Targets, queue_size=1)
        cls.cuts = rospy.Publisher("/softbody/cut", Cut, queue_size=1)
        cls.recorder.wait(lambda _: cls.targets.get_num_connections() > 0 and cls.cuts.get_num_connections() > 0,
                          "a simulator that listens")
        cls.predict = rospy.ServiceProxy("/softbody/simulator/predict", Predict)
        hold = rospy.ServiceProxy("/softbody/simulator/pin", Pin)
        assert hold(name="hand", min=Point32(-1, -1, -1), max=Point32(0, 1, 1)).success
        for frame in range(3):  # the pin acts from the second frame on
            cls.step(frame)

    @classmethod
    def step(cls, frame, revision=0):
        stamp = rospy.Time(100 + frame)
        message = Targets(reset=frame == 0, revision=revision, body_pose=Pose(orientation=Quaternion(w=1.0)))
        message.header.stamp, message.header.frame_id = stamp, "world"
        cls.targets.publish(message)
        cls.recorder.wait(lambda seen: any(s.header.stamp == stamp for s in seen["softbody/volume/state"]),
                          "the volume state of a frame")

    def edit(self, revision, **fields):
        """@return the topology after it."""
        message = Cut(revision=revision, stroke=1, **fields)
        message.header.stamp = rospy.Time(102)
        self.cuts.publish(message)
        return self.recorder.wait(
            lambda seen: next((t for t in seen["softbody/volume/topology"] if t.revision == revision), None), "an edit")

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
        self.step(3, revision=1)
        undone = self.edit(2, kind=Cut.UNDO)
        self.assertEqual(len(undone.rest_vertices), len(first.rest_vertices))
        self.expect_lift(undone)

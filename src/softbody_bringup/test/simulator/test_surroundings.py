#!/usr/bin/env python3
"""The simulator among a ground, a finger and a gripper that move with tf, with no camera."""
import os
import sys
import unittest

import numpy as np
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import Point32, Pose, Quaternion, TransformStamped, WrenchStamped
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState, PinRegion, Targets, TetTopology

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "shared"))
from recorder import Recorder  # pylint: disable=wrong-import-position

FRAME = "world"
DENSITY_KG_M3, GRAVITY_M_S2 = 30.0, 9.81
FAR = [0.0, 0.0, 5.0]


def array(points):
    return np.array([[p.x, p.y, p.z] for p in points])


def vector(v):
    return np.array([v.x, v.y, v.z])


class Surroundings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState,
                                softbody__reaction__ground=WrenchStamped, softbody__reaction__finger=WrenchStamped,
                                softbody__reaction__gripper=WrenchStamped, rosout=Log)
        cls.broadcaster = tf2_ros.TransformBroadcaster()
        cls.targets = rospy.Publisher("/softbody/targets", Targets, queue_size=1)
        cls.pins = rospy.Publisher("/softbody/pin", PinRegion, queue_size=1)
        topology = cls.recorder.wait_for("softbody/volume/topology")[-1]
        cls.rest = array(topology.rest_vertices)
        tets = np.array([tet.vertex_indices for tet in topology.tets])
        edges = cls.rest[tets[:, 1:]] - cls.rest[tets[:, :1]]
        cls.weight = DENSITY_KG_M3 * GRAVITY_M_S2 * np.linalg.det(edges).sum() / 6.0
        for publisher in (cls.targets, cls.pins):
            cls.recorder.wait(lambda _: publisher.get_num_connections() > 0, "a simulator that listens")

    def setUp(self):
        self.places = {"finger": FAR, "gripper": FAR, "camera": [0.0, 0.0, 0.0]}
        self.camera_yaw = 0.0
        self.stamp = None
        self.step(reset=True)

    def tearDown(self):
        self.pins.publish(PinRegion(name="gripper", release=True))

    def broadcast(self, stamp):
        transforms = []
        for frame, place in self.places.items():
            transform = TransformStamped()
            transform.header.stamp, transform.header.frame_id, transform.child_frame_id = stamp, FRAME, frame
            yaw = self.camera_yaw if frame == "camera" else 0.0
            transform.transform.rotation.z, transform.transform.rotation.w = np.sin(0.5 * yaw), np.cos(0.5 * yaw)
            translation = transform.transform.translation
            translation.x, translation.y, translation.z = place
            transforms.append(transform)
        self.broadcaster.sendTransform(transforms)

    def step(self, reset=False, frame=FRAME):
        """One frame of 1/30 s. @return its state, and the messages of reactions."""
        now = rospy.Time.now()
        self.stamp = now if self.stamp is None else max(now, self.stamp + rospy.Duration(nsecs=33333333))
        self.broadcast(self.stamp)
        rospy.sleep(0.02)  # tf arrives on a way of its own
        message = Targets(reset=reset, body_pose=Pose(orientation=Quaternion(w=1.0)))
        message.header.stamp, message.header.frame_id = self.stamp, frame
        self.targets.publish(message)
        return self.recorder.wait(
            lambda seen: next((s for s in seen["softbody/volume/state"] if s.header.stamp == self.stamp), None),
            "the volume state of a frame")

    def reaction(self, name):
        """Of the last step."""
        return self.recorder.wait(
            lambda seen: next((w for w in reversed(seen[f"softbody/reaction/{name}"])
                               if w.header.stamp == self.stamp), None), f"the reaction on {name}")

    def grip(self, frame):
        region = PinRegion(name="gripper")
        region.header.frame_id = frame
        region.min, region.max = Point32(-1.0, -1.0, -1.0), Point32(self.rest[:, 0].min() + 0.03, 1.0, 1.0)
        self.pins.publish(region)
        rospy.sleep(0.2)
        return self.rest[:, 0] < self.rest[:, 0].min() + 0.03

    def test_ground_carries_the_weight(self):
        for _ in range(120):
            self.step()
        wrench = self.reaction("ground")
        self.assertEqual(wrench.header.frame_id, FRAME)
        np.testing.assert_allclose(vector(wrench.wrench.force), [0.0, 0.0, -self.weight], atol=0.02 * self.weight)

    def test_gripper_takes_the_body_along_and_carries_it(self):
        held = self.grip("gripper")
        before = array(self.step().vertices)
        for height in np.linspace(0.0, 0.5, 21)[1:]:
            self.places["gripper"] = np.add(FAR, [0.0, 0.0, height])
            state = self.step()
        for _ in range(100):
            state = self.step()
        vertices = array(state.vertices)
        np.testing.assert_allclose(vertices[held], before[held] + [0.0, 0.0, 0.5], atol=1e-4)
        wrench = self.reaction("gripper")
        self.assertEqual(wrench.header.frame_id, "gripper")
        np.testing.assert_allclose(vector(wrench.wrench.force), [0.0, 0.0, -self.weight], atol=0.02 * self.weight)
        # About the gripper's origin: the moment of the weight at the centre of mass, near enough the mean.
        arm = vertices.mean(axis=0) - self.places["gripper"]
        np.testing.assert_allclose(vector(wrench.wrench.torque), np.cross(arm, [0.0, 0.0, -self.weight]),
                                   atol=0.1 * self.weight * np.linalg.norm(arm[:2]) + 1e-3)

    def test_what_stands_in_the_world_stands_still_for_a_moving_camera(self):
        self.step(reset=True, frame="camera")
        held = self.grip(FRAME)
        self.places["finger"] = [0.0, 0.0, self.rest[:, 2].max() + 0.003]  # over the ground, in the body by 12 mm
        for k in range(1, 31):
            self.camera_yaw, self.places["camera"] = 0.02 * k, [0.01 * k, -0.005 * k, 0.0]
            state = self.step(frame="camera")
        self.assertEqual(state.header.frame_id, "camera")
        c, s = np.cos(self.camera_yaw), np.sin(self.camera_yaw)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        vertices = array(state.vertices) @ turn.T + self.places["camera"]
        np.testing.assert_allclose(vertices[held], self.rest[held], atol=1e-4)
        self.assertGreater(np.linalg.norm(vertices - self.places["finger"], axis=1).min(), 0.013)
        wrench = self.reaction("finger")
        self.assertEqual(wrench.header.frame_id, "finger")
        self.assertGreater(wrench.wrench.force.z, 0.0)

    def test_a_pin_that_is_not_there_is_told(self):
        self.pins.publish(PinRegion(name="griper", release=True))
        self.recorder.wait_for_log("/softbody/simulator", "'griper'")

    def test_finger_dents_the_body_and_feels_it(self):
        self.grip("")  # held where it is
        top = self.rest[:, 2].max()
        for depth in np.linspace(-0.02, 0.012, 17):
            self.places["finger"] = [0.0, 0.0, top + 0.015 - depth]
            state = self.step()
        wrench = self.reaction("finger")
        self.assertEqual(wrench.header.frame_id, "finger")
        self.assertGreater(wrench.wrench.force.z, 0.0)
        near = np.linalg.norm(array(state.vertices) - self.places["finger"], axis=1)
        self.assertGreater(near.min(), 0.013)

    def test_goes_on_without_images_and_says_so(self):
        self.step()
        last = self.stamp
        later = self.recorder.wait(
            lambda seen: [s for s in seen["softbody/volume/state"] if s.header.stamp > last + rospy.Duration(0.5)],
            "states without targets")[0]
        self.assertLess(later.observed, later.header.stamp)
        self.assertEqual(later.header.frame_id, FRAME)


if __name__ == "__main__":
    rospy.init_node("test_surroundings")
    rostest.rosrun("softbody_bringup", "test_surroundings", Surroundings, sys.argv)

"""A body is cut before the camera: every image is answered by one state of the volume and one of the surface."""
import os
import subprocess
import tempfile
import time
import unittest

import rosbag
import rospy
from sensor_msgs.msg import CameraInfo, Image
from softbody_msgs.msg import Cut, MeshState, MeshTopology, StageTiming, TetTopology

from recorder import Recorder

TYPES = {"/camera/color/image_raw": Image, "/camera/color/camera_info": CameraInfo,
         "/camera/aligned_depth_to_color/image_raw": Image, "/camera/aligned_depth_to_color/camera_info": CameraInfo}
STATES = ("softbody/volume/state", "softbody/surface/state")


def record_scene():
    """Frames of the scene from before the blade comes until it is through: messages by topic, in order."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cut.bag")
        subprocess.run(["rosrun", "softbody_bringup", "virtual_camera", "--scene", "cut", "--rate", "15",
                        "--duration", "3.2", "--output", path], check=True)
        frames = {}
        with rosbag.Bag(path) as bag:
            for topic, message, _ in bag.read_messages(TYPES):
                frames.setdefault(message.header.stamp, {})[topic] = message
    return [frames[stamp] for stamp in sorted(frames) if len(frames[stamp]) == len(TYPES)]


class CutStream(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState,
                                softbody__surface__topology=MeshTopology, softbody__surface__state=MeshState,
                                softbody__timing=StageTiming, softbody__cut=Cut)
        cls.publishers = {topic: rospy.Publisher(topic, kind, queue_size=2) for topic, kind in TYPES.items()}
        cls.frames = record_scene()

    def send(self, frame, stamp):
        for topic, message in frame.items():
            message.header.stamp = stamp
            self.publishers[topic].publish(message)

    def stamps(self, name):
        return [state.header.stamp for state in self.recorder.messages[name]]

    def wait_until_the_graph_answers(self):
        """The first image again and again: nodes that come up miss some. @return when it was answered."""
        first = self.frames[0]["/camera/color/image_raw"].header.stamp
        for k in range(600):
            stamp = first + rospy.Duration(k / 15.0)
            self.send(self.frames[0], stamp)
            time.sleep(0.2)
            if self.recorder.messages[STATES[1]]:
                return stamp
        self.fail("no image is answered")

    def expect_answer(self, stamp):
        """Of the tool's tracker too: its blade then comes before the next image."""
        self.recorder.wait(
            lambda seen: all(any(state.header.stamp == stamp for state in seen[name]) for name in STATES) and any(
                t.header.stamp == stamp and t.node == "tool_tracker" for t in seen["softbody/timing"]),
            f"states of {stamp.to_sec():.3f} and the tool's timing")

    def test_no_image_is_without_its_states(self):
        stamp = self.wait_until_the_graph_answers()
        sent = []
        for frame in self.frames:
            stamp += rospy.Duration(1.0 / 15.0)
            self.send(frame, stamp)
            self.expect_answer(stamp)
            sent.append(stamp)
        for name in STATES:
            states = [state for state in self.recorder.messages[name] if state.header.stamp >= sent[0]]
            self.assertEqual([state.header.stamp for state in states], sent, name)
            revisions = [state.revision for state in states]
            self.assertEqual(revisions, sorted(revisions), name)
            self.assertGreaterEqual(revisions[-1], 2, "the blade has not cut")
        for kind in ("volume", "surface"):
            sizes = {t.revision: len(t.rest_vertices) for t in self.recorder.messages[f"softbody/{kind}/topology"]}
            for state in self.recorder.messages[f"softbody/{kind}/state"]:
                self.assertEqual(len(state.vertices), sizes[state.revision])
        last = self.recorder.messages["softbody/surface/topology"][-1]
        self.assertEqual(1 + max(last.triangle_bodies), 2)

"""Bags that are split, that begin in their middle, that pause, and whose time lies an hour ahead: one graph tracks all."""
import os
import subprocess
import tempfile
import time
import unittest

import rosbag
import rospy
from softbody_msgs.msg import MeshState, TrackingStatus
from std_srvs.srv import SetBool

from recorder import Recorder

FIRST, LAST = rospy.Time(1_600_000_000), rospy.Time(1_600_000_001, 200_000_000)  # of the bag, without its last frames
HOUR = rospy.Duration(3600)


def moved(message, by):
    for stamped in getattr(message, "transforms", [message]):
        stamped.header.stamp += by
    return message


class Playback(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.recorder = Recorder(softbody__surface__state=MeshState, softbody__status=TrackingStatus)
        cls.bag = rospy.get_param("~bag")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def copy(self, name, begin=0.0, end=2.0, by=rospy.Duration(0)):
        """A part of the bag, with other stamps."""
        path = os.path.join(self.folder.name, name)
        with rosbag.Bag(self.bag) as source, rosbag.Bag(path, "w") as target:
            for topic, message, stamp in source.read_messages():
                if begin <= (stamp - FIRST).to_sec() < end:
                    target.write(topic, moved(message, by), stamp + by)
        return path

    @staticmethod
    def play(*arguments, rate=0.7):
        return subprocess.Popen(["rosrun", "rosbag", "play", "--clock", "--hz=200", "--quiet", f"--rate={rate}",
                                 "--wait-for-subscribers", "--topics", "/camera/color/image_raw", "/camera/color/camera_info",
                                 "/camera/aligned_depth_to_color/image_raw", "/camera/aligned_depth_to_color/camera_info",
                                 "--bags", *arguments, "__name:=player"], stdin=subprocess.DEVNULL)

    def mark(self):
        """How many messages have come, when no more come."""
        counts = None
        while counts != (counts := {name: len(messages) for name, messages in self.recorder.messages.items()}):
            time.sleep(0.3)
        return counts

    def stamps_since(self, before):
        states = "softbody/surface/state"
        return [state.header.stamp for state in self.recorder.messages[states][before[states]:]]

    def expect_tracking(self, before, begin, end):
        """Messages since a mark: TRACKING and a state at the end, and nothing from elsewhere in time."""
        self.recorder.wait(lambda seen: any(status.header.stamp >= end and status.state == TrackingStatus.TRACKING
                                            for status in seen["softbody/status"][before["softbody/status"]:]), "TRACKING")
        states = self.recorder.wait(lambda _: self.stamps_since(before), "states")
        self.assertGreaterEqual(min(states), begin)
        self.assertEqual(states, sorted(set(states)))

    def test_1_split_bags_from_their_middle(self):
        parts = self.copy("a.bag", end=0.8), self.copy("b.bag", begin=0.8)
        before = self.mark()
        player = self.play(*parts, "--start=0.5")
        self.expect_tracking(before, FIRST + rospy.Duration(0.5), LAST)
        self.assertEqual(player.wait(), 0)

    def test_2_a_pause(self):
        before = self.mark()
        player = self.play(self.bag, rate=0.2)  # the pause comes before the end, on a busy machine, too
        rospy.wait_for_service("/player/pause_playback", 60.0)
        pause = rospy.ServiceProxy("/player/pause_playback", SetBool)
        self.recorder.wait(lambda seen: len(seen["softbody/status"]) > before["softbody/status"] + 2, "frames")
        pause(True)
        time.sleep(1.0)
        paused = self.mark()
        pause(False)
        self.expect_tracking(paused, FIRST, LAST)
        self.assertEqual(player.wait(), 0)

    def test_3_time_jumps_ahead_and_back(self):
        for by in (HOUR, rospy.Duration(0)):
            bag = self.copy("moved.bag", begin=0.7, by=by)
            before = self.mark()
            player = self.play(bag)
            self.expect_tracking(before, FIRST + by, LAST + by)
            self.assertEqual(player.wait(), 0)

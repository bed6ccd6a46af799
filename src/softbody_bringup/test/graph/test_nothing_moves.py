"""What is missing at the start is said, also in a log that goes through a pipe or into a file, while the nodes go on; if
nothing comes at all, within five seconds of the node's own time."""
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest

import rospkg
import rospy

from hand_made_camera import TOPICS, Camera
from recorder import PATIENCE_S

OBJECT = rospkg.RosPack().get_path("softbody_bringup") + "/config/sponge.yaml"
INGEST = ["rosrun", "softbody_tracking", "camera_ingest"]
LONGEST_S = 5  # from the start of a node to its sentence


class Program:
    """A program whose output goes into a file, or through a pipe into a file."""

    def __init__(self, command, through_pipe=True):
        self.log = tempfile.NamedTemporaryFile("r", suffix=".log")
        out = open(self.log.name, "w", encoding="utf-8")
        self.pipe = subprocess.Popen(["cat"], stdin=subprocess.PIPE, stdout=out) if through_pipe else None
        self.program = subprocess.Popen(command, stdout=self.pipe.stdin if through_pipe else out,
                                        stderr=subprocess.STDOUT, start_new_session=True)
        out.close()
        if through_pipe:
            self.pipe.stdin.close()

    def wait_for(self, pattern):
        """The match of what the log says, while the program runs."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            with open(self.log.name, encoding="utf-8") as log:
                text = log.read()
            match = re.search(pattern, text)
            if match:
                assert self.program.poll() is None, text
                return match
            assert time.monotonic() < deadline, f"no '{pattern}' in: {text}"
            time.sleep(0.1)

    def end(self):
        os.killpg(self.program.pid, signal.SIGINT)
        self.program.wait(PATIENCE_S)
        if self.pipe:
            self.pipe.wait(PATIENCE_S)
        self.log.close()


def track(*arguments):
    return ["roslaunch", "softbody_bringup", "track.launch", "respawn:=false",
            *(() if any(a.startswith("object:=") for a in arguments) else (f"object:={OBJECT}",)), *arguments]


class NothingMoves(unittest.TestCase):
    def expect(self, command, pattern, through_pipe=True):
        program = Program(command, through_pipe)
        try:
            return program.wait_for(pattern)
        finally:
            program.end()

    def expect_soon(self, command, words, through_pipe=True):
        """A sentence of camera_ingest, which says how long it has waited."""
        said = self.expect(command, r"(?:waiting for the first frame|no frame) for (\d+) s: .*" + words, through_pipe)
        self.assertLessEqual(int(said.group(1)), LONGEST_S)

    def with_camera(self, command, words, **state):
        camera = Camera(**state)
        try:
            self.expect(command, words)
        finally:
            camera.stop()

    def test_nobody_publishes(self):
        words = re.escape(f"{TOPICS['color']} (nobody publishes it)")
        for through_pipe in (True, False):
            for arguments in ((), ("nodelets:=true",)):
                self.expect_soon(track(*arguments), words, through_pipe)

    def test_streams_that_are_missing(self):
        for stream in ("depth", "info"):
            self.with_camera(INGEST, rf"no usable message on {TOPICS[stream]} \(", copies={stream: 0})

    def test_stamps_that_do_not_match(self):
        self.with_camera(INGEST, f"stamps of {TOPICS['color']} and {TOPICS['depth']} differ by", apart_s=100.0)

    def test_a_clock_that_is_silent(self):
        rospy.set_param("/use_sim_time", True)
        try:
            self.expect_soon(INGEST, "use_sim_time is set, but /clock is silent")
        finally:
            rospy.set_param("/use_sim_time", False)

    def test_a_clock_that_differs(self):
        self.with_camera(INGEST, "stamps are 2.* s ahead of this machine's clock", late_by_s=-20.0)

    def test_an_object_that_cannot_be_loaded(self):
        self.expect(track("object:=/nowhere/sponge.yaml"), "/nowhere/sponge.yaml: .*")

    def test_a_body_that_is_not_in_view_and_tf_that_is_missing(self):
        camera = Camera()
        try:
            self.expect(track(), "not tracking: the body was not found: .+")
            self.expect(track("output_frame:=nowhere"), "tf does not say where .* is in output_frame nowhere")
        finally:
            camera.stop()

    def test_a_graph_without_camera_ingest(self):
        self.expect(track("images:=/elsewhere"), "nobody publishes /elsewhere/rgb/image_rect_color")

"""scripts/measure_live leaves no process behind when it is stopped, and says what is wrong with a short bag."""
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest
import uuid

import rosbag
import rospkg

ROOT = pathlib.Path(rospkg.RosPack().get_path("softbody_bringup")).resolve().parents[1]
PATIENCE_S = 120.0
MARK = "MEASURE_LIVE_TEST"  # the variable by which the processes of a measurement are known


def command_lines(mark):
    """By id, of the processes that a measurement has started."""
    lines = {}
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/environ", "rb") as environment, open(f"/proc/{entry}/cmdline", "rb") as line:
                if f"{MARK}={mark}".encode() in environment.read().split(b"\0"):
                    lines[int(entry)] = line.read().decode(errors="replace")
        except OSError:
            continue  # it has ended, or belongs to somebody else
    return lines


class MeasureLive(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.mark = pathlib.Path(folder.name), str(uuid.uuid4())

    def start(self, *arguments):
        process = subprocess.Popen([ROOT / "scripts/measure_live", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True, env=dict(os.environ, **{MARK: self.mark}, ROS_LOG_DIR=str(self.folder)))
        self.addCleanup(process.kill)
        return process

    def wait_for(self, words, process):
        """Until a process of the measurement has these words in its command line."""
        deadline = time.monotonic() + PATIENCE_S
        while not any(words in line for line in command_lines(self.mark).values()):
            self.assertIsNone(process.poll(), "measure_live has ended")
            self.assertLess(time.monotonic(), deadline, words)
            time.sleep(0.02)

    def expect_nothing_left(self):
        self.assertEqual(command_lines(self.mark), {})

    def expect_stopped(self, number, words):
        process = self.start("still")
        self.wait_for(words, process)
        process.send_signal(number)
        _, said = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 128 + number, said)
        self.assertIn(f"stopped by {number.name}", said)
        self.expect_nothing_left()

    def test_stopped_while_the_launch_starts(self):
        self.expect_stopped(signal.SIGTERM, "roslaunch")

    def test_stopped_while_the_nodes_start(self):
        self.expect_stopped(signal.SIGINT, "__name:=virtual_camera")

    def test_stopped_when_all_nodes_run(self):
        self.expect_stopped(signal.SIGHUP, "__name:=surface")

    def test_roslaunch_that_leaves_its_nodes(self):
        """As it does when a signal reaches it between the start of a node and its note of it."""
        process = self.start("still")
        self.wait_for("__name:=surface", process)
        launch, = (pid for pid, line in command_lines(self.mark).items() if "roslaunch" in line and "still" in line)
        os.kill(launch, signal.SIGKILL)
        _, said = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 1, said)
        self.assertIn("the launch ended", said)
        self.expect_nothing_left()

    def test_a_bag_that_is_shorter_than_the_warm_up(self):
        short = self.folder / "short.bag"
        with rosbag.Bag(str(ROOT / "rosbags/bend_small.bag")) as whole, rosbag.Bag(str(short), "w") as bag:
            begin = whole.get_start_time()
            for topic, message, stamp in whole.read_messages():
                if stamp.to_sec() < begin + 1.0:
                    bag.write(topic, message, stamp)
        process = self.start("--bag", short, "--object", ROOT / "config/sponge.yaml")
        _, said = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 1, said)
        self.assertIn("too short", said)
        self.assertNotIn("Traceback", said)
        self.expect_nothing_left()

"""The master ends and another one starts: what is connected goes on, no node ends, and a new launch works as before."""
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import time
import unittest

import rosgraph

FRAMES = 10
PATIENCE_S = 120.0


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Master(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.uri = f"http://127.0.0.1:{free_port()}"

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            process.wait(60)

    def start(self, log, *command):
        with open(self.folder / log, "w", encoding="utf-8") as output:
            process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, start_new_session=True,
                                       env=dict(os.environ, ROS_MASTER_URI=self.uri, ROS_LOG_DIR=str(self.folder)))
        self.addCleanup(self.end, process)
        return process

    def wait(self, condition, what):
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            time.sleep(0.1)

    def start_master(self):
        master = self.start("master.log", "rosmaster", "--core", "-p", self.uri.rsplit(":", 1)[1])
        self.wait(lambda: rosgraph.is_master_online(self.uri), "a master")
        return master

    def start_graph(self, log):
        """@return the launch, and the process that writes a line for each state of the surface."""
        graph = self.start(log, "roslaunch", "softbody_bringup", "demo.launch", "scene:=still", "rviz:=false")
        return graph, self.start("states.log", "rostopic", "echo", "-p", "/softbody/surface/state/header/seq")

    def states(self):
        return (self.folder / "states.log").read_text(encoding="utf-8").count("\n")

    def expect_states(self):
        before = self.states()
        self.wait(lambda: self.states() >= before + FRAMES, "states of the surface")

    def test_a_master_that_ends_and_comes_back(self):
        master = self.start_master()
        graph, listener = self.start_graph("first.log")
        self.expect_states()
        os.kill(master.pid, signal.SIGKILL)
        master.wait()
        self.expect_states()
        self.start_master()
        self.expect_states()
        said = (self.folder / "first.log").read_text(encoding="utf-8")
        self.assertNotIn("process has died", said)
        self.end(listener)
        self.end(graph)
        self.start_graph("second.log")
        self.expect_states()

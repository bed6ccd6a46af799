"""The camera, the master and a viewer on one machine, the graph on another; a cable between them delays each packet and
loses one of a hundred. The body is tracked as well as on one machine. If the clocks of the machines differ, that is told."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rospkg

HERE = os.path.dirname(os.path.abspath(__file__))
from network import ADDRESSES, Cable, Machine, why_impossible

PORT = 11311
FRAMES = 20
CONFIG = rospkg.RosPack().get_path("softbody_bringup") + "/config"


class TwoMachines(unittest.TestCase):
    def setUp(self):
        if why := why_impossible():
            print(f"SKIPPED {self.id()}: {why}")
            self.skipTest(why)
        logs = tempfile.TemporaryDirectory()
        self.addCleanup(logs.cleanup)
        self.logs = logs.name
        self.machines = [Machine(), Machine()]
        for machine in self.machines:
            self.addCleanup(machine.close)
        self.addCleanup(Cable(self.machines).close)

    def start(self, which, *words, **options):
        """A command on a machine, with the variables that a lab sets there."""
        environment = {**os.environ, "ROS_MASTER_URI": f"http://{ADDRESSES[0]}:{PORT}", "ROS_IP": ADDRESSES[which],
                       "ROS_LOG_DIR": self.logs}
        process = subprocess.Popen(self.machines[which].command(*words), env=environment, start_new_session=True, **options)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
            process.wait(60)

    def track(self, clock_offset_s):
        """What the machine with the camera saw. Its clock is ahead by the offset."""
        self.start(0, "rosmaster", "--core", "-p", str(PORT))
        self.start(0, "rosrun", "rosout", "rosout")
        time.sleep(2.0)
        self.start(1, "roslaunch", "softbody_bringup", "track.launch", f"object:={CONFIG}/sponge.yaml",
                   "color_transport:=compressed", "depth_transport:=compressedDepth")
        camera = self.start(0, sys.executable, f"{HERE}/camera_machine.py", str(FRAMES), str(clock_offset_s),
                            stdout=subprocess.PIPE, text=True)
        output = camera.communicate(timeout=300)[0]
        self.assertEqual(camera.returncode, 0, output)
        result = json.loads(output.splitlines()[-1])
        print("\ntwo machines:", result)
        self.assertGreaterEqual(result["compared"], FRAMES)
        # A mean distance is at most its RMS, which the states predict (standard_deviation).
        self.assertLess(result["mean_error_m"], result["mean_deviation_m"])
        return result

    def test_the_body_is_tracked(self):
        warnings = self.track(clock_offset_s=0)["warnings"]
        self.assertFalse([warning for warning in warnings if "clock" in warning])

    def test_clocks_that_differ_are_told(self):
        warnings = self.track(clock_offset_s=20)["warnings"]
        self.assertTrue([warning for warning in warnings if "ahead of this machine's clock" in warning], warnings)

#!/usr/bin/env python3
"""Relative paths given to the launch files start at the caller's directory, not at that of the nodes."""
import os
import subprocess
import sys
import tempfile
import unittest

import rostest
import yaml


def roslaunch(directory, *arguments):
    return subprocess.run(["roslaunch", *arguments], cwd=directory, env={**os.environ, "PWD": directory},
                          capture_output=True, text=True, timeout=120, check=True).stdout


class LaunchPaths(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory(prefix="launch paths ")
        self.addCleanup(self.directory.cleanup)

    def test_object(self):
        for launch in ("track.launch", "rig.launch"):
            parameters = yaml.safe_load(roslaunch(self.directory.name, "--dump-params", "softbody_bringup", launch,
                                                  "object:=my/object.yaml"))
            for node in ("simulator", "surface"):
                self.assertEqual(parameters[f"/softbody/{node}/object"], f"{self.directory.name}/my/object.yaml")

    def test_bag(self):
        command = roslaunch(self.directory.name, "--args", "/play", "softbody_bringup", "playback.launch",
                            "bag:=my/recording.bag", "object:=/object.yaml")
        self.assertIn(f"{self.directory.name}/my/recording.bag", command)

    def test_parameters(self):
        with open(f"{self.directory.name}/parameters.yaml", "w", encoding="utf-8") as file:
            file.write("simulator: {iterations: 7}\n")
        parameters = yaml.safe_load(roslaunch(self.directory.name, "--dump-params", "softbody_bringup", "track.launch",
                                              "object:=/object.yaml", "params:=parameters.yaml"))
        self.assertEqual(parameters["/softbody/simulator/iterations"], 7)


if __name__ == "__main__":
    rostest.rosrun("softbody_bringup", "test_launch_paths", LaunchPaths, sys.argv)

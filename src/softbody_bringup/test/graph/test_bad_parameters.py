"""A bad parameter ends a node with exit code 1 and a sentence that names key and value."""
import subprocess
import unittest

import rospkg
import rospy

OBJECT = rospkg.RosPack().get_path("softbody_bringup") + "/config/sponge.yaml"
TOOL = rospkg.RosPack().get_path("softbody_bringup") + "/config/knife.yaml"


class BadParameters(unittest.TestCase):
    def check(self, package, node, parameters, words):
        if rospy.has_param(f"/{node}"):
            rospy.delete_param(f"/{node}")
        command = ["rosrun", package, node, f"__name:={node}"]
        run = subprocess.run(command + [f"_{key}:={value}" for key, value in parameters.items()],
                             capture_output=True, text=True, timeout=120, check=False)
        output = run.stdout + run.stderr
        self.assertEqual(run.returncode, 1, output)
        for word in words:
            self.assertIn(word, output)

    def test_camera_ingest(self):
        self.check("softbody_tracking", "camera_ingest", {"max_depth_m": 0}, ["/camera_ingest/max_depth_m", "0"])

    def test_feature_tracker(self):
        self.check("softbody_tracking", "feature_tracker", {"search": "magic"},
                   ["/feature_tracker/search", "magic", "anywhere"])

    def test_feature_tracker_that_waits_for_masks_for_ever(self):
        self.check("softbody_tracking", "feature_tracker", {"use_mask": "true", "mask_timeout_s": 60},
                   ["/feature_tracker/mask_timeout_s", "60"])

    def test_simulator(self):
        self.check("softbody_sim", "simulator", {"object": OBJECT, "iterations": -3},
                   ["/simulator/iterations", "-3"])

    def test_tool_tracker(self):
        self.check("softbody_tracking", "tool_tracker", {"tool": TOOL, "bridge_time_s": -1},
                   ["/tool_tracker/bridge_time_s", "-1"])

    def test_tool_tracker_with_an_object_for_a_tool(self):
        self.check("softbody_tracking", "tool_tracker", {"tool": OBJECT}, ["sponge.yaml:", "tool", "missing"])

    def test_injector(self):
        self.check("softbody_bringup", "injector", {"drop": 1.5}, ["/injector/drop", "1.5"])

    def test_simulator_without_an_object(self):
        self.check("softbody_sim", "simulator", {}, ["/simulator/object"])

    def test_surface_with_a_missing_object(self):
        self.check("softbody_sim", "surface", {"object": "/nowhere/sponge.yaml"}, ["/nowhere/sponge.yaml"])

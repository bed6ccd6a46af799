"""The action model_server/prepare_model: the folder of the tool, progress, cancel, and clear errors."""
import filecmp
import os
import subprocess
import tempfile
import unittest

import actionlib
import rospkg
import rospy
from actionlib_msgs.msg import GoalStatus
from softbody_msgs.msg import PrepareModelAction, PrepareModelGoal

from goals import send
from recorder import PATIENCE_S

CONFIG = rospkg.RosPack().get_path("softbody_bringup") + "/config"
SPONGE, DOLL = f"{CONFIG}/sponge.obj", f"{CONFIG}/doll.obj"
FILES = ["cage.obj", "object.yaml", "report/models.png", "report/report.md", "tets.vtu", "visual.obj"]
REPORT = "report/report.md"


def untimed(folder):
    """The report without the line with a measured time."""
    with open(f"{folder}/{REPORT}", encoding="utf-8") as file:
        return [line for line in file if "a frame takes" not in line]


def files_of(folder):
    return sorted(os.path.relpath(os.path.join(place, file), folder) for place, _, files in os.walk(folder)
                  for file in files)


class PrepareModel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.output = folder.name, f"{folder.name}/out"
        self.progress = []
        self.client = actionlib.SimpleActionClient("/softbody/model_server/prepare_model", PrepareModelAction)
        self.assertTrue(self.client.wait_for_server(rospy.Duration(PATIENCE_S)))

    def start(self, on_progress=None, **goal):
        def receive(feedback):
            self.progress.append(feedback)
            if on_progress:
                on_progress()

        send(self.client, PrepareModelGoal(**goal), feedback_cb=receive)
        self.assertTrue(self.client.wait_for_result(rospy.Duration(2 * PATIENCE_S)))
        return self.client.get_state(), self.client.get_result()

    def test_the_folder_is_that_of_the_tool(self):
        state, result = self.start(mesh=SPONGE, output=self.output, length=0.4, cage_vertices=150)
        self.assertEqual((state, result.message), (GoalStatus.SUCCEEDED, ""))
        self.assertEqual((result.object, result.verdict), (f"{self.output}/object.yaml", "good"))
        subprocess.run(["rosrun", "softbody_sim", "prepare_model", SPONGE, "--output", f"{self.folder}/tool", "--length", "400mm",
                        "--cage-vertices", "150"], check=True, capture_output=True)
        self.assertEqual(files_of(self.output), FILES)
        exact = [name for name in FILES if name != REPORT]
        same, other, missing = filecmp.cmpfiles(self.output, f"{self.folder}/tool", exact, shallow=False)
        self.assertEqual((sorted(same), other, missing), (exact, [], []))
        self.assertEqual(untimed(self.output), untimed(f"{self.folder}/tool"))
        with open(f"{self.output}/report/report.md", encoding="utf-8") as file:
            self.assertEqual(result.report, file.read())
        shares = [p.share for p in self.progress]
        self.assertEqual(shares, sorted(shares))
        self.assertEqual([p.stage for p in self.progress], sorted(p.stage for p in self.progress))
        self.assertEqual({p.stage for p in self.progress}, {"model", "report"})

    def test_cancel_leaves_the_folder_as_it_was(self):
        state, result = self.start(mesh=SPONGE, output=self.output)
        self.assertEqual(state, GoalStatus.SUCCEEDED)
        before = {name: os.stat(f"{self.output}/{name}").st_mtime_ns for name in FILES}
        self.progress.clear()
        state, result = self.start(self.client.cancel_goal, mesh=DOLL, output=self.output)
        self.assertEqual((state, result.object), (GoalStatus.PREEMPTED, ""))
        self.assertIn(f"{self.output} is as it was", result.message)
        self.assertEqual({name: os.stat(f"{self.output}/{name}").st_mtime_ns for name in files_of(self.output)}, before)
        self.assertEqual(os.listdir(self.folder), ["out"])
        state, result = self.start(mesh=SPONGE, output=self.output)
        self.assertEqual(state, GoalStatus.SUCCEEDED)

    def test_what_is_refused(self):
        good = {"mesh": SPONGE, "output": self.output}
        os.makedirs(f"{self.folder}/foreign")
        with open(f"{self.folder}/foreign/object.yaml", "w", encoding="ascii") as file:
            file.write("object: {visual_mesh: mine.obj}\n")
        for change, words in (({"mesh": "sponge.obj"}, "mesh is 'sponge.obj'; allowed: an absolute path"),
                              ({"output": "out"}, "output is 'out'; allowed: an absolute path"),
                              ({"mesh": "/nowhere.obj"}, "/nowhere.obj"),
                              ({"unit": "furlong"}, "furlong"),
                              ({"unit": "mm", "length": 0.2}, "give only one of unit, length and scale"),
                              ({"length": -1}, "length is -1"), ({"scale": float("nan")}, "scale is nan"),
                              ({"thickness": -0.1}, "thickness is -0.1"), ({"triangles": 3}, "triangles is 3"),
                              ({"cage_vertices": 3}, "cage_vertices is 3"), ({"shell": "biggest"}, "shell is 'biggest'"),
                              ({"shell": "0"}, "shell is '0'"), ({"shell": "101"}, "a number from 1 to 100"),
                              ({"shell": "9" * 30}, "a number from 1 to 100"),
                              ({"output": f"{self.folder}/foreign"}, "was not made by prepare_model")):
            state, result = self.start(**{**good, **change})
            self.assertEqual((state, result.object, result.verdict), (GoalStatus.ABORTED, "", ""), change)
            self.assertIn(words, result.message)
        self.assertEqual(files_of(self.folder), ["foreign/object.yaml"])

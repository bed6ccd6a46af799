"""Relative paths given to the launch files start at the caller's directory, not at that of the nodes; output_frame reaches
all that need it, through every launch file."""
import contextlib
import importlib.machinery
import importlib.util
import os
import re
import subprocess
import tempfile
import unittest
from unittest import mock

import rospkg
import yaml
from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader


LAUNCH = os.path.join(rospkg.RosPack().get_path("softbody_bringup"), "launch")
RVIZ = os.path.join(rospkg.RosPack().get_path("softbody_bringup"), "rviz")
# Launch files with the graph, and what they need.
CAMERAS = [f"cameras/{name}.launch" for name in ("realsense", "azure_kinect", "openni2", "zed")]
GRAPHS = {"track.launch": ["object:=/o.yaml"], "rig.launch": ["object:=/o.yaml"], "demo.launch": [],
          "playback.launch": ["object:=/o.yaml", "bag:=/b.bag"]}
# Arguments, and the parameters that they set.
GIVEN = ((["blade_frame:=tool0"], {"tool_tracker/blade_frame": "tool0"}),
         (["output_frame:=base_link"],
          {"feature_tracker/output_frame": "base_link", "tool_tracker/output_frame": "base_link"}),
         (["known_surfaces:=[/doll/surface, /cup/surface]"],
          {"feature_tracker/known_surfaces": ["/doll/surface", "/cup/surface"]}))

WITHOUT_PARAMETERS = {"rviz", "play", "reset_clock", "camera_optical_frame"}


def program(path):
    """A Python program as a module."""
    loader = importlib.machinery.SourceFileLoader("program", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("program", loader))
    loader.exec_module(module)
    return module


def topics_of(settings):
    """All topics that a configuration of rviz names."""
    for key, value in settings.items() if isinstance(settings, dict) else enumerate(settings):
        if isinstance(value, (dict, list)):
            yield from topics_of(value)
        elif str(key).endswith("Topic"):
            yield value


def run_roslaunch(directory, *arguments, check=True):
    return subprocess.run(["roslaunch", *arguments], cwd=directory, env={**os.environ, "PWD": directory},
                          capture_output=True, text=True, timeout=120, check=check)


def roslaunch(directory, *arguments):
    return run_roslaunch(directory, *arguments).stdout


class LaunchArguments(unittest.TestCase):
    def setUp(self):
        self.directory = self.enterContext(tempfile.TemporaryDirectory(prefix="launch paths "))
        self.enterContext(contextlib.chdir(self.directory))
        self.enterContext(mock.patch.dict(os.environ, PWD=self.directory))

    @staticmethod
    def loaded(launch, *arguments):
        """A launch file as roslaunch reads it in the current folder."""
        config = ROSLaunchConfig()
        XmlLoader().load(f"{LAUNCH}/{launch}", config, argv=list(arguments), verbose=False)
        config.assign_machines()
        return config

    def set_by(self, launch, *arguments):
        """The parameters of a launch file."""
        return {name: parameter.value for name, parameter in self.loaded(launch, *arguments).params.items()}

    def nodes(self, launch, *arguments):
        """The nodes of a launch file by name."""
        return {node.namespace + node.name: node for node in self.loaded(launch, *arguments).nodes}

    def test_object(self):
        for launch in ("track.launch", "rig.launch"):
            parameters = self.set_by(launch, "object:=my/object.yaml")
            for node in ("simulator", "surface"):
                self.assertEqual(parameters[f"/softbody/{node}/object"], f"{self.directory}/my/object.yaml")

    def test_bag(self):
        nodes = self.nodes("playback.launch", "bag:=my/recording.bag", "object:=/object.yaml")
        self.assertIn(f"{self.directory}/my/recording.bag", nodes["/play"].args)

    def test_parameters(self):
        with open(f"{self.directory}/parameters.yaml", "w", encoding="utf-8") as file:
            file.write("simulator: {iterations: 7}\n")
        parameters = self.set_by("track.launch", "object:=/object.yaml", "params:=parameters.yaml")
        self.assertEqual(parameters["/softbody/simulator/iterations"], 7)

    def parameters(self, launch, *arguments):
        return self.set_by(launch, *GRAPHS[launch], "tool:=/t.yaml", *arguments)

    def test_what_is_given_reaches_its_nodes(self):
        for launch in GRAPHS:
            before = self.parameters(launch)
            self.assertFalse([key for key in before if "gripper" in key or key.endswith(("blade_frame", "output_frame"))])
            for given, expected in GIVEN:
                if launch != "demo.launch" or "known_surfaces" not in given[0]:
                    after = self.parameters(launch, *given)
                    self.assertEqual({name: after.get(f"/softbody/{name}") for name in expected}, expected, launch)
                    self.assertFalse([name for name in expected if before.get(f"/softbody/{name}")], launch)

    def test_helpers_of_the_graph(self):
        """Nodes that run only if an argument says so."""
        helpers = {"collision_object", "recorder", "model_server", "pose_marker"}
        wanted = [f"{helper}:=true" for helper in helpers]
        for launch, arguments in GRAPHS.items():
            for asked in ([], wanted):
                names = {node.name for node in self.nodes(launch, *arguments, *asked).values()}
                self.assertEqual(helpers & names, helpers if asked else set(), launch)

    def test_the_gripper_is_a_file_or_a_frame(self):
        for launch in GRAPHS:
            for given, expected in (("my/gripper.yaml", f"{self.directory}/my/gripper.yaml"), ("tool0", "tool0")):
                parameters = self.parameters(launch, f"gripper:={given}")
                named = {key.rsplit("/", 1)[1]: value for key, value in parameters.items() if "gripper" in key}
                self.assertEqual(named, {"gripper": expected}, launch)

    def arguments(self, launch):
        """Names of a launch file's arguments, all of them with a description."""
        listed = roslaunch(self.directory, "--ros-args", f"{LAUNCH}/{launch}")
        self.assertNotIn("undocumented", listed, launch)
        return set(re.findall(r"^\s+(\w+)(?: \(default .*\))?: ", listed, re.MULTILINE))

    def test_no_parameter_of_an_earlier_launch_stays(self):
        """roslaunch removes what the master still knows from a launch before: all of a node that reads parameters."""
        files = {**GRAPHS, "scan.launch": ["output:=/o"], "bodies.launch": ["objects:=/a.yaml /b.yaml"],
                 "faults.launch": [f"faults:={self.directory}/faults.yaml"]}
        with open(f"{self.directory}/faults.yaml", "w", encoding="ascii") as file:
            file.write("drop: 0.1\n")
        helpers = [f"{name}:=true" for name in ("collision_object", "recorder", "model_server", "pose_marker", "aggregator", "rviz",
                                                "nodelets", "publish_camera_tf")]
        for launch, arguments in files.items():
            loaded = self.loaded(launch, *arguments, *helpers, "tool:=/t.yaml")
            nodes = {node.namespace + node.name for node in loaded.nodes}
            kept = {name for name in nodes if name + "/" not in loaded.clear_params}
            self.assertLessEqual({name.rsplit("/", 1)[1] for name in kept}, WITHOUT_PARAMETERS, launch)
            self.assertLess(kept, nodes, launch)

    def test_every_launch_file_has_the_arguments_of_the_graph(self):
        """A recording has no driver whose nodelet manager could be joined."""
        graph = self.arguments("track.launch")
        self.assertIn("gripper", graph)
        for launch in ("rig.launch", *CAMERAS):
            self.assertEqual(graph - self.arguments(launch), set(), launch)
        self.assertEqual(graph - self.arguments("playback.launch"), {"manager"})

    def test_arguments_reach_the_graph_through_the_launch_file_of_a_camera(self):
        for launch in CAMERAS:
            parameters = self.set_by(launch, "object:=/o.yaml", "robot:=arm", "gripper:=tool0",
                                     "color_transport:=compressed")
            self.assertEqual(parameters["/softbody/feature_tracker/robot"], "arm", launch)
            self.assertEqual(parameters["/softbody/simulator/gripper"], "tool0", launch)
            self.assertEqual(parameters["/softbody/camera_ingest/color_transport"], "compressed", launch)

    def test_nodes_run_on_another_machine_and_rviz_here(self):
        with open(f"{self.directory}/lab.launch", "w", encoding="utf-8") as file:
            file.write('<launch><machine name="tracking" address="192.0.2.7" env-loader="/lab/env.sh"/></launch>')
        for nodelets in ("true", "false"):
            places = {}
            for machines in ("none", f"{self.directory}/lab.launch"):
                nodes = self.nodes("track.launch", "object:=/o.yaml", "tool:=/t.yaml", "rviz:=true", "aggregator:=true",
                                   f"nodelets:={nodelets}", f"machines:={machines}")
                places[machines] = {node.name: node.machine.address for node in nodes.values()}
            here, there = places.values()
            self.assertEqual({name for name, address in there.items() if address != "192.0.2.7"}, {"rviz"})
            self.assertEqual(set(here.values()), {"localhost"})

    def test_each_of_several_bodies_knows_the_others(self):
        parameters = self.set_by("bodies.launch", "objects:=a/object.yaml b/a.yaml 2-c.yaml")
        files = {"a": "a/object.yaml", "a_2": "b/a.yaml", "body_2_c": "2-c.yaml"}
        for name, file in files.items():
            self.assertEqual(parameters[f"/{name}/simulator/object"], f"{self.directory}/{file}")
            self.assertEqual(parameters[f"/{name}/feature_tracker/known_surfaces"],
                             [f"/{other}/surface" for other in files if other != name])
        self.assertEqual([key for key in parameters if "camera_ingest" in key and not key.startswith("/a/")], [])

    def test_names_of_several_bodies(self):
        for arguments, words in ((["objects:=a.yaml a.yaml a_2.yaml"], "two objects have one name"),
                                 (["objects:=a.yaml b.yaml", "names:=left"], "names must be as many as objects"),
                                 (["objects:=a.yaml b.yaml", "names:=le-ft right"], "begins with a letter")):
            result = run_roslaunch(self.directory, "--dump-params", "softbody_bringup", "bodies.launch", *arguments,
                                   check=False)
            self.assertIn(words, result.stdout + result.stderr)
            self.assertNotIn("/object: ", result.stdout, arguments)

    def test_the_arguments_of_several_bodies_are_listed(self):
        listed = roslaunch(self.directory, "--ros-args", "softbody_bringup", "bodies.launch")
        self.assertIn("objects: object YAMLs", listed)
        self.assertNotIn("undocumented", listed)

    def rviz(self, launch, *arguments):
        return self.nodes(launch, *GRAPHS[launch], "rviz:=true", *arguments)["/softbody/rviz"].args.split()

    def test_rviz_stands_in_the_output_frame(self):
        for launch in GRAPHS:
            words = self.rviz(launch, "output_frame:=base_link")
            self.assertEqual(words[words.index("-f") + 1], "base_link", launch)
            self.assertEqual(words[words.index("-d") + 1], f"{RVIZ}/upright.rviz", launch)

    def test_or_in_the_cameras(self):
        for launch in ("track.launch", "rig.launch", "playback.launch"):
            words = self.rviz(launch, "camera_frame:=left_optical_frame")
            self.assertEqual(words[words.index("-f") + 1], "left_optical_frame", launch)
            self.assertEqual(words[words.index("-d") + 1], f"{RVIZ}/track.rviz", launch)

    def test_both_views_show_the_same(self):
        shown = []
        for name in ("track.rviz", "upright.rviz"):
            with open(f"{RVIZ}/{name}", encoding="utf-8") as file:
                whole = yaml.safe_load(file)
            manager = whole.pop("Visualization Manager")
            shown.append((whole, manager["Displays"], manager["Tools"]))
            self.assertEqual([panel["Namespace"] for panel in whole["Panels"] if "Softbody" in panel["Class"]], [""])
        self.assertEqual(*shown)

    def test_rviz_of_several_bodies_names_each_namespace(self):
        with open(f"{RVIZ}/track.rviz", encoding="utf-8") as file:
            one = yaml.safe_load(file)
        topics = set(topics_of(one))
        self.assertFalse([topic for topic in topics if topic.startswith("/")])
        bodies_rviz = program(os.path.join(rospkg.RosPack().get_path("softbody_bringup"), "src/bodies_rviz/bodies_rviz"))
        several = bodies_rviz.configured(one, ["left", "right"])
        self.assertEqual({topic for topic in topics_of(several) if topic.startswith("/left/")}, {"/left/" + t for t in topics})
        rest = {topic for topic in topics_of(several) if not topic.startswith("/left/")}
        self.assertTrue(rest and all(topic.startswith("/right/") for topic in rest), rest)
        self.assertEqual([panel["Namespace"] for panel in several["Panels"] if "Namespace" in panel], ["/left"])

    def test_images_show_each_of_several_bodies_as_they_show_one(self):
        def read():
            with open(f"{RVIZ}/track.rviz", encoding="utf-8") as file:
                return yaml.safe_load(file)

        def visibility(configuration):
            return next(display["Visibility"] for display in configuration["Visualization Manager"]["Displays"]
                        if display["Class"] == "rviz/Camera")

        bodies_rviz = program(os.path.join(rospkg.RosPack().get_path("softbody_bringup"), "src/bodies_rviz/bodies_rviz"))
        one, several = read(), bodies_rviz.configured(read(), ["left", "right"])
        groups = {display["Name"]: [part["Name"] for part in display["Displays"]]
                  for display in several["Visualization Manager"]["Displays"] if display["Class"] == "rviz/Group"}
        self.assertEqual(set(groups), {"left", "right"})
        for name, parts in groups.items():
            self.assertIn("Edges on the image", parts)
            self.assertEqual(visibility(several)[name],
                             {"Value": True, **{key: on for key, on in visibility(one).items() if key in parts}})

    def test_rviz_is_in_the_namespace_of_the_graph(self):
        nodes = self.nodes("track.launch", *GRAPHS["track.launch"], "rviz:=true", "namespace:=/left")
        self.assertEqual([name for name in nodes if name.endswith("rviz")], ["/left/rviz"])

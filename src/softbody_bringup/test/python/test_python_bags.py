"""Results of replay in Python and in the files of export: the same numbers as in the messages."""
import os
import subprocess
import tempfile
import unittest

import numpy as np
import rosbag
import rospkg

import softbody

PACKAGES = rospkg.RosPack()
BRINGUP, EXAMPLES = PACKAGES.get_path("softbody_bringup"), PACKAGES.get_path("softbody_python") + "/examples"
SPONGE = f"{BRINGUP}/config/sponge.yaml"


def array(points):
    return np.array([[p.x, p.y, p.z] for p in points], np.float32)


class PythonBags(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="python_bags_")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = scratch.name
        cls.tool("replay", f"{BRINGUP}/rosbags/bend_small.bag", "--object", SPONGE, "--output", "bend.bag")
        cls.tool("virtual_camera", "--scene", "cut", "--duration", 3, "--width", 320, "--height", 240, "--output", "camera.bag")
        cls.tool("replay", "camera.bag", "--object", SPONGE, "--tool", f"{BRINGUP}/config/knife.yaml", "--output", "cut.bag")

    @classmethod
    def tool(cls, name, *arguments):
        cls.run_command("rosrun", "softbody_bringup", name, *arguments)

    @classmethod
    def run_command(cls, *words):
        result = subprocess.run(list(map(str, words)), cwd=cls.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, timeout=200, check=False, env={**os.environ, "MPLBACKEND": "Agg"})
        assert result.returncode == 0, f"{words}: {result.stdout}"
        return result.stdout

    def messages(self, bag, topic):
        with rosbag.Bag(f"{self.folder}/{bag}") as messages:
            return [message for _, message, _ in messages.read_messages(topics=[topic])]

    def test_states_are_the_messages(self):
        for bag in ("bend.bag", "cut.bag"):
            states = list(softbody.read(f"{self.folder}/{bag}"))
            topologies = {message.revision: message for message in self.messages(bag, "/softbody/surface/topology")}
            surfaces, volumes = (self.messages(bag, f"/softbody/{name}/state") for name in ("surface", "volume"))
            self.assertEqual([state.stamp for state in states], [message.header.stamp for message in surfaces])
            for state, surface, volume in zip(states, surfaces, volumes):
                self.assertEqual((state.revision, state.frame), (surface.revision, surface.header.frame_id))
                np.testing.assert_array_equal(state.vertices, array(surface.vertices))
                np.testing.assert_array_equal(state.standard_deviation, np.float32(surface.standard_deviation))
                np.testing.assert_array_equal(state.volume.vertices, array(volume.vertices))
                triangles = [triangle.vertex_indices for triangle in topologies[state.revision].triangles]
                np.testing.assert_array_equal(state.triangles, triangles)

    def test_a_cut_body(self):
        states = list(softbody.read(f"{self.folder}/cut.bag"))
        self.assertEqual((states[0].triangle_pieces.max(), states[-1].triangle_pieces.max()), (0, 1))
        for state in states:
            pieces = state.vertex_pieces[state.triangles]
            np.testing.assert_array_equal(pieces, np.repeat(state.triangle_pieces[:, None], 3, axis=1))
            corners = state.volume.vertices[state.volume.tets]
            volumes = np.linalg.det(corners[:, 1:] - corners[:, :1])
            self.assertGreater(np.mean(volumes > 0), 0.99)

    def test_truth_of_the_virtual_camera(self):
        states = list(softbody.read(f"{BRINGUP}/rosbags/bend_small.bag", namespace="/ground_truth"))
        self.assertEqual(len(states), 45)
        self.assertEqual({state.volume for state in states}, {None})

    def test_export(self):
        for kind, pattern, count in (("ply", "surface_000044.ply", 46), ("obj", "surface_000044.obj", 47),
                                     ("vtk", "volume_000044.vtu", 92), ("gltf", "body.glb", 1)):
            self.tool("export", "bend.bag", "--format", kind, "--output", f"out_{kind}")
            files = os.listdir(f"{self.folder}/out_{kind}")
            self.assertIn(pattern, files)
            self.assertEqual(len(files), count)

    def test_example_centre_and_curvature(self):
        self.run_command("python3", f"{EXAMPLES}/centre_and_curvature.py", "bend.bag", "picture.png")
        with open(f"{self.folder}/picture.png", "rb") as picture:
            self.assertEqual(picture.read(8), b"\x89PNG\r\n\x1a\n")

    def test_examples_are_short(self):
        for name in os.listdir(EXAMPLES):
            with open(f"{EXAMPLES}/{name}", encoding="utf-8") as file:
                self.assertLessEqual(len(file.readlines()), 25, name)

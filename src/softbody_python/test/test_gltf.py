#!/usr/bin/env python3
"""The glTF file, played back at the time of a frame, shows the state of that frame, and no other mesh."""
import json
import pathlib
import struct
import sys
import tempfile
import unittest

import numpy as np
import rostest

import hand_made
import softbody
from softbody.export.gltf_file import Scene
from softbody.export.texture import Texture

TYPES = {5126: "<f4", 5125: "<u4", 5121: "u1"}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
PNG = b"\x89PNG\r\n\x1a\n and so on"


class Glb:
    """A .glb file, with its accessors read and checked against the container."""

    def __init__(self, path):
        content = path.read_bytes()
        magic, version, length, text_length, text_kind = struct.unpack_from("<4sIII4s", content)
        assert (magic, version, length, text_kind) == (b"glTF", 2, len(content), b"JSON")
        self.document = json.loads(content[20:20 + text_length])
        buffer_length, buffer_kind = struct.unpack_from("<I4s", content, 20 + text_length)
        self.buffer = content[28 + text_length:]
        assert buffer_kind == b"BIN\0" and len(self.buffer) == buffer_length
        assert self.document["buffers"] == [{"byteLength": buffer_length}]
        self.accessors = [self._array(accessor) for accessor in self.document["accessors"]]

    def view(self, index):
        view = self.document["bufferViews"][index]
        assert view["byteOffset"] + view["byteLength"] <= len(self.buffer) and view["byteOffset"] % 4 == 0
        return self.buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]

    def _array(self, accessor):
        columns = COLUMNS[accessor["type"]]
        values = np.frombuffer(self.view(accessor["bufferView"]), TYPES[accessor["componentType"]]).reshape(-1, columns)
        assert len(values) == accessor["count"]
        if "min" in accessor:
            assert values.min(axis=0).tolist() == accessor["min"] and values.max(axis=0).tolist() == accessor["max"]
        return values

    def sampled(self, node, path, time):
        """The value of a node's channel at a time, or None. Keys as in glTF 2.0, appendix C."""
        animation = self.document.get("animations", [{"channels": []}])[0]
        for channel in animation["channels"]:
            if channel["target"] == {"node": node, "path": path}:
                sampler = animation["samplers"][channel["sampler"]]
                times = self.accessors[sampler["input"]][:, 0]
                assert (np.diff(times) > 0).all() and times[0] >= 0
                values = self.accessors[sampler["output"]].reshape(len(times), -1)
                if sampler["interpolation"] == "STEP":
                    return values[max(0, np.searchsorted(times, np.float32(time), "right") - 1)]
                return np.array([np.interp(np.float32(time), times, column) for column in values.T])
        return None

    def shown(self, time):
        """The nodes with a mesh that are visible at a time."""
        for index, node in enumerate(self.document["nodes"]):
            if "mesh" in node:
                scale = self.sampled(index, "scale", time)
                scale = node["scale"] if scale is None else scale.tolist()
                assert scale in ([0] * 3, [1] * 3)
                if scale[0] == 1:
                    yield index

    def corners(self, node, time):
        """{material: F x 3 x 3 positions of the triangles' corners} of a node at a time."""
        mesh = self.document["meshes"][self.document["nodes"][node]["mesh"]]
        weights = self.sampled(node, "weights", time)
        result = {}
        for primitive in mesh["primitives"]:
            positions = self.accessors[primitive["attributes"]["POSITION"]].astype(float)
            targets = [self.accessors[target["POSITION"]] for target in primitive.get("targets", [])]
            for weight, target in zip(weights if targets else [], targets):
                positions = positions + weight * target
            indices = self.accessors[primitive["indices"]][:, 0]
            result[self.document["materials"][primitive["material"]]["name"]] = positions[indices].reshape(-1, 3, 3)
        return result


class Gltf(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="gltf_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def export(self, revisions, has_image=False, first=0.0):
        hand_made.write_bag(self.folder / "result.bag", revisions)
        states = list(softbody.read(self.folder / "result.bag"))
        (self.folder / "image").write_bytes(PNG)
        scene = Scene(self.folder, Texture(self.folder / "image") if has_image else None)
        for frame, state in enumerate(states):
            scene.add(first + 0.1 * frame, state)
        scene.finish()
        return states, Glb(self.folder / "body.glb")

    def expect_state(self, glb, time, state):
        """Exactly the mesh of this state is visible, to the precision of the numbers in the file."""
        nodes = list(glb.shown(time))
        self.assertEqual(len(nodes), 1)
        self.assertEqual(glb.document["nodes"][nodes[0]]["extras"]["revision"], state.revision)
        corners = glb.corners(nodes[0], time)
        for material, chosen in (("body", ~state.cut_triangles), ("cut", state.cut_triangles)):
            expected = state.vertices[state.triangles[chosen]]
            self.assertEqual(len(corners.get(material, [])), len(expected))
            if len(expected):
                np.testing.assert_allclose(corners[material], expected, rtol=0, atol=2e-7)

    def test_frames_are_states(self):
        """Also with one frame, with a cut in each frame, and with more frames than one mesh has targets."""
        random = np.random.default_rng(3)
        for revisions in ([0], [0] * 5, [0, 1, 2], [0] * 61, [0] * 62, [0] * 61 + [1] * 125,
                          np.cumsum(random.random(80) < 0.2).tolist()):
            states, glb = self.export(revisions, first=2.5)
            for frame, state in enumerate(states):
                self.expect_state(glb, 0.1 * frame, state)

    def test_between_two_frames(self):
        """Within a revision it is the mean of both, also where a mesh takes over from another; then the cut jumps."""
        states, glb = self.export([0] * 70 + [1] * 3)
        for frame in range(69):
            node, = glb.shown(0.1 * frame + 0.05)
            expected = 0.5 * (states[frame].vertices.astype(float) + states[frame + 1].vertices)[states[frame].triangles]
            np.testing.assert_allclose(glb.corners(node, 0.1 * frame + 0.05)["body"], expected, rtol=0, atol=2e-6)
        self.expect_state(glb, 6.95, states[69])

    def test_texture(self):
        """Each corner keeps its texture coordinate, with v downwards; the image is in the file."""
        states, glb = self.export([0, 0, 1], has_image=True)
        image, = glb.document["images"]
        self.assertEqual((glb.view(image["bufferView"]), image["mimeType"]), (PNG, "image/png"))
        for mesh, state in zip(glb.document["meshes"], (states[0], states[2])):
            primitive = mesh["primitives"][0]
            material = glb.document["materials"][primitive["material"]]
            self.assertEqual(material["pbrMetallicRoughness"]["baseColorTexture"], {"index": 0})
            drawn = glb.accessors[primitive["attributes"]["TEXCOORD_0"]][glb.accessors[primitive["indices"]][:, 0]]
            expected = state.texture_coordinates[~state.cut_triangles].reshape(-1, 2)
            np.testing.assert_array_equal(drawn, expected * [1, -1] + [0, 1])

    def test_rules_of_the_format(self):
        for revisions, has_image in (([0, 0, 1], True), ([0] * 3, False), ([0] * 130, True)):
            glb = self.export(revisions, has_image)[1]
            primitives = [primitive for mesh in glb.document["meshes"] for primitive in mesh["primitives"]]
            self.assertEqual({primitive["material"] for primitive in primitives}, set(range(len(glb.document["materials"]))))
            for mesh in glb.document["meshes"]:
                counts = {len(primitive.get("targets", [])) for primitive in mesh["primitives"]}
                self.assertEqual(counts, {len(mesh.get("weights", []))})
            for primitive in primitives:
                attributes = [*primitive["attributes"].values(), *(t["POSITION"] for t in primitive.get("targets", []))]
                count, = {len(glb.accessors[index]) for index in attributes}
                self.assertLess(glb.accessors[primitive["indices"]].max(), count)


if __name__ == "__main__":
    rostest.rosrun("softbody_python", "gltf", Gltf, sys.argv)

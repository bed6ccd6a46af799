#!/usr/bin/env python3
"""PLY, OBJ and VTK files, read back, hold the states to the last bit."""
import base64
import csv
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
import rostest

import hand_made
import softbody
from softbody.export.mesh_files import ObjSequence, PlySequence
from softbody.export.vtk_files import VtkSeries

REVISIONS = [0, 0, 1, 2, 2]
VTK_TYPES = {"Float32": "<f4", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}


def read_ply(path):
    """{element: structured array} of a binary PLY whose lists all have the length of the first."""
    header, _, content = path.read_bytes().partition(b"end_header\n")
    elements, place, result = [], 0, {}
    for words in map(str.split, header.decode().splitlines()):
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    types = {"float": "<f4", "int": "<i4", "uchar": "u1"}
    for name, count, properties in elements:
        fields, at = [], place
        for words in properties:
            kind = np.dtype(types[words[-2]])
            if words[0] == "list":
                length = content[at]
                fields += [(words[-1] + "_count", "u1"), (words[-1], kind, length)]
                at += 1 + length * kind.itemsize
            else:
                fields.append((words[-1], kind))
                at += kind.itemsize
        result[name] = np.frombuffer(content, fields, count, place)
        place += result[name].nbytes
    assert place == len(content)
    return result


def read_obj(path):
    """(vertices, texture coordinates, {(group, material): faces}). Indices count from 1."""
    vertices, texture, faces, group, material = [], [], {}, None, None
    for words in map(str.split, path.read_text().splitlines()):
        if words[0] == "v":
            vertices.append(words[1:])
        elif words[0] == "vt":
            texture.append(words[1:])
        elif words[0] == "g":
            group = words[1]
        elif words[0] == "usemtl":
            material = words[1]
        elif words[0] == "f":
            faces.setdefault((group, material), []).append([list(map(int, corner.split("/"))) for corner in words[1:]])
    return np.float32(vertices), np.float32(texture), {key: np.array(value) for key, value in faces.items()}


def read_vtk(path):
    """{section: {name: array}} of a VTK file whose arrays are in base64."""
    result = {}
    for section in ElementTree.parse(path).getroot()[0][0]:
        arrays = result.setdefault(section.tag, {})
        for element in section:
            content = base64.b64decode(element.text)
            assert int.from_bytes(content[:8], "little") == len(content) - 8
            values = np.frombuffer(content, VTK_TYPES[element.get("type")], offset=8)
            columns = int(element.get("NumberOfComponents", 1))
            arrays[element.get("Name")] = values.reshape(-1, columns) if columns > 1 else values
    return result


class MeshFiles(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="mesh_files_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def states(self, has_texture=True):
        hand_made.write_bag(self.folder / "result.bag", REVISIONS, has_texture=has_texture)
        return list(softbody.read(self.folder / "result.bag"))

    def export(self, kind, states):
        writer = kind(self.folder, None)
        for frame, state in enumerate(states):
            writer.add(0.1 * frame, state)
        writer.finish()

    def expect_list(self, extension, states):
        with open(self.folder / "frames.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["file"] for row in rows], [f"surface_{k:06}.{extension}" for k in range(len(states))])
        for row, state in zip(rows, states):
            secs, nsecs = row["stamp_s"].split(".")
            self.assertEqual((int(secs), int(nsecs)), (state.stamp.secs, state.stamp.nsecs))
            self.assertEqual(int(row["revision"]), state.revision)

    def test_ply(self):
        for has_texture in (True, False):
            states = self.states(has_texture)
            self.export(PlySequence, states)
            self.expect_list("ply", states)
            for frame, state in enumerate(states):
                mesh = read_ply(self.folder / f"surface_{frame:06}.ply")
                vertices, faces = mesh["vertex"], mesh["face"]
                np.testing.assert_array_equal(np.c_[vertices["x"], vertices["y"], vertices["z"]], state.vertices)
                np.testing.assert_array_equal(vertices["standard_deviation"], state.standard_deviation)
                np.testing.assert_array_equal(vertices["piece"], state.vertex_pieces)
                np.testing.assert_array_equal(faces["vertex_indices"], state.triangles)
                np.testing.assert_array_equal(faces["piece"], state.triangle_pieces)
                np.testing.assert_array_equal(faces["cut"], state.cut_triangles)
                self.assertEqual("texcoord" in faces.dtype.names, has_texture)
                if has_texture:
                    np.testing.assert_array_equal(faces["texcoord"].reshape(-1, 3, 2), state.texture_coordinates)

    def test_obj(self):
        for has_texture in (True, False):
            states = self.states(has_texture)
            self.export(ObjSequence, states)
            self.expect_list("obj", states)
            for frame, state in enumerate(states):
                vertices, texture, faces = read_obj(self.folder / f"surface_{frame:06}.obj")
                np.testing.assert_array_equal(vertices, state.vertices)
                self.assertEqual(sum(map(len, faces.values())), len(state.triangles))
                for (group, material), corners in faces.items():
                    chosen = (state.triangle_pieces == int(group.split("_")[1])) & (state.cut_triangles == (material == "cut"))
                    np.testing.assert_array_equal(corners[:, :, 0] - 1, state.triangles[chosen])
                    if has_texture:
                        np.testing.assert_array_equal(texture[corners[:, :, 1] - 1], state.texture_coordinates[chosen])

    def expect_points(self, data, positions, topology):
        np.testing.assert_array_equal(data["Points"]["Points"], positions.vertices)
        np.testing.assert_array_equal(data["PointData"]["rest_position"], topology.rest_vertices)
        np.testing.assert_array_equal(data["PointData"]["standard_deviation"], positions.standard_deviation)
        np.testing.assert_array_equal(data["PointData"]["piece"], topology.vertex_pieces)

    def expect_cells(self, cells, expected):
        np.testing.assert_array_equal(cells["connectivity"].reshape(expected.shape), expected)
        np.testing.assert_array_equal(cells["offsets"], np.arange(1, len(expected) + 1) * expected.shape[1])

    def test_vtk(self):
        states = self.states()
        self.export(VtkSeries, states)
        for series, extension in (("surface", "vtp"), ("volume", "vtu")):
            index = ElementTree.parse(self.folder / f"{series}.pvd").findall(".//DataSet")
            self.assertEqual([row.get("file") for row in index], [f"{series}_{k:06}.{extension}" for k in range(len(states))])
            np.testing.assert_allclose([float(row.get("timestep")) for row in index], 0.1 * np.arange(len(states)))
        for frame, state in enumerate(states):
            surface, volume = (read_vtk(self.folder / f"{name}_{frame:06}.{extension}")
                               for name, extension in (("surface", "vtp"), ("volume", "vtu")))
            self.expect_points(surface, state, state.topology)
            self.expect_cells(surface["Polys"], state.triangles)
            np.testing.assert_array_equal(surface["CellData"]["piece"], state.triangle_pieces)
            np.testing.assert_array_equal(surface["CellData"]["cut"], state.cut_triangles)
            self.expect_points(volume, state.volume, state.volume.topology)
            self.expect_cells(volume["Cells"], state.volume.tets)
            np.testing.assert_array_equal(volume["CellData"]["piece"], state.volume.tet_pieces)
            np.testing.assert_array_equal(volume["Cells"]["types"], 10)


if __name__ == "__main__":
    rostest.rosrun("softbody_python", "mesh_files", MeshFiles, sys.argv)

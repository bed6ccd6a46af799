#!/usr/bin/env python3
"""Bytes of messages become the arrays that rospy reads from them; anything else is refused."""
import sys
import unittest

import numpy as np
import rostest

import hand_made
from softbody.lazy import bytes_of, lazy
from softbody.wire import WrongMessage, decode


def decoded(message):
    return decode(message._type, message._md5sum, hand_made.data_of(message))


class Wire(unittest.TestCase):
    def expect_same(self, array, values):
        np.testing.assert_array_equal(array, values)
        self.assertFalse(array.flags.writeable)

    def expect_header(self, result, message):
        self.assertEqual((result.stamp, result.frame, result.revision),
                         (message.header.stamp, message.header.frame_id, message.revision))

    def test_surface_topology(self):
        for seed in range(20):
            message = hand_made.surface_topology(seed, revision=seed % 3, has_texture=seed % 2 == 0)
            result = decoded(message)
            self.expect_header(result, message)
            self.expect_same(result.rest_vertices, hand_made.array(message.rest_vertices))
            self.expect_same(result.triangles, [t.vertex_indices for t in message.triangles])
            self.expect_same(result.vertex_parents, message.vertex_parents)
            self.expect_same(result.triangle_pieces, message.triangle_bodies)
            self.expect_same(result.cut_triangles, message.cut_triangles)
            if seed % 2:
                self.assertIsNone(result.texture_coordinates)
            else:
                texture = hand_made.array(message.texture_coordinates)[:, :2].reshape(-1, 3, 2)
                self.expect_same(result.texture_coordinates, texture)

    def test_volume_topology(self):
        for seed in range(20):
            message = hand_made.volume_topology(seed, revision=seed % 3)
            result = decoded(message)
            self.expect_header(result, message)
            self.expect_same(result.rest_vertices, hand_made.array(message.rest_vertices))
            self.expect_same(result.tets, [t.vertex_indices for t in message.tets])
            self.expect_same(result.surface_triangles, [t.vertex_indices for t in message.surface_triangles])
            self.expect_same(result.vertex_parents, message.vertex_parents)
            self.expect_same(result.tet_pieces, message.tet_bodies)
            np.testing.assert_array_equal(result.initial_pose, [0.25, 0, 0, 0, 0, 0, 1])

    def test_state(self):
        for seed in range(20):
            message = hand_made.mesh_state(seed, frame=seed, revision=seed, count=seed, has_estimates=seed % 2 == 0)
            result = decoded(message)
            self.expect_header(result, message)
            self.assertEqual(result.observed, message.observed)
            self.expect_same(result.vertices, hand_made.array(message.vertices).reshape(-1, 3))
            for array, values in ((result.confidence, message.confidence),
                                  (result.standard_deviation, message.standard_deviation)):
                if values:
                    self.expect_same(array, np.float32(values))
                else:
                    self.assertIsNone(array)

    def test_pieces_of_vertices(self):
        """A vertex has the piece of a triangle that has it; -1 without one."""
        topology = decoded(hand_made.surface_topology(7, revision=2))
        for vertex, piece in enumerate(topology.vertex_pieces):
            of_triangles = topology.triangle_pieces[(topology.triangles == vertex).any(axis=1)]
            self.assertIn(piece, of_triangles if len(of_triangles) else [-1])

    def test_what_is_cut_off_or_too_long(self):
        for message in (hand_made.surface_topology(1), hand_made.volume_topology(1), hand_made.surface_state(1, 1, 0)):
            data = hand_made.data_of(message)
            for length in range(len(data)):
                with self.assertRaises(WrongMessage):
                    decode(message._type, message._md5sum, data[:length])
            with self.assertRaisesRegex(WrongMessage, "1 bytes too many"):
                decode(message._type, message._md5sum, data + b"\0")

    def test_what_contradicts_itself(self):
        def broken(message, **fields):
            for name, value in fields.items():
                setattr(message, name, value)
            return message

        surface, volume, state = hand_made.surface_topology, hand_made.volume_topology, hand_made.surface_state
        nowhere = hand_made.points([[np.nan, 0, 0]] * hand_made.VERTICES)
        for message, reason in (
                (broken(surface(1), rest_vertices=surface(1).rest_vertices[:5]), "vertex that does not exist"),
                (broken(volume(1), rest_vertices=volume(1).rest_vertices[:5]), "vertex that does not exist"),
                (broken(surface(1), triangle_bodies=[0]), "differ in number"),
                (broken(volume(1), tet_bodies=[0]), "differ in number"),
                (broken(surface(1), cut_triangles=[True]), "cut_triangles"),
                (broken(surface(1), vertex_parents=[1]), "vertex_parents"),
                (broken(surface(1), texture_coordinates=nowhere[:4]), "three per triangle"),
                (broken(state(1, 1, 0), confidence=[1.0]), "confidence"),
                (broken(state(1, 1, 0), vertices=nowhere), r"vertices\[0\] is \(nan, 0, 0\); allowed: finite")):
            with self.assertRaisesRegex(WrongMessage, reason):
                decoded(message)

    def test_a_state_that_no_sender_can_mean(self):
        for bad in (np.nan, np.inf, -np.inf, 1e20):
            for field, place in (("vertices", 3), ("confidence", 5), ("standard_deviation", 7)):
                message = hand_made.surface_state(1, 1, 0)
                if field == "vertices":
                    message.vertices[place].y = bad
                else:
                    getattr(message, field)[place] = bad
                with self.assertRaisesRegex(WrongMessage, rf"{field}\[{place}\] is .*allowed"):
                    decoded(message)
        message = hand_made.surface_state(1, 1, 0)
        message.vertices = hand_made.points([[0, 0, 0]] * hand_made.VERTICES)
        with self.assertRaisesRegex(WrongMessage, "all vertices are at one place"):
            decoded(message)

    def test_lazy_messages(self):
        """A message that keeps its bytes has the fields of one that is read at once, whatever is asked of it first."""
        for message in (hand_made.surface_topology(1), hand_made.volume_topology(1), hand_made.surface_state(1, 1, 0)):
            data = hand_made.data_of(message)
            eager = type(message)().deserialize(data)
            for field in message.__slots__:
                received = lazy(type(message))().deserialize(data)
                self.assertEqual(bytes_of(received), data)
                self.assertEqual(getattr(received, field), getattr(eager, field))
                self.assertIsInstance(received, type(message))
                self.assertEqual(hand_made.data_of(received), data)
            self.assertEqual(bytes_of(message), data)
            self.assertEqual(hand_made.data_of(lazy(type(message))()), hand_made.data_of(type(message)()))
            with self.assertRaisesRegex(AttributeError, "has no field nothing"):
                lazy(type(message))().nothing

    def test_another_version_or_type(self):
        message = hand_made.surface_state(1, 1, 0)
        with self.assertRaisesRegex(WrongMessage, "another version of softbody_msgs/MeshState"):
            decode(message._type, "0" * 32, hand_made.data_of(message))
        with self.assertRaisesRegex(WrongMessage, "the type is std_msgs/String"):
            decode("std_msgs/String", message._md5sum, hand_made.data_of(message))


if __name__ == "__main__":
    rostest.rosrun("softbody_python", "wire", Wire, sys.argv)

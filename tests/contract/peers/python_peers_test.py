"""Tests of python_peers.py: the messages, with a peer made up for them. Needs none of the libraries.

Run as a program: python3 python_peers_test.py
"""

import io
import json
import math
import struct
import unittest

import python_peers
from python_peers import Answer, Inexpressible, Server

BUILD, CLOSEST, ANY, ALL = (python_peers.REQUESTS.index(name) for name in ("build", "closest", "any", "all"))


class Peer:
    """Keeps what it is given, and does what the ray's origin asks for."""

    def describe(self):
        return python_peers.description("made up", "1.0", has_all=False)

    def build(self, meshes):
        self.meshes = meshes

    def closest(self, ray):
        self.ray = ray
        if ray.origin[0] == 1.0:
            raise Inexpressible("no words")
        if ray.origin[0] == 2.0:
            raise KeyError("lost")
        return None if ray.origin[0] == 3.0 else Answer(-0.0, 7, geometry=2)

    def any(self, ray):
        return ray.origin[0] > 0.0

    def all(self, ray):
        return [Answer(3.0, 1), Answer(1.0, 2), Answer(2.0, 3)]


def message(kind, body=b""):
    return struct.pack("<II", kind, len(body)) + body


def ray(x, tmin=0.0, tmax=math.inf):
    return struct.pack("<8d", x, 0.0, 5.0, 0.0, 0.0, -1.0, tmin, tmax)


def ask(peer, *messages):
    """The replies to messages, as (kind, body)."""
    replies = io.BytesIO()
    Server(peer).run(io.BytesIO(b"".join(messages)), replies)
    replies.seek(0)
    found = []
    while (reply := python_peers.read_message(replies)) is not None:
        found.append(reply)
    return found


class Messages(unittest.TestCase):
    def test_meshes_arrive_as_they_were_sent(self):
        first = struct.pack("<4I", 1, 0, 3, 1) + struct.pack("<9d", *range(9)) + struct.pack("<3I", 0, 1, 2)
        second = struct.pack("<4I", 0, 1, 1, 1) + struct.pack("<3d", math.nan, -0.0, math.inf)
        second += struct.pack("<3I", 0, 0, 4294967295)
        peer = Peer()
        self.assertEqual(ask(peer, message(BUILD, struct.pack("<I", 2) + first + second)), [(0, b"")])
        one, two = peer.meshes
        self.assertEqual((one.float32, one.skip_invalid), (True, False))
        self.assertEqual(one.vertices, [(0.0, 1.0, 2.0), (3.0, 4.0, 5.0), (6.0, 7.0, 8.0)])
        self.assertEqual(one.triangles, [(0, 1, 2)])
        self.assertEqual((two.float32, two.skip_invalid), (False, True))
        self.assertEqual(two.triangles, [(0, 0, 4294967295)])
        x, y, z = two.vertices[0]
        self.assertTrue(math.isnan(x))
        self.assertEqual((math.copysign(1.0, y), z), (-1.0, math.inf))

    def test_a_mesh_cut_short_is_an_error(self):
        body = struct.pack("<I", 1) + struct.pack("<4I", 0, 0, 0, 2) + struct.pack("<3I", 0, 1, 2)
        kind, text = ask(Peer(), message(BUILD, body))[0]
        self.assertEqual((kind, text), (python_peers.FAILURE, b"ValueError: a message is too short"))

    def test_a_ray_arrives_as_it_was_sent(self):
        peer = Peer()
        ask(peer, message(CLOSEST, ray(4.0, tmin=0.5, tmax=math.nan)))
        self.assertEqual(peer.ray.origin, (4.0, 0.0, 5.0))
        self.assertEqual(peer.ray.direction, (0.0, 0.0, -1.0))
        self.assertEqual(peer.ray.tmin, 0.5)
        self.assertTrue(math.isnan(peer.ray.tmax))

    def test_answers_have_the_layout_of_the_protocol(self):
        hit, miss, some, none, several = ask(
            Peer(),
            message(CLOSEST, ray(4.0)),
            message(CLOSEST, ray(3.0)),
            message(ANY, ray(1.0)),
            message(ANY, ray(-1.0)),
            message(ALL, ray(0.0)),
        )
        t, u, v, is_hit, geometry, primitive, zero = struct.unpack("<3d4I", hit[1])
        self.assertEqual((math.copysign(1.0, t), is_hit, geometry, primitive, zero), (-1.0, 1, 2, 7, 0))
        self.assertTrue(math.isnan(u) and math.isnan(v))
        self.assertEqual(struct.unpack("<3d4I", miss[1])[3], 0)
        self.assertEqual((some[1], none[1]), (struct.pack("<I", 1), struct.pack("<I", 0)))
        self.assertEqual([row[0] for row in struct.iter_unpack("<3d4I", several[1])], [1.0, 2.0, 3.0])

    def test_what_the_library_cannot_do_and_what_it_raises_are_told_apart(self):
        self.assertEqual(
            ask(Peer(), message(CLOSEST, ray(1.0)), message(CLOSEST, ray(2.0)), message(CLOSEST, ray(3.0)))[:2],
            [(python_peers.INEXPRESSIBLE, b"no words"), (python_peers.FAILURE, b"KeyError: 'lost'")],
        )

    def test_a_description_names_every_capability(self):
        kind, text = ask(Peer(), message(0))[0]
        told = json.loads(text)
        self.assertEqual(kind, python_peers.OK)
        self.assertEqual((told["name"], told["version"], told["has_all"]), ("made up", "1.0", False))
        self.assertEqual(len(told), 11)


class Rays(unittest.TestCase):
    def test_the_parameter_of_a_point_survives_tiny_directions(self):
        tiny = python_peers.Ray(0.0, 0.0, 0.0, 0.0, 1e-200, 1e-201, 0.0, math.inf)
        self.assertEqual(tiny.parameter((0.0, 2.0, 0.2)), 2.0 / 1e-200)

    def test_an_interval_is_nothing_that_trimesh_has_words_for(self):
        python_peers.whole_ray(python_peers.Ray(*[0.0] * 5, 1.0, 0.0, math.inf), "trimesh")
        for tmin, tmax in ((0.5, math.inf), (0.0, 2.0), (math.nan, math.inf)):
            with self.assertRaises(Inexpressible):
                python_peers.whole_ray(python_peers.Ray(*[0.0] * 5, 1.0, tmin, tmax), "trimesh")


if __name__ == "__main__":
    unittest.main()

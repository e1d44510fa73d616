#!/usr/bin/env python3
"""Python's ray libraries before the hard cases.

    python_peers.py PEER      answers the requests on standard input, as protocol.h describes them

Each peer answers as its library does: numbers are converted to what the library takes, and nothing is done to make an
answer better. What a library has no words for raises Inexpressible.
"""

import argparse
import importlib.metadata
import json
import math
import os
import struct
import sys

REQUESTS = ("describe", "build", "closest", "any", "all", "closest_batch")
OK, REFUSAL, INEXPRESSIBLE, FAILURE = range(4)

HEAD = struct.Struct("<II")
RAY = struct.Struct("<8d")
ANSWER = struct.Struct("<3d4I")
MESH = struct.Struct("<4I")


class Inexpressible(Exception):
    """A question for which the library has no words."""


class Mesh:
    """Vertices and triangles as rows of tuples."""

    def __init__(self, float32, skip_invalid, vertices, triangles):
        self.float32 = float32
        self.skip_invalid = skip_invalid
        self.vertices = vertices
        self.triangles = triangles


class Ray:
    def __init__(self, ox, oy, oz, dx, dy, dz, tmin, tmax):
        self.origin = (ox, oy, oz)
        self.direction = (dx, dy, dz)
        self.tmin = tmin
        self.tmax = tmax

    def parameter(self, point):
        """t of a point of the ray, by the direction's largest component, which alone cannot underflow."""
        axis = max(range(3), key=lambda i: abs(self.direction[i]))
        along = self.direction[axis]
        return float(point[axis] - self.origin[axis]) / along if along != 0.0 else math.nan


class Answer:
    def __init__(self, t, primitive, u=math.nan, v=math.nan, geometry=0):
        self.t = t
        self.u = u
        self.v = v
        self.geometry = geometry
        self.primitive = primitive


# --- messages -------------------------------------------------------------------------------------------------


def read_message(stream):
    """The next message as (kind, body); None at the end of the input."""
    head = stream.read(HEAD.size)
    if not head:
        return None
    kind, size = HEAD.unpack(head)
    body = stream.read(size)
    if len(body) != size:
        raise ValueError("a message ends too early")
    return kind, body


def write_message(stream, kind, body):
    stream.write(HEAD.pack(kind, len(body)) + body)
    stream.flush()


def read_meshes(body):
    (count,) = struct.unpack_from("<I", body)
    at = 4
    meshes = []
    for _ in range(count):
        float32, skip_invalid, vertex_count, triangle_count = MESH.unpack_from(body, at)
        at += MESH.size
        vertices = list(struct.iter_unpack("<3d", body[at : at + 24 * vertex_count]))
        at += 24 * vertex_count
        triangles = list(struct.iter_unpack("<3I", body[at : at + 12 * triangle_count]))
        at += 12 * triangle_count
        if len(triangles) != triangle_count:
            raise ValueError("a message is too short")
        meshes.append(Mesh(bool(float32), bool(skip_invalid), vertices, triangles))
    return meshes


def packed(answer):
    if answer is None:
        return ANSWER.pack(0.0, 0.0, 0.0, 0, 0, 0, 0)
    return ANSWER.pack(answer.t, answer.u, answer.v, 1, answer.geometry, answer.primitive, 0)


class Server:
    """Answers requests with one peer."""

    def __init__(self, peer):
        self.peer = peer

    def reply(self, kind, body):
        """The body of the reply to a request."""
        question = REQUESTS[kind]
        if question == "describe":
            return json.dumps(self.peer.describe()).encode()
        if question == "build":
            self.peer.build(read_meshes(body))
            return b""
        if question == "closest_batch":
            raise Inexpressible("not asked in batches")
        ray = Ray(*RAY.unpack(body))
        if question == "closest":
            return packed(self.peer.closest(ray))
        if question == "any":
            return struct.pack("<I", int(self.peer.any(ray)))
        answers = sorted(self.peer.all(ray), key=lambda answer: answer.t)
        return b"".join(packed(answer) for answer in answers)

    def run(self, requests, replies):
        while (message := read_message(requests)) is not None:
            try:
                kind, body = OK, self.reply(*message)
            except Inexpressible as reason:
                kind, body = INEXPRESSIBLE, str(reason).encode()
            except Exception as error:  # whatever the library raises is its answer
                kind, body = FAILURE, f"{type(error).__name__}: {error}".encode()
            write_message(replies, kind, body)


# --- peers ----------------------------------------------------------------------------------------------------


def description(name, version, **capabilities):
    told = {
        "name": name,
        "version": version,
        "has_any": True,
        "has_all": True,
        "has_batch": False,
        "refuses_bad_meshes": False,
        "many_geometries": False,
        "orders_ties": False,
        "decides_exactly": False,
        "counts_crossings": False,
        "t_tolerance": 1e-9,
    }
    told.update(capabilities)
    return told


def versions(*packages):
    return ", ".join(f"{package} {importlib.metadata.version(package)}" for package in packages)


def whole_ray(ray, library):
    """Nothing but origin and direction can be said."""
    if ray.tmin != 0.0 or ray.tmax != math.inf:
        raise Inexpressible(f"{library} has no tmin and no tmax")


def only_mesh(meshes):
    if len(meshes) > 1:
        raise Inexpressible("one mesh at a time")
    return meshes[0] if meshes else Mesh(False, False, [], [])


class TrimeshBase:
    """What the two intersectors of trimesh share: the mesh, and float64 numbers for one ray."""

    def build(self, meshes):
        import numpy
        import trimesh

        mesh = only_mesh(meshes)
        # process=False: vertices and triangles stay as they are, so that ids do.
        self.mesh = trimesh.Trimesh(
            vertices=numpy.array(mesh.vertices, dtype=numpy.float64).reshape(-1, 3),
            faces=numpy.array(mesh.triangles, dtype=numpy.int64).reshape(-1, 3),
            process=False,
            validate=False,
        )
        self.intersector = self.make_intersector(self.mesh)

    def question(self, ray):
        import numpy

        whole_ray(ray, "trimesh")
        return {"ray_origins": numpy.array([ray.origin]), "ray_directions": numpy.array([ray.direction])}

    def answers(self, ray, triangles, locations):
        return [Answer(ray.parameter(location), int(index)) for index, location in zip(triangles, locations)]

    def closest(self, ray):
        triangles, _, locations = self.intersector.intersects_id(
            **self.question(ray), multiple_hits=False, return_locations=True
        )
        answers = self.answers(ray, triangles, locations)
        return answers[0] if answers else None

    def any(self, ray):
        return bool(self.intersector.intersects_any(**self.question(ray))[0])


class Trimesh(TrimeshBase):
    """trimesh's own intersector: an R-tree and NumPy, in float64."""

    def describe(self):
        return description("trimesh", versions("trimesh", "rtree", "numpy"))

    def make_intersector(self, mesh):
        from trimesh.ray.ray_triangle import RayMeshIntersector

        return RayMeshIntersector(mesh)

    def all(self, ray):
        # What the intersector's methods call: they tell either no places, or merge the triangles hit at the same place.
        from trimesh.ray.ray_triangle import ray_triangle_id

        triangles, _, locations = ray_triangle_id(
            triangles=self.mesh.triangles,
            triangles_normal=self.mesh.face_normals,
            tree=self.mesh.triangles_tree,
            multiple_hits=True,
            **self.question(ray),
        )
        return self.answers(ray, triangles, locations)


class TrimeshWithEmbreex(TrimeshBase):
    """trimesh as it is once embreex is installed: Embree 4 on a mesh scaled to a common size, hit after hit."""

    def describe(self):
        return description("trimesh + embreex", versions("trimesh", "embreex"), t_tolerance=1e-5)

    def make_intersector(self, mesh):
        from trimesh.ray.ray_pyembree import RayMeshIntersector

        return RayMeshIntersector(mesh)

    def all(self, ray):
        triangles, _, locations = self.intersector.intersects_id(
            **self.question(ray), multiple_hits=True, return_locations=True
        )
        return self.answers(ray, triangles, locations)


class Embreex:
    """embreex by itself: Embree 4, float32, with the robust flag that it sets by default."""

    def describe(self):
        return description(
            "embreex", versions("embreex"), has_all=False, many_geometries=True, t_tolerance=1e-5
        )

    def build(self, meshes):
        import numpy
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        # The ids of geometries are counted up as they are added.
        if len(meshes) > 1 and any(not mesh.triangles for mesh in meshes):
            raise Inexpressible("an empty mesh among others would shift the ids")
        self.scene = EmbreeScene()
        with numpy.errstate(over="ignore"):
            self.meshes = [
                TriangleMesh(
                    self.scene,
                    numpy.array(mesh.vertices, dtype=numpy.float64).reshape(-1, 3).astype(numpy.float32),
                    numpy.array(mesh.triangles, dtype=numpy.int32).reshape(-1, 3),
                )
                for mesh in meshes
                if mesh.triangles
            ]

    def run(self, ray, query, output):
        import numpy

        if ray.tmin != 0.0:
            raise Inexpressible("embreex has no tmin")
        with numpy.errstate(over="ignore"):
            origin = numpy.array([ray.origin]).astype(numpy.float32)
            direction = numpy.array([ray.direction]).astype(numpy.float32)
            # None: embreex's own idea of a ray without an end.
            far = None if ray.tmax == math.inf else numpy.array([ray.tmax]).astype(numpy.float32)
        return self.scene.run(origin, direction, dists=far, query=query, output=output)

    def closest(self, ray):
        found = self.run(ray, "INTERSECT", 1)
        if found["primID"][0] < 0:
            return None
        return Answer(
            float(found["tfar"][0]),
            int(found["primID"][0]),
            float(found["u"][0]),
            float(found["v"][0]),
            int(found["geomID"][0]),
        )

    def any(self, ray):
        return bool(self.run(ray, "OCCLUDED", None)[0] >= 0)

    def all(self, ray):
        raise Inexpressible("embreex has no call for all hits")


PEERS = {"trimesh": Trimesh, "trimesh-embreex": TrimeshWithEmbreex, "embreex": Embreex}


def main():
    parser = argparse.ArgumentParser(
        description="Answers the requests on standard input with one of Python's ray libraries (see protocol.h)."
    )
    parser.add_argument("peer", choices=sorted(PEERS))
    arguments = parser.parse_args()

    # Replies go to the descriptor that was standard output; whatever the library prints goes to standard error.
    replies = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    Server(PEERS[arguments.peer]()).run(sys.stdin.buffer, replies)


if __name__ == "__main__":
    main()

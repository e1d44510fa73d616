"""The ray libraries that take part: each in the form that it likes best, and with what it gives when asked as its pages show.

A library has a name, version(), why_not(scene), build(), and what build() returns has prepare(), closest() and occluded(). prepare() makes of
rays what the library reads, outside of the measured time where only rays are measured. closest() and occluded() return one bool for each ray,
whether something was hit, as a function: making it is not what is measured.
"""

import importlib.metadata
import math

import numpy as np


class Raywise:
    """raywise, which chooses the structure; every output, or only those that are used most."""

    def __init__(self, module, want=None, structure=None):
        self.module = module
        self.want = want
        self.structure = structure
        self.name = "raywise" if want is None else "raywise t, uv, id"

    def version(self):
        return f"raywise {self.module.version()}"

    def why_not(self, scene):
        return None

    def build(self, scene, rays, kind, threads):
        built = self.module.Scene()
        built.add_triangles(scene.vertices, scene.triangles, copy=False)
        built.set_expected_rays(rays, kind)
        built.commit(threads=threads)
        return BuiltRaywise(built, self.want, threads)


class BuiltRaywise:
    def __init__(self, scene, want, threads):
        self.scene = scene
        self.options = {"threads": threads}
        self.outputs = {} if want is None else {"want": want}

    def what(self):
        return self.scene.statistics.structure

    def prepare(self, rays):
        return rays

    def closest(self, rays):
        hits = self.scene.intersect(rays.origins, rays.directions, **self.options, **self.outputs)
        return lambda: hits.hit

    def occluded(self, rays):
        flags = self.scene.occluded(rays.origins, rays.directions, tmax=rays.tmax, **self.options)
        return lambda: flags


class Embreex:
    """Embree 4 through embreex: t, ids, u, v and normals; float32 and int32 arrays, which it reads as they are."""

    name = "embreex"

    def version(self):
        return "embreex " + importlib.metadata.version("embreex")

    def why_not(self, scene):
        return None

    def build(self, scene, rays, kind, threads):
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        built = EmbreeScene()
        TriangleMesh(built, scene.vertices, scene.triangles.astype(np.int32))
        # It commits with the first rays.
        built.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32), query="OCCLUDED")
        return BuiltEmbreex(built)


class BuiltEmbreex:
    def __init__(self, scene):
        self.scene = scene

    def what(self):
        return ""

    def prepare(self, rays):
        return rays

    def closest(self, rays):
        found = self.scene.run(rays.origins, rays.directions, query="INTERSECT", output=1)
        return lambda: np.asarray(found["primID"]) >= 0

    def occluded(self, rays):
        ends = None if math.isinf(rays.tmax) else np.full(len(rays), rays.tmax, np.float32)
        found = self.scene.run(rays.origins, rays.directions, dists=ends, query="OCCLUDED")
        return lambda: np.asarray(found) >= 0


class Open3d:
    """Embree 4 through Open3D's RaycastingScene: t, ids, u, v and normals; rays as rows of six."""

    name = "Open3D"

    def version(self):
        import open3d

        return f"Open3D {open3d.__version__}"

    def why_not(self, scene):
        return None

    def build(self, scene, rays, kind, threads):
        import open3d.core
        import open3d.t.geometry

        tensor = open3d.core.Tensor.from_numpy
        built = open3d.t.geometry.RaycastingScene(nthreads=threads)
        built.add_triangles(tensor(scene.vertices), tensor(scene.triangles))
        # It commits with the first rays.
        built.test_occlusions(tensor(np.ones((1, 6), np.float32)), nthreads=threads)
        return BuiltOpen3d(built, threads, tensor)


class BuiltOpen3d:
    def __init__(self, scene, threads, tensor):
        self.scene = scene
        self.threads = threads
        self.tensor = tensor

    def what(self):
        return ""

    def prepare(self, rays):
        return self.tensor(np.hstack([rays.origins, rays.directions])), rays.tmax

    def closest(self, rays):
        found = self.scene.cast_rays(rays[0], nthreads=self.threads)
        return lambda: np.isfinite(found["t_hit"].numpy())

    def occluded(self, rays):
        found = self.scene.test_occlusions(rays[0], tfar=rays[1], nthreads=self.threads)
        return lambda: found.numpy()


class Trimesh:
    """trimesh on its own: NumPy and an R-tree. One hit of each ray: its triangle and where it lies."""

    name = "trimesh"
    most_triangles = 100_000  # the R-tree of more takes minutes

    def version(self):
        return "trimesh " + importlib.metadata.version("trimesh")

    def why_not(self, scene):
        if len(scene.triangles) > self.most_triangles:
            return f"more than {self.most_triangles:,} triangles"
        return None

    def intersector(self, mesh):
        from trimesh.ray.ray_triangle import RayMeshIntersector

        return RayMeshIntersector(mesh)

    def build(self, scene, rays, kind, threads):
        import trimesh

        mesh = trimesh.Trimesh(scene.vertices, scene.triangles, process=False, validate=False)
        intersector = self.intersector(mesh)
        intersector.intersects_any(np.zeros((1, 3)), np.ones((1, 3)))  # builds what it needs
        return BuiltTrimesh(intersector)


class TrimeshWithEmbreex(Trimesh):
    """trimesh as it is once embreex is installed."""

    name = "trimesh + embreex"

    def why_not(self, scene):
        return None

    def intersector(self, mesh):
        from trimesh.ray.ray_pyembree import RayMeshIntersector

        return RayMeshIntersector(mesh)


class BuiltTrimesh:
    def __init__(self, intersector):
        self.intersector = intersector

    def what(self):
        return ""

    def prepare(self, rays):
        return rays

    def closest(self, rays):
        _, hit_rays, _ = self.intersector.intersects_id(
            rays.origins, rays.directions, multiple_hits=False, return_locations=True
        )
        count = len(rays)

        def hits():
            flags = np.zeros(count, bool)
            flags[hit_rays] = True
            return flags

        return hits

    # Its any-hit question has no end of the ray.
    occluded = None


def all_libraries(raywise):
    """raywise: the module."""
    return [
        Raywise(raywise),
        Raywise(raywise, ("t", "uv", "primitive")),
        Embreex(),
        Open3d(),
        TrimeshWithEmbreex(),
        Trimesh(),
    ]

"""trimesh on its own (NumPy and an R-tree), and as it is once embreex is installed.

Its answers are the triangle and the place of each ray that hits; no u and v. Its question for any hit knows no end of
a ray, so it is not asked about shadows.
"""

from __future__ import annotations

import importlib.metadata
from typing import Any

import numpy as np
from scenes import Mesh, RayArrays

from libraries.library import Built, Hits, Library, Plan, hits_of


class Trimesh(Library):
    name = "trimesh"
    questions = frozenset({"closest"})
    slow = True

    def version(self) -> str:
        import rtree  # noqa: F401  # without it there are no rays
        import trimesh.ray.ray_triangle  # noqa: F401

        return "trimesh " + importlib.metadata.version("trimesh")

    def build(self, mesh: Mesh, plan: Plan) -> Built:
        import trimesh.ray.ray_triangle

        whole = unprocessed(mesh)
        _ = whole.triangles_tree, whole.triangles, whole.face_normals  # kept by the mesh, for all rays
        return BuiltTrimesh(trimesh.ray.ray_triangle.RayMeshIntersector(whole))


class TrimeshEmbreex(Library):
    name = "tri+emb"
    questions = frozenset({"closest"})

    def version(self) -> str:
        import trimesh.ray.ray_pyembree  # noqa: F401

        return "trimesh " + importlib.metadata.version("trimesh")

    def build(self, mesh: Mesh, plan: Plan) -> Built:
        import trimesh.ray.ray_pyembree

        return BuiltTrimesh(trimesh.ray.ray_pyembree.RayMeshIntersector(unprocessed(mesh)))


def unprocessed(mesh: Mesh) -> Any:
    """Vertices and triangles stay as they are, so that ids do; trimesh keeps float64 and int64."""
    import trimesh

    return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False, validate=False)


class BuiltTrimesh(Built):
    def __init__(self, intersector: Any) -> None:
        self.intersector = intersector

    def closest(self, rays: RayArrays) -> Any:
        return self.intersector.intersects_id(rays.origins, rays.directions, multiple_hits=False, return_locations=True)

    def hits(self, answer: Any, rays: RayArrays) -> Hits:
        triangles, who, places = answer
        hit = np.zeros(len(rays), bool)
        t = np.full(len(rays), np.inf)
        primitive = np.full(len(rays), -1)
        directions = rays.directions[who].astype(np.float64)
        along = np.einsum("ij,ij->i", places - rays.origins[who], directions)
        hit[who] = True
        t[who] = along / np.einsum("ij,ij->i", directions, directions)
        primitive[who] = triangles
        return hits_of(t, primitive, hit, None)

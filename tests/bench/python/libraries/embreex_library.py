"""embreex: Embree 4, asked ray by ray in a compiled loop, in the caller's thread."""

from __future__ import annotations

import importlib.metadata
import math
from typing import Any

import numpy as np
from scenes import Array, Mesh, RayArrays

from libraries.library import Built, Hits, Library, Plan, hits_of


class Embreex(Library):
    name = "embreex"

    def version(self) -> str:
        from embreex.rtcore import EmbreeDevice

        self.device = EmbreeDevice()  # one for all scenes, made beforehand
        return "embreex " + importlib.metadata.version("embreex")

    def build(self, mesh: Mesh, plan: Plan) -> Built:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        scene = EmbreeScene(self.device)
        TriangleMesh(scene, mesh.vertices.astype(np.float32, copy=False), mesh.triangles.view(np.int32))
        return BuiltEmbreex(scene)


class BuiltEmbreex(Built):
    def __init__(self, scene: Any) -> None:
        self.scene = scene

    def closest(self, rays: RayArrays) -> Any:
        # output=1: t, u, v, normal and both ids, for little more than the primitive alone.
        return self.scene.run(rays.origins, rays.directions, query="INTERSECT", output=1)

    def occluded(self, rays: RayArrays) -> Any:
        # A number, not an array: it writes t into the array that it is given.
        end = None if math.isinf(rays.tmax) else rays.tmax
        return self.scene.run(rays.origins, rays.directions, dists=end, query="OCCLUDED")

    def hits(self, answer: Any, rays: RayArrays) -> Hits:
        uv = np.column_stack((answer["u"], answer["v"]))
        return hits_of(answer["tfar"], answer["primID"], answer["primID"] >= 0, uv)

    def flags(self, answer: Any, rays: RayArrays) -> Array:
        return np.asarray(answer) >= 0

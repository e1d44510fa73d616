"""Open3D's RaycastingScene: an Embree, asked in streams, by several threads unless it is told otherwise."""

from __future__ import annotations

from typing import Any

import numpy as np
from scenes import Array, Mesh, RayArrays

from libraries.library import Built, Hits, Library, Plan, hits_of


class Open3D(Library):
    name = "Open3D"

    def version(self) -> str:
        import open3d

        return f"Open3D {open3d.__version__}"

    def build(self, mesh: Mesh, plan: Plan) -> Built:
        import open3d

        tensor = open3d.core.Tensor.from_numpy  # shares the memory
        scene = open3d.t.geometry.RaycastingScene(nthreads=plan.threads)
        scene.add_triangles(tensor(mesh.vertices.astype(np.float32, copy=False)), tensor(mesh.triangles))
        return BuiltOpen3D(scene, plan.threads, tensor)


class BuiltOpen3D(Built):
    def __init__(self, scene: Any, threads: int, tensor: Any) -> None:
        self.scene = scene
        self.threads = threads
        self.tensor = tensor

    def prepare(self, rays: RayArrays) -> Any:
        """Rows of six."""
        return self.tensor(np.concatenate((rays.origins, rays.directions), axis=1)), rays.tmax

    def closest(self, rays: Any) -> Any:
        rows, _ = rays
        return self.scene.cast_rays(rows, nthreads=self.threads)

    def occluded(self, rays: Any) -> Any:
        rows, tmax = rays
        return self.scene.test_occlusions(rows, tfar=tmax, nthreads=self.threads)

    def hits(self, answer: Any, rays: RayArrays) -> Hits:
        t = answer["t_hit"].numpy()
        return hits_of(t, answer["primitive_ids"].numpy(), np.isfinite(t), answer["primitive_uvs"].numpy())

    def flags(self, answer: Any, rays: RayArrays) -> Array:
        return np.asarray(answer.numpy())

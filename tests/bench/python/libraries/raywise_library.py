"""raywise in three ways of calling it.

It chooses the structure where building counts. Where rays alone count a choice that weighs building against rays would
be out of place, and it is the bvh, as in `make bench`.
"""

from __future__ import annotations

from typing import Any, Dict, Iterable, Optional

import numpy as np
from scenes import Array, Mesh, RayArrays

from libraries.library import Built, Hits, Library, Plan, hits_of


class Raywise(Library):
    """A scene that is kept. Without `want` all outputs: t, uv, normal and three ids."""

    def __init__(self, name: str, want: Optional[Iterable[str]] = None) -> None:
        self.name = name
        self.want: Dict[str, Any] = {}
        if want is not None:
            self.want = {"want": want}
            self.questions = frozenset({"closest"})  # nothing is left to be wanted of the other

    def version(self) -> str:
        import raywise

        return f"raywise {raywise.version()}"

    def build(self, mesh: Mesh, plan: Plan) -> Built:
        import raywise

        scene = raywise.Scene(
            mesh.vertices,
            mesh.triangles,
            expected_rays=plan.count,
            kind=plan.kind,
            structure=None if plan.build_counts else "bvh",
            copy=False,
            threads=plan.threads,
        )
        return BuiltRaywise(scene, plan, self.want)


class BuiltRaywise(Built):
    def __init__(self, scene: Any, plan: Plan, want: Dict[str, Any]) -> None:
        self.scene = scene
        self.threads = plan.threads
        self.want = want

    @property
    def structure(self) -> str:  # type: ignore[override]
        return str(self.scene.structure)

    def closest(self, rays: RayArrays) -> Any:
        return self.scene.intersect(rays.origins, rays.directions, threads=self.threads, **self.want)

    def occluded(self, rays: RayArrays) -> Any:
        return self.scene.occluded(rays.origins, rays.directions, tmax=rays.tmax, threads=self.threads)

    def hits(self, answer: Any, rays: RayArrays) -> Hits:
        return hits_of(answer.t, answer.primitive, answer.hit, answer.uv)

    def flags(self, answer: Any, rays: RayArrays) -> Array:
        return np.asarray(answer)


class RaywiseOnce(Raywise):
    """One call that builds, asks and forgets, which is told all that a scene is told."""

    totals_only = True

    def build(self, mesh: Mesh, plan: Plan) -> Built:
        return MeshForOnce(mesh, plan)


class MeshForOnce(BuiltRaywise):
    structure = ""  # not kept long enough to be asked

    def __init__(self, mesh: Mesh, plan: Plan) -> None:
        self.mesh = mesh
        self.plan = plan

    def closest(self, rays: RayArrays) -> Any:
        import raywise

        return raywise.intersect_once(
            (self.mesh.vertices, self.mesh.triangles),
            rays.origins,
            rays.directions,
            kind=self.plan.kind,
            threads=self.plan.threads,
        )

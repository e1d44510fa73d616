"""Traces a sphere through the installed raywise and checks the answers against geometry.

The mesh is inscribed in the unit sphere, so everything about it can be bounded by hand:

- its vertices lie on the sphere of radius 1, its faces touch a smaller one of radius `inner`;
- a ray that passes the centre at a distance below `inner` enters the mesh and leaves it, and does both between the
  spheres: t is within the roots of two quadratic equations;
- a ray that passes farther than 1 misses;
- the mesh is closed and its normals point outwards.

Exits with 1 when an answer is wrong.
"""

import sys

import numpy as np

import raywise


def sphere_mesh(divisions):
    """A cube with each face cut into divisions x divisions squares, blown up to the unit sphere."""
    vertices, triangles, known = [], [], {}

    def vertex(point):
        """The id of a vertex; squares that meet share it, so that the mesh is closed."""
        key = tuple(np.round(point * 1e6).astype(int))
        if key not in known:
            known[key] = len(vertices)
            vertices.append(point / np.linalg.norm(point))
        return known[key]

    ticks = np.tan(np.linspace(-np.pi / 4, np.pi / 4, divisions + 1))
    for axis in range(3):
        for side in (-1.0, 1.0):
            points = np.empty((divisions + 1, divisions + 1, 3))
            points[..., axis] = side
            points[..., (axis + 1) % 3] = ticks[:, None]
            points[..., (axis + 2) % 3] = ticks
            ids = [[vertex(point) for point in row] for row in points]
            for i in range(divisions):
                for j in range(divisions):
                    a, b, c, d = ids[i][j], ids[i + 1][j], ids[i + 1][j + 1], ids[i][j + 1]
                    triangles += [(a, b, c), (a, c, d)] if side > 0 else [(a, c, b), (a, d, c)]
    return np.array(vertices), np.array(triangles)


def inner_radius(vertices, triangles):
    """The smallest distance of a face's plane from the centre."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    return np.min(np.abs(np.einsum("ij,ij->i", normals, a)) / np.linalg.norm(normals, axis=1))


def roots(origins, directions, radius):
    """Where rays enter and leave a sphere around 0; NaN for those that miss it."""
    a = np.einsum("ij,ij->i", directions, directions)
    b = np.einsum("ij,ij->i", directions, origins)
    c = np.einsum("ij,ij->i", origins, origins) - radius**2
    with np.errstate(invalid="ignore"):
        half = np.sqrt(b * b - a * c)
    return (-b - half) / a, (-b + half) / a


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


failures = []


def expect(holds, what):
    if not np.all(holds):
        failures.append(what)
        print(f"WRONG: {what}")


def main():
    vertices, triangles = sphere_mesh(24)
    inner = inner_radius(vertices, triangles)
    print(f"raywise {raywise.version()} from {raywise.library_path()}")
    print(f"sphere: {len(vertices):,} vertices, {len(triangles):,} triangles, inner radius {inner:.5f}")

    random = np.random.default_rng(1)
    count = 50_000
    origins = random.normal(size=(count, 3))
    origins *= 3 / np.linalg.norm(origins, axis=1, keepdims=True)
    directions = random.uniform(-1.2, 1.2, (count, 3)) - origins
    distance = np.linalg.norm(np.cross(origins, directions), axis=1) / np.linalg.norm(directions, axis=1)
    through, past = distance < inner, distance > 1

    with raywise.Scene(vertices, triangles, expected_rays=count, kind="random") as scene:
        hits = scene.intersect(origins, directions)
        expect(hits.hit[through], "rays through the inner sphere hit")
        expect(~hits.hit[past], "rays that pass the outer sphere miss")

        outer_enter, outer_leave = roots(origins[through], directions[through], 1.0)
        inner_enter, inner_leave = roots(origins[through], directions[through], inner)
        slack = 1e-12
        t = hits.t[through]
        expect((outer_enter - slack <= t) & (t <= inner_enter + slack), "hits lie between both spheres")

        points = origins[through] + t[:, None] * directions[through]
        corners = vertices[triangles[hits.primitive[through]]]
        u, v = hits.uv[through].T
        mixed = (1 - u - v)[:, None] * corners[:, 0] + u[:, None] * corners[:, 1] + v[:, None] * corners[:, 2]
        expect(np.abs(points - mixed) < 1e-12, "u and v name the point that t names")
        expect(np.einsum("ij,ij->i", hits.normal[through], points) > 0, "normals point outwards")
        expect(np.abs(np.linalg.norm(hits.normal[through], axis=1) - 1) < 1e-12, "normals have unit length")

        every = scene.intersect_all(origins[through], directions[through])
        expect(every.counts >= 2, "a closed mesh is entered and left")
        last = every.t[every.offsets[1:] - 1]
        expect((inner_leave - slack <= last) & (last <= outer_leave + slack), "rays leave between both spheres")
        expect(scene.occluded(origins, directions) == hits.hit, "occluded agrees with intersect")

        light = np.array([0.0, 0.0, 5.0])
        lit = points[:1000] * 1.001
        view = scene.view(origin=light, kind="shadow", expected_rays=len(lit))
        in_shadow = view.occluded(lit, light - lit, tmax=1.0)
        facing = np.einsum("ij,ij->i", unit(lit), unit(light - lit))
        expect(~in_shadow[facing > 0.1], "the side towards the light is lit")
        expect(in_shadow[facing < -0.1], "the far side is in shadow")

        with raywise.Scene(vertices, triangles, structure="linear_scan") as judge:
            sample = slice(0, 2000)
            expected = judge.intersect(origins[sample], directions[sample])
            for name, values in expected.arrays.items():
                expect(values.tobytes() == hits.arrays[name][sample].tobytes(), f"{name}: same bits as the plain scan")

        print(f"{np.count_nonzero(hits.hit):,} of {count:,} rays hit")
        print(scene.explain())

    print("wrong" if failures else "all answers are right")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

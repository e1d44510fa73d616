// What exact arithmetic says about a ray in a scene of several meshes: the judge of tests/oracle, with intervals, ids, and
// the rule by which all hits are counted.
#pragma once

#include "contract/expectation.h"
#include "contract/library.h"
#include "oracle/judge.h"

#include <vector>

namespace raywise::contract {

using oracle::Fraction;

struct ExactAnswer {
    Fraction t;
    PrimitiveId id;
    bool counted; // one of the hits that are listed; see below
};

struct ExactAnswers {
    // Every triangle the ray touches within [tmin, tmax], in the order of t, then of the id. Edges and corners belong
    // to a triangle; one without area, or edge-on to the ray, is never touched. So the first is the closest hit.
    std::vector<ExactAnswer> touched;
    // The hits that are listed and counted: those of the ray moved sideways by next to nothing, towards the inside of the
    // first triangle touched. So a surface is crossed once even where the ray passes through an edge. False when their
    // number depends on where inside (counted then means towards its middle); parity never does on a closed mesh.
    bool count_certain = true;

    std::size_t count() const;
};

class ExactScene {
public:
    explicit ExactScene(const std::vector<Mesh>& meshes);

    ExactAnswers answers(const Ray& ray) const;

    // Distance from the origin to the farthest corner, in units of the direction: what tolerances of t refer to.
    double reach(const Ray& ray) const;

    // How far the ray's point at t is from a triangle, in units of the direction; rounded. Infinite where there is no such
    // triangle or it has no area.
    double distance(const Ray& ray, double t, const PrimitiveId& id) const;

    // Whether the ray runs in the triangle's plane, exactly.
    bool is_edge_on(const Ray& ray, const PrimitiveId& id) const;

private:
    struct Triangle {
        Vec3 corners[3];
        Vec3 lower;
        Vec3 upper;
        PrimitiveId id;
    };
    bool may_touch(const Triangle& triangle, const Ray& ray, double slack) const;
    const Triangle* find(const PrimitiveId& id) const;

    std::vector<Triangle> triangles_;
    Vec3 lower_{0.0};
    Vec3 upper_{0.0};
};

} // namespace raywise::contract

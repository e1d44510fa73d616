#include "bench/subjects/cgal_subject.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <cmath>
#include <vector>

namespace raywise::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Triangle = Kernel::Triangle_3;
using Tree = CGAL::AABB_tree<
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>>>;

// CGAL has rays that begin at their origin, and segments. An interval moves their ends; it finds the first hit of rays alone.
class CgalQuery : public Query {
public:
    CgalQuery(const Tree& tree, const QueryRequest& request) : tree_(tree), question_(request.question) {
        const RaySet& rays = request.rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Vector along(static_cast<double>(rays.direction[3 * i]),
                               static_cast<double>(rays.direction[3 * i + 1]),
                               static_cast<double>(rays.direction[3 * i + 2]));
            const Point origin(static_cast<double>(rays.origin[3 * i]), static_cast<double>(rays.origin[3 * i + 1]),
                               static_cast<double>(rays.origin[3 * i + 2]));
            const Point begin = origin + static_cast<double>(rays.tmin[i]) * along;
            if (std::isinf(rays.tmax[i]))
                rays_.emplace_back(begin, along);
            else
                segments_.emplace_back(begin, origin + static_cast<double>(rays.tmax[i]) * along);
        }
    }

    std::uint64_t ask(std::size_t first, std::size_t last) override {
        std::uint64_t hits = 0;
        for (std::size_t i = first; i < last; ++i) {
            if (!segments_.empty())
                hits += tree_.do_intersect(segments_[i]) ? 1 : 0;
            else if (question_ == Question::any)
                hits += tree_.do_intersect(rays_[i]) ? 1 : 0;
            else
                hits += tree_.first_intersection(rays_[i]) ? 1 : 0;
        }
        return hits;
    }

private:
    const Tree& tree_;
    Question question_;
    std::vector<Kernel::Ray_3> rays_;         // all are rays,
    std::vector<Kernel::Segment_3> segments_; // or all are segments
};

class CgalScene : public Built {
public:
    explicit CgalScene(const workloads::Mesh& mesh) {
        const auto point = [&](std::size_t corner) {
            const float* const v = &mesh.vertices[3 * std::size_t{mesh.indices[corner]}];
            return Point(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
        };
        triangles_.reserve(mesh.triangle_count());
        for (std::size_t i = 0; i < mesh.triangle_count(); ++i)
            triangles_.emplace_back(point(3 * i), point(3 * i + 1), point(3 * i + 2));
        tree_.insert(triangles_.cbegin(), triangles_.cend());
        tree_.build();
    }

    std::unique_ptr<Query> query(const QueryRequest& request) const override {
        return std::make_unique<CgalQuery>(tree_, request);
    }

private:
    std::vector<Triangle> triangles_;
    Tree tree_;
};

class Cgal : public Subject {
public:
    using Subject::Subject;
    std::unique_ptr<Built> build(const BuildRequest& request) const override {
        return std::make_unique<CgalScene>(request.mesh);
    }
};

} // namespace

std::unique_ptr<Subject> cgal_subject() {
    Traits traits;
    traits.name = "CGAL";
    traits.slow = true;
    traits.calls = {Call::single};
    return std::make_unique<Cgal>(std::move(traits));
}

std::string cgal_version() { return CGAL_VERSION_STR; }

} // namespace raywise::bench

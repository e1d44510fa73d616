#include "contract/peers/cgal_peer.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace raywise::contract {
namespace {

// In units of the direction. By its largest component, which alone cannot underflow.
double parameter_of(const Vec3& point, const Ray& ray) {
    const Vec3 size = glm::abs(ray.direction);
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    return (at(point, axis) - at(ray.origin, axis)) / at(ray.direction, axis);
}

template <class Kernel>
class CgalScene : public Scene {
    using Point = typename Kernel::Point_3;
    using Vector = typename Kernel::Vector_3;
    using Segment = typename Kernel::Segment_3;
    using HalfLine = typename Kernel::Ray_3;
    using Triangle = typename Kernel::Triangle_3;
    using Iterator = typename std::vector<Triangle>::const_iterator;
    using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>>;

public:
    explicit CgalScene(const std::vector<Mesh>& meshes) {
        for (std::size_t geometry = 0; geometry < meshes.size(); ++geometry) add(meshes[geometry], geometry);
        tree_.insert(triangles_.cbegin(), triangles_.cend());
        tree_.build();
    }

    Answer closest(const Ray& ray) override {
        if (unbounded(ray)) {
            const auto found = tree_.first_intersection(half_line(ray));
            return found ? answer_of(found->first, found->second, ray) : Answer();
        }
        // CGAL finds the first intersection of rays alone; of a segment it lists all.
        std::vector<Answer> answers;
        all(ray, answers);
        return answers.empty() ? Answer() : answers.front();
    }

    bool any(const Ray& ray) override {
        return std::isinf(ray.tmax) ? tree_.do_intersect(half_line(ray)) : tree_.do_intersect(segment(ray));
    }

    void all(const Ray& ray, std::vector<Answer>& answers) override {
        answers.clear();
        if (std::isinf(ray.tmax))
            list(half_line(ray), ray, answers);
        else
            list(segment(ray), ray, answers);
        std::stable_sort(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) { return a.t < b.t; });
    }

    void closest_batch(const std::vector<Ray>&, std::vector<Answer>&) override {
        throw Inexpressible("no call for many rays");
    }

private:
    struct Id {
        std::uint32_t geometry;
        std::uint32_t primitive;
    };

    void add(const Mesh& mesh, std::size_t geometry) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto& corners = mesh.triangles[i];
            for (const std::uint32_t corner : corners)
                if (corner >= mesh.vertices.size()) throw Inexpressible("a triangle of CGAL's has corners, no indices");
            triangles_.emplace_back(point(mesh.vertices[corners[0]]), point(mesh.vertices[corners[1]]),
                                    point(mesh.vertices[corners[2]]));
            ids_.push_back({static_cast<std::uint32_t>(geometry), static_cast<std::uint32_t>(i)});
        }
    }

    static Point point(const Vec3& v) { return Point(v.x, v.y, v.z); }

    static bool unbounded(const Ray& ray) { return std::isinf(ray.tmax) && ray.tmax > 0.0; }

    // CGAL's rays begin where they begin, so an interval moves their ends.
    static Point point_at(const Ray& ray, double t) {
        if (t == 0.0) return point(ray.origin);
        Vec3 end;
        for (int axis = 0; axis < 3; ++axis) {
            const double o = at(ray.origin, axis);
            const double step = t * at(ray.direction, axis);
            const double sum = o + step;
            const double step_error = std::fma(t, at(ray.direction, axis), -step);
            const double sum_error = (o - (sum - (sum - o))) + (step - (sum - o)); // Knuth's two-sum
            if (step_error != 0.0 || sum_error != 0.0)
                throw Inexpressible("CGAL takes an interval by its ends, and the end has no float64 coordinates");
            end[axis] = sum;
        }
        return point(end);
    }

    static HalfLine half_line(const Ray& ray) {
        if (ray.tmax < ray.tmin) throw Inexpressible("CGAL has no inverted interval");
        if (std::isinf(ray.tmin)) throw Inexpressible("CGAL has no ray without a beginning");
        return HalfLine(point_at(ray, ray.tmin), Vector(ray.direction.x, ray.direction.y, ray.direction.z));
    }

    static Segment segment(const Ray& ray) {
        if (ray.tmax < ray.tmin) throw Inexpressible("CGAL has no inverted interval");
        if (ray.tmin == ray.tmax) throw Inexpressible("CGAL demands a segment with two different ends");
        if (std::isinf(ray.tmin)) throw Inexpressible("CGAL has no ray without a beginning");
        return Segment(point_at(ray, ray.tmin), point_at(ray, ray.tmax));
    }

    template <class Query>
    void list(const Query& query, const Ray& ray, std::vector<Answer>& answers) {
        std::vector<typename Tree::template Intersection_and_primitive_id<Query>::Type> found;
        tree_.all_intersections(query, std::back_inserter(found));
        for (const auto& [where, id] : found) answers.push_back(answer_of(where, id, ray));
    }

    // A ray in the plane of a triangle meets it in a segment, of which the nearer end counts.
    template <class Where>
    Answer answer_of(const Where& where, Iterator id, const Ray& ray) const {
        const auto t_of = [&ray](const Point& p) { return parameter_of(Vec3(p.x(), p.y(), p.z()), ray); };
        Answer answer;
        answer.hit = true;
        if (const Point* at_point = boost::get<Point>(&where)) {
            answer.t = t_of(*at_point);
        } else {
            const Segment& along = *boost::get<Segment>(&where);
            answer.t = std::min(t_of(along.source()), t_of(along.target()));
        }
        answer.u = answer.v = std::numeric_limits<double>::quiet_NaN(); // CGAL tells none
        const Id which = ids_[static_cast<std::size_t>(id - triangles_.cbegin())];
        answer.geometry = which.geometry;
        answer.primitive = which.primitive;
        return answer;
    }

    std::vector<Triangle> triangles_;
    std::vector<Id> ids_;
    Tree tree_;
};

template <class Kernel>
class Cgal : public Library {
public:
    explicit Cgal(std::string name) : name_(std::move(name)) {}

    std::string name() const override { return name_; }

    Capabilities capabilities() const override {
        Capabilities capabilities;
        capabilities.orders_ties = false;
        capabilities.decides_exactly = false;
        capabilities.counts_crossings = false;
        capabilities.t_tolerance = 1e-9;
        return capabilities;
    }

    std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) override {
        return std::make_unique<CgalScene<Kernel>>(meshes);
    }

private:
    std::string name_;
};

} // namespace

std::unique_ptr<Library> make_cgal_simple_cartesian() {
    return std::make_unique<Cgal<CGAL::Simple_cartesian<double>>>("CGAL Simple_cartesian");
}

std::unique_ptr<Library> make_cgal_exact_predicates() {
    return std::make_unique<Cgal<CGAL::Exact_predicates_inexact_constructions_kernel>>("CGAL EPICK");
}

std::string cgal_version() { return CGAL_VERSION_STR; }

} // namespace raywise::contract

#include "contract/exact_hits.h"

#include "contract/nearness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace raywise::contract {
namespace {

using Point = std::array<Fraction, 3>;

Point exact(const Vec3& v) { return {oracle::exact(v.x), oracle::exact(v.y), oracle::exact(v.z)}; }
Point minus(const Point& a, const Point& b) {
    return {Fraction(a[0] - b[0]), Fraction(a[1] - b[1]), Fraction(a[2] - b[2])};
}
Point cross(const Point& a, const Point& b) {
    return {Fraction(a[1] * b[2] - a[2] * b[1]), Fraction(a[2] * b[0] - a[0] * b[2]),
            Fraction(a[0] * b[1] - a[1] * b[0])};
}
Fraction dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// A vector of which only the direction matters, so that integers will do: they need no common divisors.
using Direction = std::array<oracle::Integer, 3>;

Direction direction_of(const Point& v) {
    oracle::Integer common = 1;
    for (const Fraction& x : v) common = lcm(common, denominator(x));
    Direction result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = numerator(v[i]) * (common / denominator(v[i]));
    return result;
}
Direction opposite(Direction v) {
    for (oracle::Integer& x : v) x = -x;
    return v;
}

// Which way a ray is moved aside by next to nothing: along the first vector, by far less along the second, and so on.
using Movement = std::vector<Direction>;

// A triangle touched at its border, as far as moving the ray concerns it.
class Touch {
public:
    Touch(const oracle::ExactHit& hit, const Vec3* corners, const Point& direction) {
        const Fraction weights[3] = {Fraction(1 - hit.u - hit.v), hit.u, hit.v};
        for (std::size_t i = 0; i < 3; ++i) {
            if (weights[i] != 0) continue;
            // The weight of corner i falls to zero along the opposite edge, and grows towards the corner.
            const Point begin = exact(corners[(i + 1) % 3]);
            const Point edge = minus(exact(corners[(i + 2) % 3]), begin);
            const Point across = cross(direction, edge);
            const Direction growth = direction_of(across);
            edges_.push_back({direction_of(edge), growth});
            growths_.push_back(dot(across, minus(exact(corners[i]), begin)) < 0 ? opposite(growth) : growth);
        }
    }

    struct Edge {
        Direction along;
        Direction across;
    };
    // Those the ray passes through.
    const std::vector<Edge>& edges() const { return edges_; }

    bool is_hit_when_moved(const Movement& movement) const {
        return std::all_of(growths_.begin(), growths_.end(), [&](const Direction& growth) {
            for (const Direction& step : movement) {
                const oracle::Integer change = growth[0] * step[0] + growth[1] * step[1] + growth[2] * step[2];
                const int sign = change.sign();
                if (sign != 0) return sign > 0;
            }
            return false;
        });
    }

private:
    std::vector<Edge> edges_;
    std::vector<Direction> growths_; // of the weights that are zero, as the ray is moved
};

// Towards the middle of the first triangle; along the axes when that is along an edge of another.
Movement towards_the_inside(const oracle::ExactHit& hit, const Vec3* corners) {
    const Point a = exact(corners[0]);
    const Point e1 = minus(exact(corners[1]), a);
    const Point e2 = minus(exact(corners[2]), a);
    const Fraction third(1, 3);
    Point movement;
    for (std::size_t axis = 0; axis < 3; ++axis)
        movement[axis] = (third - hit.u) * e1[axis] + (third - hit.v) * e2[axis];
    return {direction_of(movement), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

// Both sides of every edge that the ray passes through, both ways along it: whatever there is to find by moving the ray is found
// by one of these.
std::vector<Movement> all_movements(const std::vector<Touch>& touches) {
    std::vector<Movement> movements;
    for (const Touch& touch : touches) {
        for (const auto& [along, across] : touch.edges()) {
            for (const Direction& first : {along, opposite(along)}) {
                movements.push_back({first, across});
                movements.push_back({first, opposite(across)});
            }
        }
    }
    return movements;
}

bool is_extreme(double x) { return x != 0.0 && !(std::fabs(x) > 1e-100 && std::fabs(x) < 1e100); }
bool is_extreme(const Vec3& v) { return is_extreme(v.x) || is_extreme(v.y) || is_extreme(v.z); }

long double length(const Vec3& v) {
    return std::hypot(static_cast<long double>(v.x), static_cast<long double>(v.y), static_cast<long double>(v.z));
}

} // namespace

std::size_t ExactAnswers::count() const {
    return static_cast<std::size_t>(
        std::count_if(touched.begin(), touched.end(), [](const ExactAnswer& answer) { return answer.counted; }));
}

ExactScene::ExactScene(const std::vector<Mesh>& meshes) {
    for (std::uint32_t g = 0; g < meshes.size(); ++g) {
        const Mesh& mesh = meshes[g];
        for (std::uint32_t p = 0; p < mesh.triangles.size(); ++p) {
            Triangle triangle{};
            triangle.id = {g, p};
            bool valid = true;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t corner = mesh.triangles[p][i];
                valid = valid && corner < mesh.vertices.size() && is_finite(mesh.vertices[corner]);
                if (valid) triangle.corners[i] = mesh.vertices[corner];
            }
            if (!valid) continue; // never hit, where it is accepted at all
            triangle.lower = glm::min(glm::min(triangle.corners[0], triangle.corners[1]), triangle.corners[2]);
            triangle.upper = glm::max(glm::max(triangle.corners[0], triangle.corners[1]), triangle.corners[2]);
            lower_ = triangles_.empty() ? triangle.lower : glm::min(lower_, triangle.lower);
            upper_ = triangles_.empty() ? triangle.upper : glm::max(upper_, triangle.upper);
            triangles_.push_back(triangle);
        }
    }
}

double ExactScene::reach(const Ray& ray) const {
    const auto farthest = [&](int axis) {
        const auto o = static_cast<long double>(at(ray.origin, axis));
        return std::max(std::fabs(at(lower_, axis) - o), std::fabs(at(upper_, axis) - o));
    };
    return static_cast<double>(std::hypot(farthest(0), farthest(1), farthest(2)) / length(ray.direction));
}

const ExactScene::Triangle* ExactScene::find(const PrimitiveId& id) const {
    const auto found =
        std::find_if(triangles_.begin(), triangles_.end(), [&](const Triangle& triangle) { return triangle.id == id; });
    return found == triangles_.end() ? nullptr : &*found;
}

double ExactScene::distance(const Ray& ray, double t, const PrimitiveId& id) const {
    const Triangle* triangle = find(id);
    if (triangle == nullptr) return std::numeric_limits<double>::infinity();
    return contract::distance(ray.origin + t * ray.direction, triangle->corners) / glm::length(ray.direction);
}

bool ExactScene::is_edge_on(const Ray& ray, const PrimitiveId& id) const {
    const Triangle* triangle = find(id);
    if (triangle == nullptr || !is_finite(ray.origin) || !is_finite(ray.direction)) return false;
    const Point a = exact(triangle->corners[0]);
    const Point normal = cross(minus(exact(triangle->corners[1]), a), minus(exact(triangle->corners[2]), a));
    return dot(exact(ray.direction), normal) == 0 && dot(minus(exact(ray.origin), a), normal) == 0;
}

// A slab test that leaves a thousand times more room than its rounding needs, so that the judge is asked about everything the ray
// could touch and not about all the rest.
bool ExactScene::may_touch(const Triangle& triangle, const Ray& ray, double slack) const {
    double near = -std::numeric_limits<double>::infinity();
    double far = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = (at(triangle.lower, axis) - at(ray.origin, axis)) - slack;
        const double high = (at(triangle.upper, axis) - at(ray.origin, axis)) + slack;
        const double d = at(ray.direction, axis);
        if (d == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        near = std::max(near, std::min(low / d, high / d));
        far = std::min(far, std::max(low / d, high / d));
    }
    return near <= far;
}

ExactAnswers ExactScene::answers(const Ray& ray) const {
    ExactAnswers result;
    if (!is_finite(ray.origin) || !is_finite(ray.direction) || ray.direction == Vec3(0.0) || !(ray.tmin <= ray.tmax))
        return result;

    // Numbers near the ends of float64's range would over- or underflow in the slab test.
    const bool can_sift =
        !is_extreme(ray.origin) && !is_extreme(ray.direction) && !is_extreme(lower_) && !is_extreme(upper_);
    const double slack = 1e-12 * max_component(glm::max(glm::abs(lower_ - ray.origin), glm::abs(upper_ - ray.origin)));
    oracle::Scene sifted;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        if (can_sift && !may_touch(triangles_[i], ray, slack)) continue;
        const auto first = static_cast<std::uint32_t>(sifted.vertices.size());
        for (const Vec3& corner : triangles_[i].corners) sifted.vertices.push_back(corner);
        sifted.triangles.push_back({first, first + 1, first + 2});
        kept.push_back(i);
    }

    const auto within = [&](const Fraction& t) {
        const bool after = std::isinf(ray.tmin) ? ray.tmin < 0 : t >= oracle::exact(ray.tmin);
        return after && (std::isinf(ray.tmax) ? ray.tmax > 0 : t <= oracle::exact(ray.tmax));
    };
    const Point direction = exact(ray.direction);
    std::vector<Touch> touches;
    Movement inside;
    for (const oracle::ExactHit& hit : oracle::Judge(sifted).line_hits(ray)) {
        if (!within(hit.t)) continue;
        const Triangle& triangle = triangles_[kept[hit.primitive]];
        if (touches.empty()) inside = towards_the_inside(hit, triangle.corners);
        result.touched.push_back({hit.t, triangle.id, true});
        touches.emplace_back(hit, triangle.corners, direction);
    }
    if (std::all_of(touches.begin(), touches.end(), [](const Touch& touch) { return touch.edges().empty(); }))
        return result;

    for (std::size_t i = 0; i < touches.size(); ++i) result.touched[i].counted = touches[i].is_hit_when_moved(inside);
    const auto expected = static_cast<std::ptrdiff_t>(result.count());
    for (const Movement& movement : all_movements(touches)) {
        if (!touches.front().is_hit_when_moved(movement)) continue; // not towards its inside
        const auto count = std::count_if(touches.begin(), touches.end(),
                                         [&](const Touch& touch) { return touch.is_hit_when_moved(movement); });
        if (count != expected) result.count_certain = false;
    }
    return result;
}

} // namespace raywise::contract

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
Fraction determinant(const Point& a, const Point& b, const Point& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Points inside the first triangle to move towards, as weights of its corners. None is special, so that the moved ray is
// on no edge of another triangle either.
const std::array<std::array<Fraction, 2>, 3> insides = {{{Fraction(331, 1000), Fraction(337, 1000)},
                                                         {Fraction(719, 1000), Fraction(137, 1000)},
                                                         {Fraction(127, 1000), Fraction(701, 1000)}}};

struct Touch {
    oracle::ExactHit hit;
    const Vec3* corners;

    bool on_border() const { return hit.u == 0 || hit.v == 0 || hit.u + hit.v == 1; }
};

// Whether the ray still hits when it is moved sideways by next to nothing.
// -1: no, 1: yes, 0: it then runs along the border.
int hit_when_moved(const Touch& touch, const Point& direction, const Point& movement) {
    const Point a = exact(touch.corners[0]);
    const Point e1 = minus(exact(touch.corners[1]), a);
    const Point e2 = minus(exact(touch.corners[2]), a);
    // The movement as a part along the ray and a part in the triangle's plane, in its edges: how its weights change.
    const Fraction volume = determinant(direction, e1, e2);
    const Fraction du = determinant(direction, movement, e2) / volume;
    const Fraction dv = determinant(direction, e1, movement) / volume;
    const std::array<Fraction, 3> weights = {Fraction(1 - touch.hit.u - touch.hit.v), touch.hit.u, touch.hit.v};
    const std::array<Fraction, 3> changes = {Fraction(-du - dv), du, dv};
    int result = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        if (weights[i] != 0) continue;
        if (changes[i] < 0) return -1;
        if (changes[i] == 0) result = 0;
    }
    return result;
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
    const Point e1 = minus(exact(triangle->corners[1]), a);
    const Point e2 = minus(exact(triangle->corners[2]), a);
    return determinant(exact(ray.direction), e1, e2) == 0 && determinant(minus(exact(ray.origin), a), e1, e2) == 0;
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
    std::vector<Touch> touches;
    for (oracle::ExactHit& hit : oracle::Judge(sifted).line_hits(ray)) {
        if (!within(hit.t)) continue;
        const Triangle& triangle = triangles_[kept[hit.primitive]];
        result.touched.push_back({hit.t, triangle.id, true});
        touches.push_back({std::move(hit), triangle.corners.data()});
    }
    if (std::none_of(touches.begin(), touches.end(), [](const Touch& touch) { return touch.on_border(); }))
        return result;

    const Point direction = exact(ray.direction);
    const Vec3* first = touches.front().corners;
    const Point a = exact(first[0]);
    const Point e1 = minus(exact(first[1]), a);
    const Point e2 = minus(exact(first[2]), a);
    std::size_t counts[insides.size()] = {};
    for (std::size_t i = insides.size(); i-- > 0;) { // the first is what stays
        const Fraction u = insides[i][0] - touches.front().hit.u;
        const Fraction v = insides[i][1] - touches.front().hit.v;
        Point movement;
        for (std::size_t axis = 0; axis < 3; ++axis) movement[axis] = u * e1[axis] + v * e2[axis];
        for (std::size_t k = 0; k < touches.size(); ++k) {
            const int moved = hit_when_moved(touches[k], direction, movement);
            if (moved == 0) result.count_certain = false;
            result.touched[k].counted = moved > 0;
        }
        counts[i] = result.count();
    }
    if (counts[0] != counts[1] || counts[0] != counts[2]) result.count_certain = false;
    return result;
}

} // namespace raywise::contract

#include "oracle/compare.h"

#include "accel/scan/linear_scan.h"
#include "oracle/judge.h"
#include "oracle/plain_scan.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

namespace raywise::oracle {
namespace {

constexpr std::size_t most_faults = 20;

std::string hex(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%a", x);
    return text;
}

std::string hex(const Vec3& v) { return "{" + hex(v.x) + ", " + hex(v.y) + ", " + hex(v.z) + "}"; }

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(const PrimitiveHit& a, const PrimitiveHit& b) {
    return same_bits(a.t, b.t) && same_bits(a.u, b.u) && same_bits(a.v, b.v) && a.primitive == b.primitive;
}

std::string describe(const PrimitiveHit& hit) {
    if (!hit.is_hit()) return "no hit";
    return "primitive " + std::to_string(hit.primitive) + " at t " + hex(hit.t) + ", u " + hex(hit.u) + ", v " +
           hex(hit.v);
}

double distance(const Fraction& a, const Fraction& b) {
    const Fraction difference = a < b ? Fraction(b - a) : Fraction(a - b);
    return difference.convert_to<double>();
}

// One ray's comparison with the judge.
class Trial {
public:
    Trial(const Scene& scene, const Judge& judge, const Primitives& primitives, const Accel& accel, const Ray& ray,
          Comparison& result)
        : scene_(scene), ray_(ray), result_(result), prepared_(ray), line_hits_(judge.line_hits(ray)) {
        // As a fraction: the caller's unit may make it too small for a double.
        const Box& box = primitives.bounds();
        const double reach =
            max_component(larger(magnitudes(box.lower - ray.origin), magnitudes(box.upper - ray.origin)));
        double bound = 0x1p-37 * larger(reach, 0x1p-900);
        // A t below the normal numbers is rounded to their steps, which are coarse in units of a long direction.
        bound = larger(bound, 2.0 * prepared_.scale.from_caller(std::numeric_limits<double>::denorm_min()));
        bound_ = exact(bound) *
                 (exact(prepared_.direction[prepared_.major_axis]) / exact(ray.direction[prepared_.major_axis]));
        if (bound_ < 0) bound_ = -bound_;
        std::vector<PrimitiveHit> found;
        accel.all(ray, {}, found);
        check_hits(found);
        check_order(found);
        const PrimitiveHit closest = accel.closest(ray, {});
        const auto first = std::min_element(found.begin(), found.end());
        if (first == found.end() ? closest.is_hit() : !same_bits(*first, closest))
            fault("closest is not the first of all: " + describe(closest));
        if (accel.any(ray, {}) == found.empty()) fault("any and all differ");
        ++result_.rays;
        result_.tests += primitives.count();
        result_.hits += found.size();
    }

private:
    void fault(const std::string& text) {
        if (result_.faults.size() < most_faults) {
            result_.faults.push_back(scene_.name + ": " + text + "\n    ray " + oracle::describe(ray_));
        } else {
            result_.faults.resize(most_faults);
        }
    }
    std::string corners_of(std::uint32_t primitive) const {
        std::string text;
        for (const std::uint32_t v : scene_.triangles[primitive]) text += "\n    corner " + hex(scene_.vertices[v]);
        return text;
    }

    // -1: outside the interval, 1: inside, 0: so close to an end that either answer will do.
    int position(const Fraction& t) const {
        int inside = 1;
        if (std::isfinite(ray_.tmin)) {
            const Fraction from_start = t - exact(ray_.tmin);
            // Where a ray starts is told exactly, down to the least t there is.
            const Fraction slack = ray_.tmin == 0.0 ? exact(std::numeric_limits<double>::denorm_min()) : bound_;
            if (from_start < -slack) return -1;
            if (from_start < 0 || (ray_.tmin != 0.0 && from_start < bound_)) inside = 0;
        } else if (ray_.tmin > 0) {
            return -1;
        }
        if (std::isfinite(ray_.tmax)) {
            const Fraction to_end = exact(ray_.tmax) - t;
            if (to_end < -bound_) return -1;
            if (to_end < bound_) inside = 0;
        } else if (ray_.tmax < 0) {
            return -1;
        }
        return inside;
    }

    void check_hits(const std::vector<PrimitiveHit>& found) {
        std::map<std::uint32_t, const PrimitiveHit*> remaining;
        for (const PrimitiveHit& hit : found) {
            if (!remaining.emplace(hit.primitive, &hit).second) fault("twice: " + describe(hit));
        }
        for (const ExactHit& expected : line_hits_) {
            const auto entry = remaining.find(expected.primitive);
            const int where = position(expected.t);
            if (entry == remaining.end()) {
                if (where > 0)
                    fault("missed: primitive " + std::to_string(expected.primitive) + " at exact t " +
                          hex(expected.t.convert_to<double>()) + corners_of(expected.primitive));
                continue;
            }
            if (where < 0) fault("outside the interval: " + describe(*entry->second) + corners_of(expected.primitive));
            check_values(*entry->second, expected);
            remaining.erase(entry);
        }
        for (const auto& [primitive, hit] : remaining) fault("not there: " + describe(*hit) + corners_of(primitive));
    }

    void check_values(const PrimitiveHit& hit, const ExactHit& expected) {
        const Fraction t = exact(hit.t);
        const double t_error =
            Fraction((t < expected.t ? expected.t - t : t - expected.t) / bound_).convert_to<double>();
        const double uv_error = std::max(distance(exact(hit.u), expected.u), distance(exact(hit.v), expected.v));
        result_.worst_t = std::max(result_.worst_t, t_error);
        result_.worst_uv = std::max(result_.worst_uv, uv_error);
        if (!(t_error <= 1.0))
            fault("t is off by " + std::to_string(t_error) + " bounds: " + describe(hit) + corners_of(hit.primitive));
        if (!(uv_error <= uv_bound)) {
            fault("u, v are off by " + hex(uv_error) + ": " + describe(hit) + " instead of u " +
                  hex(expected.u.convert_to<double>()) + ", v " + hex(expected.v.convert_to<double>()) +
                  corners_of(hit.primitive));
        }
        if (hit.u < 0.0 || hit.v < 0.0 || hit.u + hit.v > 1.0 + 0x1p-50) fault("u, v are no weights: " + describe(hit));
    }

    void check_order(std::vector<PrimitiveHit> found) {
        std::sort(found.begin(), found.end());
        std::map<std::uint32_t, const Fraction*> exact_t;
        for (const ExactHit& hit : line_hits_) exact_t[hit.primitive] = &hit.t;
        for (std::size_t i = 1; i < found.size(); ++i) {
            const auto before = exact_t.find(found[i - 1].primitive);
            const auto after = exact_t.find(found[i].primitive);
            if (before == exact_t.end() || after == exact_t.end()) continue;
            if (*before->second > *after->second + 2 * bound_)
                fault("wrong order: " + describe(found[i - 1]) + " before " + describe(found[i]));
        }
    }

    const Scene& scene_;
    const Ray& ray_;
    Comparison& result_;
    ExactRay prepared_;
    std::vector<ExactHit> line_hits_;
    Fraction bound_;
};

struct Built {
    Built(Structure structure, const Primitives& primitives, const std::optional<ViewFrame>& view) : parallel(1) {
        accel = build(structure, BuildInput{primitives, {}, view, parallel, progress});
    }
    Parallel parallel;
    Progress progress;
    std::unique_ptr<Accel> accel;
};

} // namespace

std::string describe(const Ray& ray) {
    return "origin " + hex(ray.origin) + " direction " + hex(ray.direction) + " t " + hex(ray.tmin) + " ... " +
           hex(ray.tmax);
}

void Comparison::add(const Comparison& other) {
    rays += other.rays;
    tests += other.tests;
    hits += other.hits;
    worst_t = std::max(worst_t, other.worst_t);
    worst_uv = std::max(worst_uv, other.worst_uv);
    faults.insert(faults.end(), other.faults.begin(), other.faults.end());
}

std::string Comparison::text() const {
    std::ostringstream out;
    out << faults.size() << " or more faults in " << rays << " rays\n";
    for (std::size_t i = 0; i < std::min(faults.size(), std::size_t{5}); ++i) out << faults[i] << '\n';
    return out.str();
}

Comparison compare_with_judge(const Scene& scene, const std::vector<Ray>& rays) {
    Comparison result;
    const Judge judge(scene);
    const Primitives primitives = primitives_of(scene);
    const Parallel parallel(1);
    Progress progress;
    const BuildInput input{primitives, {}, std::nullopt, parallel, progress};
    BuildInput few_rays = input;
    few_rays.few_rays = true;
    // Both ways of reading the triangles in turn.
    const LinearScan gathered(input);
    const LinearScan in_place(few_rays);
    bool odd = false;
    for (const Ray& ray : rays) {
        Trial(scene, judge, primitives, odd ? in_place : gathered, ray, result);
        odd = !odd;
    }
    return result;
}

Comparison compare_with_linear_scan(Structure structure, const Scene& scene, const std::vector<Ray>& rays,
                                    const std::optional<ViewFrame>& view) {
    Comparison result;
    const Primitives primitives = primitives_of(scene);
    const Parallel parallel(1);
    Progress progress;
    const PlainScan expected(BuildInput{primitives, {}, std::nullopt, parallel, progress});
    const Built tested(structure, primitives, view);
    const auto fault = [&](const Ray& ray, const std::string& text) {
        if (result.faults.size() < most_faults) {
            result.faults.push_back(std::string(name_of(structure)) + " on " + scene.name + ": " + text + "\n    ray " +
                                    describe(ray));
        }
    };
    for (const Ray& ray : rays) {
        const PrimitiveHit wanted = expected.closest(ray, {});
        const PrimitiveHit closest = tested.accel->closest(ray, {});
        if (!same_bits(wanted, closest))
            fault(ray, "closest: " + describe(closest) + " instead of " + describe(wanted));
        if (tested.accel->any(ray, {}) != wanted.is_hit())
            fault(ray, wanted.is_hit() ? "any: misses" : "any: hits nothing that is there");

        std::vector<PrimitiveHit> all_wanted;
        std::vector<PrimitiveHit> all(1); // must be appended to, not replaced
        expected.all(ray, {}, all_wanted);
        tested.accel->all(ray, {}, all);
        if (all.empty() || all.front().is_hit()) fault(ray, "all: changes what was in the list before");
        all.erase(all.begin());
        std::sort(all.begin(), all.end());
        std::sort(all_wanted.begin(), all_wanted.end());
        if (!std::equal(all.begin(), all.end(), all_wanted.begin(), all_wanted.end(),
                        [](const PrimitiveHit& a, const PrimitiveHit& b) { return same_bits(a, b); })) {
            fault(ray, "all: " + std::to_string(all.size()) + " hits instead of " + std::to_string(all_wanted.size()));
        }
        ++result.rays;
        result.tests += primitives.count();
        result.hits += all_wanted.size();
    }
    return result;
}

} // namespace raywise::oracle

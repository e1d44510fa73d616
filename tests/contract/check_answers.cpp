#include "contract/check_answers.h"

#include "contract/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace raywise::contract {
namespace {

std::string id_text(const PrimitiveId& id) {
    return (id.geometry != 0 ? std::to_string(id.geometry) + ":" : "") + std::to_string(id.primitive);
}

PrimitiveId id_of(const Answer& answer) { return {answer.geometry, answer.primitive}; }

bool near(double a, double b, double tolerance) { return a == b || std::fabs(a - b) <= tolerance; }

std::string list_of(const std::vector<Answer>& all) {
    std::string text = std::to_string(all.size()) + (all.size() == 1 ? " hit" : " hits");
    for (std::size_t i = 0; i < all.size() && i < 4; ++i) {
        text += i == 0 ? " (t " : ", ";
        text += text_of(all[i].t);
    }
    if (all.empty()) return text;
    return text + (all.size() > 4 ? ", ...)" : ")");
}

std::string said(const Answer& answer) { return ", got " + text_of(answer); }

// Exact answers, widened and narrowed by the library's tolerance at the ends of the interval.
struct Bounds {
    Bounds(const ExactScene& exact, const Ray& ray, double tolerance, const Capabilities& capabilities)
        : exact_(exact), ray_(ray), tolerance_(tolerance), decides_exactly_(capabilities.decides_exactly) {
        Ray wide = ray;
        wide.tmin -= tolerance;
        wide.tmax += tolerance;
        possible = exact.answers(ray.tmin <= ray.tmax ? wide : ray);
        for (const ExactAnswer& answer : possible.touched) {
            const auto t = answer.t.convert_to<double>();
            certain.push_back(t >= ray.tmin + tolerance && t <= ray.tmax - tolerance);
            if (certain.back() && !first_certain) first_certain = t;
        }
    }

    bool all_certain() const { return std::find(certain.begin(), certain.end(), false) == certain.end(); }

    // Whether these are all triangles touched, each once: an honest list, though no count of crossings. Those met edge-on may be
    // in it.
    bool are_all_touched(const std::vector<Answer>& all) const {
        const auto times = [&](const PrimitiveId& id) {
            return std::count_if(all.begin(), all.end(), [&](const Answer& answer) { return id_of(answer) == id; });
        };
        for (std::size_t i = 0; i < possible.touched.size(); ++i) {
            if (certain[i] && times(possible.touched[i].id) == 0) return false;
        }
        return std::all_of(all.begin(), all.end(), [&](const Answer& answer) {
            return times(id_of(answer)) == 1 && (fault_in_place(answer).empty() || is_met_edge_on(answer));
        });
    }

    // What is wrong with a triangle being hit there; empty: nothing.
    std::string fault_in_place(const Answer& answer) const {
        for (const ExactAnswer& touch : possible.touched) {
            if (!(touch.id == id_of(answer))) continue;
            const auto t = touch.t.convert_to<double>();
            if (near(t, answer.t, tolerance_)) return "";
            return "expected triangle " + id_text(touch.id) + " at t " + text_of(t) + said(answer);
        }
        if (!decides_exactly_ && is_beside_a_touched_one(answer)) return "";
        return "expected no hit of a triangle that the ray does not touch" + said(answer);
    }

    // Whether it is a hit as good as the first one.
    bool is_first(const Answer& answer) const {
        return answer.hit && fault_in_place(answer).empty() &&
               (!first_certain || answer.t <= *first_certain + 2.0 * tolerance_);
    }

    ExactAnswers possible;
    std::optional<double> first_certain; // t of the closest hit that has to be found
    std::vector<bool> certain;           // of each possible hit: whether it has to be found

private:
    // Something is touched there, and the triangle named is next to it.
    bool is_beside_a_touched_one(const Answer& answer) const {
        const bool touched = std::any_of(
            possible.touched.begin(), possible.touched.end(),
            [&](const ExactAnswer& touch) { return near(touch.t.convert_to<double>(), answer.t, tolerance_); });
        return touched && exact_.distance(ray_, answer.t, id_of(answer)) <= tolerance_;
    }

    bool is_met_edge_on(const Answer& answer) const {
        return exact_.is_edge_on(ray_, id_of(answer)) && exact_.distance(ray_, answer.t, id_of(answer)) <= tolerance_;
    }

    const ExactScene& exact_;
    const Ray& ray_;
    double tolerance_;
    bool decides_exactly_;
};

std::string fault_in_exact(const Answers& answers, const Bounds& bounds, double tolerance, bool counts_crossings) {
    const Answer& closest = answers.closest;
    if (!closest.hit) {
        if (!bounds.first_certain) return "";
        return "expected a hit at t " + text_of(*bounds.first_certain) + said(closest);
    }
    std::string fault = bounds.fault_in_place(closest);
    if (!fault.empty()) return fault;
    if (bounds.first_certain && closest.t > *bounds.first_certain + 2.0 * tolerance)
        return "expected the closest hit, at t " + text_of(*bounds.first_certain) + said(closest);
    const bool countable = answers.all && bounds.all_certain() && bounds.possible.count_certain;
    if (!counts_crossings && answers.all && bounds.are_all_touched(*answers.all)) return "";
    if (countable && answers.all->size() != bounds.possible.count())
        return "expected " + std::to_string(bounds.possible.count()) + " hits in all, got " + list_of(*answers.all);
    return "";
}

std::string fault_in_all(const Expectation& expectation, const std::vector<Answer>& all, double tolerance) {
    const std::string got = ", got " + list_of(all);
    switch (expectation.kind) {
        case Expected::count:
            if (all.size() == static_cast<std::size_t>(expectation.numbers[0])) return "";
            return "expected " + std::to_string(static_cast<std::size_t>(expectation.numbers[0])) + " hits in all" +
                   got;
        case Expected::even:
        case Expected::outside:
            return all.size() % 2 == 0 ? "" : "expected an even number of hits" + got;
        case Expected::odd:
        case Expected::inside:
            return all.size() % 2 == 1 ? "" : "expected an odd number of hits" + got;
        default:
            break;
    }
    bool same = all.size() == expectation.numbers.size();
    for (std::size_t i = 0; same && i < all.size(); ++i) same = near(all[i].t, expectation.numbers[i], tolerance);
    return same ? "" : "expected " + text_of(expectation) + got;
}

std::string fault_in_closest(const Expectation& expectation, const Answer& closest, double tolerance) {
    const bool has_id = closest.hit && std::find(expectation.ids.begin(), expectation.ids.end(), id_of(closest)) !=
                                           expectation.ids.end();
    bool met = false;
    switch (expectation.kind) {
        case Expected::hit:
            met = closest.hit;
            break;
        case Expected::miss:
            met = !closest.hit;
            break;
        case Expected::t:
            met = closest.hit && near(closest.t, expectation.numbers[0], tolerance);
            break;
        default:
            met = has_id;
            break;
    }
    return met ? "" : "expected " + text_of(expectation) + said(closest);
}

} // namespace

Answers ask(Scene& scene, const Ray& ray, const Capabilities& capabilities) {
    Answers answers;
    answers.closest = scene.closest(ray);
    try {
        if (capabilities.has_any) answers.any = scene.any(ray);
    } catch (const Inexpressible&) {
        answers.any.reset();
    }
    try {
        if (capabilities.has_all) scene.all(ray, answers.all.emplace());
    } catch (const Inexpressible&) {
        answers.all.reset();
    }
    return answers;
}

std::string disagreement(const Answers& answers, double t_tolerance, const char*& question) {
    const Answer& closest = answers.closest;
    question = "closest";
    if (closest.hit && std::isnan(closest.t)) return "a hit with t NaN";
    question = "any";
    if (answers.any && *answers.any != closest.hit)
        return std::string("any-hit says ") + (*answers.any ? "hit" : "miss") + ", closest says " + text_of(closest);
    question = "all";
    if (!answers.all) return "";
    const std::vector<Answer>& all = *answers.all;
    if (all.empty() == closest.hit) return "all-hits says " + list_of(all) + ", closest says " + text_of(closest);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (std::isnan(all[i].t) || (i > 0 && all[i].t < all[i - 1].t))
            return "all-hits are not sorted: " + list_of(all);
    }
    if (!all.empty() && !near(all[0].t, closest.t, 2.0 * t_tolerance))
        return "the first of all hits is at t " + text_of(all[0].t) + ", closest says " + text_of(closest);
    return "";
}

Verdict check(const Expectation& expectation, const Ray& ray, const Answers& answers, const ExactScene& exact,
              const Capabilities& capabilities, std::string& why) {
    if (describe(expectation.kind).needs_all && !answers.all) return Verdict::cannot_say;
    if (expectation.kind == Expected::lowest && !capabilities.orders_ties) return Verdict::cannot_say;
    // NaN for rays without a direction, which nothing is measured along.
    const double reach = exact.reach(ray);
    const double tolerance = std::isfinite(reach) ? capabilities.t_tolerance * reach : 0.0;
    const auto bounds = [&] { return Bounds(exact, ray, tolerance, capabilities); };
    if (expectation.kind == Expected::exact) {
        why = fault_in_exact(answers, bounds(), tolerance, capabilities.counts_crossings);
    } else if (expectation.kind == Expected::plane) {
        why = answers.closest.hit ? bounds().fault_in_place(answers.closest) : "";
    } else if (describe(expectation.kind).needs_all) {
        why = fault_in_all(expectation, *answers.all, tolerance);
        if (!why.empty() && !capabilities.counts_crossings && bounds().are_all_touched(*answers.all)) why.clear();
    } else {
        why = fault_in_closest(expectation, answers.closest, tolerance);
        if (!why.empty() && expectation.kind == Expected::primitive && !capabilities.orders_ties &&
            bounds().is_first(answers.closest))
            why.clear();
    }
    return why.empty() ? Verdict::met : Verdict::not_met;
}

bool same_bits(const Answer& a, const Answer& b) {
    if (a.hit != b.hit) return false;
    if (!a.hit) return true;
    const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    return same(a.t, b.t) && same(a.u, b.u) && same(a.v, b.v) && a.geometry == b.geometry && a.primitive == b.primitive;
}

std::string text_of(const Answer& answer) {
    if (!answer.hit) return "a miss";
    return "triangle " + id_text(id_of(answer)) + " at t " + text_of(answer.t);
}

std::string text_of(const Ray& ray) {
    std::string text = "ray";
    for (int axis = 0; axis < 3; ++axis) text += " " + text_of(ray.origin[axis]);
    for (int axis = 0; axis < 3; ++axis) text += " " + text_of(ray.direction[axis]);
    if (ray.tmin != 0.0 || ray.tmax != std::numeric_limits<double>::infinity())
        text += " " + text_of(ray.tmin) + " " + text_of(ray.tmax);
    return text;
}

} // namespace raywise::contract

#include "geometry/ear_clipping.h"

#include <algorithm>

namespace raywise {
namespace {

constexpr std::uint32_t cut_off = 0xFFFFFFFFu; // instead of a neighbour

// A triangle of positive area, and what lies in it.
class Ear {
public:
    Ear(const Vec2& a, const Vec2& b, const Vec2& c) : corners_{a, b, c} {}

    struct Place {
        int sides[3]; // orientations: left of ab, of bc, of ca

        bool is_outside() const { return sides[0] < 0 || sides[1] < 0 || sides[2] < 0; }
        bool is_inside() const { return sides[0] > 0 && sides[1] > 0 && sides[2] > 0; }
        bool is_on_new_edge() const { return sides[0] > 0 && sides[1] > 0 && sides[2] == 0; }
        bool is_at_tip() const { return sides[0] == 0 && sides[1] == 0; }
    };

    Place place_of(const Vec2& p) const {
        Place place{{-1, -1, -1}};
        for (std::size_t i = 0; i < 3; ++i) {
            place.sides[i] = side(i, p);
            if (place.sides[i] < 0) break;
        }
        return place;
    }

    // Whether what leads from a point on the border straight to `to` begins inside.
    bool is_entered(const Place& from, const Vec2& to) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (from.sides[i] == 0 && side(i, to) <= 0) return false;
        }
        return true;
    }

    // Whether a point is in line with both sides of the tip, for two points on one side each.
    bool are_along_both_sides(const Vec2& on_ab, const Vec2& on_bc) const {
        return side(0, on_ab) == 0 && side(1, on_bc) == 0;
    }

private:
    int side(std::size_t i, const Vec2& p) const { return orientation(corners_[i], corners_[(i + 1) % 3], p); }

    Vec2 corners_[3];
};

} // namespace

void EarClipping::cut(const std::vector<Vec2>& points, std::vector<CornerTriple>& triangles) {
    points_ = &points;
    start();
    while (left_ > 3) {
        Rule rule = ear;
        const std::uint32_t corner = take_next(rule);
        if (applies(rule, corner)) {
            remove(corner, triangles);
        } else {
            push(corner, static_cast<Rule>(rule + 1));
        }
    }
    remove(some_corner_, triangles);
}

void EarClipping::start() {
    const auto count = static_cast<std::uint32_t>(points_->size());
    left_ = count;
    some_corner_ = 0;
    previous_.resize(count);
    next_.resize(count);
    turns_.resize(count);
    tickets_.assign(count, 0);
    for (Queue& queue : queues_) queue.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        previous_[i] = i == 0 ? count - 1 : i - 1;
        next_[i] = i + 1 == count ? 0 : i + 1;
    }
    tree_.build(*points_);
    for (std::uint32_t i = 0; i < count; ++i) {
        update_turn(next_[i]);
        push(next_[i], ear);
    }
}

// There always is one: every corner that is left waits in one queue.
std::uint32_t EarClipping::take_next(Rule& rule) {
    std::size_t i = 0;
    for (;;) {
        Entry entry{};
        if (!queues_[i].pop(entry)) {
            ++i;
        } else if (next_[entry.corner] != cut_off && tickets_[entry.corner] == entry.ticket) {
            rule = static_cast<Rule>(i);
            return entry.corner;
        }
    }
}

void EarClipping::push(std::uint32_t corner, Rule rule) { queues_[rule].push({corner, ++tickets_[corner]}); }

void EarClipping::update_turn(std::uint32_t corner) {
    const std::vector<Vec2>& points = *points_;
    const int turn = orientation(points[previous_[corner]], points[corner], points[next_[corner]]);
    turns_[corner] = static_cast<std::int8_t>(turn);
    tree_.set(corner, turn <= 0);
}

void EarClipping::remove(std::uint32_t corner, std::vector<CornerTriple>& triangles) {
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    CornerTriple triangle = {before, corner, after};
    std::sort(triangle.begin(), triangle.end()); // no more than a rotation
    triangles.push_back(triangle);
    next_[before] = after;
    previous_[after] = before;
    next_[corner] = cut_off;
    tree_.set(corner, false);
    --left_;
    some_corner_ = after;
    for (const std::uint32_t neighbour : {before, after}) {
        update_turn(neighbour);
        push(neighbour, ear);
    }
}

bool EarClipping::applies(Rule rule, std::uint32_t corner) {
    switch (rule) {
        case ear:
            return turns_[corner] > 0 && is_ear(corner);
        case no_area:
            return turns_[corner] == 0;
        case left_turn:
            return turns_[corner] > 0;
        case anything:
            break;
    }
    return true;
}

bool EarClipping::is_ear(std::uint32_t corner) const {
    const std::vector<Vec2>& points = *points_;
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    const Ear triangle(points[before], points[corner], points[after]);
    bool doubled = false;
    const auto blocks = [&](std::uint32_t other) {
        if (other == before || other == corner || other == after) return false;
        const Ear::Place place = triangle.place_of(points[other]);
        if (place.is_outside()) return false;
        if (place.is_inside() || place.is_on_new_edge()) return true;
        const Vec2& to = points[next_[other]];
        const Vec2& from = points[previous_[other]];
        if (triangle.is_entered(place, from) || triangle.is_entered(place, to)) return true;
        doubled = doubled || (place.is_at_tip() && triangle.are_along_both_sides(to, from));
        return false;
    };
    if (tree_.any_in(points[before], points[corner], points[after], blocks)) return false;
    // Where the outline comes back along both sides of the tip, as around a bent line that joins two parts, the triangle may lie
    // outside of both.
    return !doubled || winding_beside(corner) > 0;
}

// How often the outline winds around a point inside the angle at a corner that turns left, nearer to it than any number: e towards
// the neighbour before and e * e towards the one after, for an infinitesimal e. Crossings of the ray from there along x.
int EarClipping::winding_beside(std::uint32_t corner) const {
    const std::vector<Vec2>& points = *points_;
    const Vec2* const places[] = {&points[corner], &points[previous_[corner]], &points[next_[corner]]};
    const auto is_above = [&](const Vec2& p) {
        if (p.y != places[0]->y) return p.y > places[0]->y;
        const Vec2& towards = places[1]->y != places[0]->y ? *places[1] : *places[2];
        return towards.y < places[0]->y;
    };
    const auto side = [&](const Vec2& a, const Vec2& b) {
        for (const Vec2* place : places) {
            const int turn = orientation(a, b, *place);
            if (turn != 0) return turn;
        }
        return 0;
    };
    int winding = 0;
    std::uint32_t from = corner;
    for (std::uint32_t i = 0; i < left_; ++i) {
        const std::uint32_t to = next_[from];
        const bool rises = is_above(points[to]);
        if (is_above(points[from]) != rises && side(points[from], points[to]) == (rises ? 1 : -1)) {
            winding += rises ? 1 : -1;
        }
        from = to;
    }
    return winding;
}

} // namespace raywise

// Which of a polygon's corners may lie in a triangle: a kd-tree over points of a plane that are switched on and off.
#pragma once

#include "geometry/exact.h"

#include <array>
#include <cstdint>
#include <vector>

namespace raywise {

class CornerTree {
public:
    // Over these points, which are kept; all are off. Memory of the last build is used again.
    void build(const std::vector<Vec2>& points);

    void set(std::uint32_t point, bool on) {
        if ((on_[point] != 0) == on) return;
        on_[point] = on ? 1 : 0;
        for (std::size_t node = leaf_of_[point];; node = (node - 1) / 2) {
            nodes_[node].on += on ? 1u : ~0u;
            if (node == 0) return;
        }
    }

    // Whether `blocks(point)` holds for any point that is on and lies in a, b, c (counterclockwise, with edges and corners). It is
    // asked for some points outside, too, in an order that is not specified.
    template <class Predicate>
    bool any_in(const Vec2& a, const Vec2& b, const Vec2& c, Predicate blocks) const {
        std::array<std::uint32_t, 2 * most_levels> waiting;
        std::size_t count = 0;
        waiting[count++] = 0;
        while (count > 0) {
            const std::uint32_t index = waiting[--count];
            const Node& node = nodes_[index];
            if (node.on == 0 || !may_overlap(node, a, b, c)) continue;
            if (index < first_leaf_) {
                waiting[count++] = 2 * index + 1;
                waiting[count++] = 2 * index + 2;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.end; ++i) {
                if (on_[order_[i]] != 0 && blocks(order_[i])) return true;
            }
        }
        return false;
    }

private:
    static constexpr std::uint32_t leaf_size = 8;
    static constexpr std::size_t most_levels = 32;

    struct Node { // its children are 2 * index + 1 and 2 * index + 2
        Vec2 lower;
        Vec2 upper;
        std::uint32_t first; // of order_
        std::uint32_t end;
        std::uint32_t on; // points below that are on
    };

    // Exact; true for some boxes beside a corner.
    static bool may_overlap(const Node& node, const Vec2& a, const Vec2& b, const Vec2& c) {
        if (std::max({a.x, b.x, c.x}) < node.lower.x || std::min({a.x, b.x, c.x}) > node.upper.x) return false;
        if (std::max({a.y, b.y, c.y}) < node.lower.y || std::min({a.y, b.y, c.y}) > node.upper.y) return false;
        return !lies_right(node, a, b) && !lies_right(node, b, c) && !lies_right(node, c, a);
    }

    // Whether all of the box does: its leftmost corner, seen along the edge.
    static bool lies_right(const Node& node, const Vec2& from, const Vec2& to) {
        const Vec2 leftmost(to.y >= from.y ? node.lower.x : node.upper.x, to.x >= from.x ? node.upper.y : node.lower.y);
        return orientation(from, to, leftmost) < 0;
    }

    void fill(std::uint32_t index, std::uint32_t first, std::uint32_t end, const std::vector<Vec2>& points);

    std::vector<Node> nodes_;
    std::uint32_t first_leaf_ = 0;     // nodes from here on
    std::vector<std::uint32_t> order_; // points, leaf by leaf
    std::vector<std::uint32_t> leaf_of_;
    std::vector<std::uint8_t> on_;
};

} // namespace raywise

// A polygon in a plane cut into triangles, ear by ear (Meisters 1975, "Polygons Have Ears"), on exact signs.
//
// An ear is a corner whose triangle, made with its two neighbours, lies inside the polygon; it can be cut off, and what is left is
// a polygon again. Every simple polygon of more than three corners has two. Nothing but cutting an ear next to it changes whether
// a corner is one, so that each corner is looked at once and then once for each neighbour cut off. Exporters write more than
// simple polygons: holes joined to the outline by an edge there and back, corners that touch other corners or edges, corners
// repeated or in line. As long as the outline nowhere crosses itself, all are cut into triangles that cover the inside once.
#pragma once

#include "base/vec.h"
#include "geometry/corner_tree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace raywise {

using CornerTriple = std::array<std::uint32_t, 3>; // positions of corners in the polygon, ascending

class EarClipping {
public:
    // Appends the n - 2 triangles of a polygon of n >= 3 corners, in the order in which they are cut off. points: seen counter-
    // clockwise. Memory is used again by the next polygon.
    void cut(const std::vector<Vec2>& points, std::vector<CornerTriple>& triangles);

private:
    // Why a corner may be cut off. While a rule applies to any corner, no later one is tried.
    enum Rule : std::uint8_t {
        ear,       // the triangle holds nothing else of the outline, nor does its new edge
        no_area,   // the corner is in line with its neighbours, or where one of them is
        left_turn, // from here on the outline crosses itself
        anything,
    };
    static constexpr std::size_t rule_count = 4;

    struct Entry {
        std::uint32_t corner;
        std::uint32_t ticket; // the entry is void when the corner has a later one
    };

    // Corners in question, first come, first served.
    class Queue {
    public:
        void clear() {
            entries_.clear();
            next_ = 0;
        }
        void push(Entry entry) { entries_.push_back(entry); }
        bool pop(Entry& entry) {
            if (next_ == entries_.size()) return false;
            entry = entries_[next_++];
            return true;
        }

    private:
        std::vector<Entry> entries_;
        std::size_t next_ = 0;
    };

    void start();
    std::uint32_t take_next(Rule& rule);
    void push(std::uint32_t corner, Rule rule);
    void update_turn(std::uint32_t corner);
    void remove(std::uint32_t corner, std::vector<CornerTriple>& triangles);

    bool applies(Rule rule, std::uint32_t corner);
    bool is_ear(std::uint32_t corner) const;
    int winding_beside(std::uint32_t corner) const;

    const std::vector<Vec2>* points_ = nullptr;
    std::vector<std::uint32_t> previous_;
    std::vector<std::uint32_t> next_;
    std::vector<std::int8_t> turns_; // orientation of previous, corner, next
    std::vector<std::uint32_t> tickets_;
    std::array<Queue, rule_count> queues_;
    // Of the corners that do not turn left: where there is something in a triangle, there is one of them.
    CornerTree tree_;
    std::uint32_t left_ = 0;
    std::uint32_t some_corner_ = 0; // that has not been cut off
};

} // namespace raywise

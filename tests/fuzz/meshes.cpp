#include "fuzz/meshes.h"

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace raywise::fuzz {
namespace {

using Triangle = std::array<std::uint64_t, 3>;

struct Shape {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    bool indexed = true;
};

// Corner by corner from the bytes: shared, repeated and degenerate corners come by themselves.
Shape free_form(Input& input) {
    Shape shape;
    const std::size_t points = input.below(16);
    for (std::size_t i = 0; i < points; ++i) {
        shape.points.push_back({input.coordinate(), input.coordinate(), input.coordinate()});
    }
    const std::size_t triangles = points == 0 ? 0 : input.below(24);
    for (std::size_t i = 0; i < triangles; ++i) {
        Triangle corners{};
        for (std::uint64_t& corner : corners) corner = input.below(points);
        shape.triangles.push_back(corners);
    }
    return shape;
}

// Each triangle with corners of its own.
Shape unindexed(Input& input) {
    Shape shape;
    shape.indexed = false;
    const std::size_t triangles = input.below(12);
    for (std::size_t i = 0; i < 3 * triangles; ++i) {
        shape.points.push_back({input.coordinate(), input.coordinate(), input.coordinate()});
    }
    for (std::size_t i = 0; i < triangles; ++i) shape.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    return shape;
}

// A sheet of squares, flat or bumpy, across an axis: closed along its edges, in grid cells' planes.
Shape sheet(Input& input) {
    Shape shape;
    const std::size_t side = 1 + input.below(8);
    const std::size_t axis = input.below(3);
    const bool flat = input.one_in(2);
    const double x0 = input.lattice();
    const double y0 = input.lattice();
    const double step = input.coordinate() - input.lattice();
    double height = input.coordinate();
    for (std::size_t i = 0; i <= side; ++i) {
        for (std::size_t k = 0; k <= side; ++k) {
            if (!flat) height = input.coordinate();
            Point p{};
            p[axis] = height;
            p[(axis + 1) % 3] = x0 + step * static_cast<double>(i);
            p[(axis + 2) % 3] = y0 + step * static_cast<double>(k);
            shape.points.push_back(p);
        }
    }
    for (std::size_t i = 0; i < side; ++i) {
        for (std::size_t k = 0; k < side; ++k) {
            const std::uint64_t corner = i * (side + 1) + k;
            shape.triangles.push_back({corner, corner + 1, corner + side + 1});
            shape.triangles.push_back({corner + 1, corner + side + 2, corner + side + 1});
        }
    }
    return shape;
}

// Enough triangles for deep trees, on a coarse lattice: many coincide.
Shape soup(Input& input) {
    Shape shape;
    auto state = input.raw<std::uint32_t>() | 1u;
    const auto next = [&state] { // a linear congruential generator: the same everywhere
        state = state * 1664525u + 1013904223u;
        return state >> 24;
    };
    const double unit = input.coordinate();
    const double scale = input.one_in(4) ? unit : 1.0;
    const std::size_t triangles = 1 + input.below(200);
    const unsigned spread = 1 + static_cast<unsigned>(input.below(16));
    for (std::size_t i = 0; i < triangles; ++i) {
        Point center{};
        for (double& x : center) x = next() % 64;
        for (int corner = 0; corner < 3; ++corner) {
            Point p{};
            for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = (center[axis] + next() % spread) * scale;
            shape.points.push_back(p);
        }
        shape.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return shape;
}

// A closed box, which may have no thickness along an axis.
Shape box(Input& input) {
    Shape shape;
    const Point low = {input.coordinate(), input.coordinate(), input.coordinate()};
    const Point high = {input.coordinate(), input.coordinate(), input.coordinate()};
    for (unsigned i = 0; i < 8; ++i) {
        Point p{};
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = (i >> axis & 1u) != 0 ? high[axis] : low[axis];
        shape.points.push_back(p);
    }
    shape.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return shape;
}

Shape make_shape(Input& input) {
    static constexpr Shape (*makers[])(Input&) = {free_form, free_form, unindexed, sheet, soup, box};
    Shape shape = input.pick(makers)(input);
    if (!shape.points.empty() && input.one_in(8)) { // faults that SKIP_INVALID is for
        shape.points[input.below(shape.points.size())][input.below(3)] = input.number();
    }
    if (!shape.triangles.empty() && shape.indexed && input.one_in(8)) {
        static constexpr std::uint64_t wrong[] = {0xFFFFFFFFu, 0x100000000u, 0xFFFFFFFFFFFFFFFFu};
        shape.triangles[input.below(shape.triangles.size())][input.below(3)] =
            input.one_in(2) ? shape.points.size() : input.pick(wrong);
    }
    return shape;
}

// All of them, some of them, or none.
std::vector<Point> move_points(Input& input, std::vector<Point> points) {
    const std::size_t way = input.below(5);
    const double by = input.coordinate();
    for (Point& p : points) {
        if (way == 0 || (way == 4 && !input.one_in(2))) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = way == 1 ? p[axis] + by : way == 2 ? p[axis] * by : way == 3 ? by : input.coordinate();
            p[axis] = x;
        }
    }
    if (!points.empty() && input.one_in(8)) points[input.below(points.size())][input.below(3)] = input.number();
    return points;
}

bool is_beyond_float(double x) { return std::fabs(x) > static_cast<double>(std::numeric_limits<float>::max()); }

} // namespace

Mesh::Mesh(Input& input) {
    make_arrays(input);
    if (input.one_in(24)) spoil(input);
    judge();
}

Mesh::Mesh(Input& input, std::shared_ptr<const Mesh> before, bool is_built_anew) : before_(std::move(before)) {
    std::vector<Point> points = move_points(input, before_->values_);
    const bool was_indexed = before_->triangles_.indices.data != nullptr;
    std::vector<Triangle> triangles = before_->corners_;
    const bool is_indexed = was_indexed && input.one_in(2);
    if (is_indexed && !triangles.empty() && input.one_in(32)) { // another number of triangles
        triangles.pop_back();
        outcome_.fails_if(!is_built_anew, RW_ERROR_INVALID_ARGUMENT);
    }
    if (is_indexed && !points.empty() && input.one_in(16)) points.pop_back(); // some indices may be out of range now
    if (!is_indexed && input.one_in(32)) {
        points.push_back({0.0, 0.0, 0.0});
        outcome_.fails_if(true, RW_ERROR_INVALID_ARGUMENT);
    }
    triangles_.struct_size = sizeof triangles_;
    triangles_.triangle_count = triangles.size();
    if (input.one_in(3)) triangles_.flags |= RW_TRIANGLES_SHARED;
    if ((before_->triangles_.flags & RW_TRIANGLES_SKIP_INVALID) != 0 && !input.one_in(8))
        triangles_.flags |= RW_TRIANGLES_SKIP_INVALID;
    describe_vertices(input, points);
    if (is_indexed) {
        describe_indices(input, triangles);
    } else {
        triangles_.indices = before_->triangles_.indices;
        keeps_indices_ = was_indexed;
        corners_ = std::move(triangles);
    }
    pack();
    judge();
}

void Mesh::make_arrays(Input& input) {
    const Shape shape = make_shape(input);
    triangles_.struct_size = sizeof triangles_;
    triangles_.triangle_count = shape.triangles.size();
    describe_vertices(input, shape.points);
    if (input.one_in(3)) triangles_.flags |= RW_TRIANGLES_SHARED;
    if (input.one_in(3)) triangles_.flags |= RW_TRIANGLES_SKIP_INVALID;
    if (shape.indexed) {
        describe_indices(input, shape.triangles);
    } else {
        corners_ = shape.triangles;
    }
    pack();
}

void Mesh::describe_vertices(Input& input, const std::vector<Point>& points) {
    vertex_array_ = InputArray::numbers(input, points.size(), 3,
                                        [&](std::uint64_t i, int c) { return points[i][static_cast<std::size_t>(c)]; });
    triangles_.vertex_count = points.size();
    triangles_.vertices = vertex_array_.array();
    for (std::uint64_t i = 0; i < points.size(); ++i) {
        values_.push_back({vertex_array_.number(i, 0), vertex_array_.number(i, 1), vertex_array_.number(i, 2)});
    }
}

void Mesh::describe_indices(Input& input, const std::vector<Triangle>& triangles) {
    index_array_ = InputArray::ids(input, triangles.size(), 3,
                                   [&](std::uint64_t i, int c) { return triangles[i][static_cast<std::size_t>(c)]; });
    triangles_.indices = index_array_.array();
    for (std::uint64_t i = 0; i < triangles.size(); ++i)
        corners_.push_back({index_array_.id(i, 0), index_array_.id(i, 1), index_array_.id(i, 2)});
}

void Mesh::pack() {
    for (const Point& p : values_) {
        for (const double x : p) {
            packed_doubles_.push_back(x);
            packed_floats_.push_back(static_cast<float>(x));
        }
    }
    for (const Triangle& t : corners_) packed_indices_.insert(packed_indices_.end(), t.begin(), t.end());
}

// Descriptions that must be refused before anything is read.
void Mesh::spoil(Input& input) {
    const auto set = [&](bool wrong, std::int32_t status) {
        outcome_.fails_if(wrong, status);
        is_described_wrongly_ = is_described_wrongly_ || wrong;
    };
    switch (input.below(7)) {
        case 0:
            triangles_.flags |= 1u << (2 + input.below(30));
            set(true, RW_ERROR_INVALID_ARGUMENT);
            break;
        case 1:
            triangles_.vertices.type = input.pick({RW_UINT8, RW_UINT32, RW_UINT64, 6, -1});
            set(true, RW_ERROR_INVALID_ARGUMENT);
            break;
        case 2:
            triangles_.indices.type = input.pick({RW_UINT8, RW_FLOAT32, RW_FLOAT64, 6, -1});
            set(!index_array_.is_absent(), RW_ERROR_INVALID_ARGUMENT);
            break;
        case 3:
            triangles_.vertices.data = nullptr;
            set(triangles_.vertex_count > 0, RW_ERROR_INVALID_ARGUMENT);
            break;
        case 4:
            triangles_.vertex_count = 0x100000000u + input.between<std::uint32_t>(0, 3);
            set(true, RW_ERROR_TOO_MANY);
            set(index_array_.is_absent(), RW_ERROR_INVALID_ARGUMENT);
            break;
        case 5:
            triangles_.triangle_count = 0xFFFFFFFFu + input.between<std::uint64_t>(0, 3);
            set(true, RW_ERROR_TOO_MANY);
            set(index_array_.is_absent(), RW_ERROR_INVALID_ARGUMENT);
            break;
        default: // no indices, and a number of vertices that does not fit
            triangles_.indices.data = nullptr;
            set(triangles_.vertex_count != 3 * triangles_.triangle_count, RW_ERROR_INVALID_ARGUMENT);
            if (!is_described_wrongly_) {
                for (std::uint64_t i = 0; i < corners_.size(); ++i) corners_[i] = {3 * i, 3 * i + 1, 3 * i + 2};
                packed_indices_.clear();
                for (const Triangle& t : corners_) packed_indices_.insert(packed_indices_.end(), t.begin(), t.end());
            }
            break;
    }
}

void Mesh::judge() {
    const bool skip = (triangles_.flags & RW_TRIANGLES_SKIP_INVALID) != 0;
    std::vector<bool> usable;
    for (const Point& p : values_) {
        bool finite = true;
        bool in_range = true;
        for (const double x : p) {
            finite = finite && std::isfinite(x);
            in_range = in_range && (!std::isfinite(x) || !is_beyond_float(x));
        }
        if (!skip) outcome_.fails_if(!finite, RW_ERROR_NOT_FINITE).fails_if(!in_range, RW_ERROR_COORDINATE_RANGE);
        usable.push_back(finite && in_range);
    }
    for (const Triangle& corners : corners_) {
        bool valid = true;
        for (const std::uint64_t corner : corners) {
            if (!skip) outcome_.fails_if(corner >= values_.size(), RW_ERROR_INDEX_OUT_OF_RANGE);
            valid = valid && corner < values_.size() && usable[corner];
        }
        invalid_.push_back(!valid);
        invalid_count_ += valid ? 0 : 1;
    }
}

rw_triangles Mesh::packed() const {
    rw_triangles t{};
    t.struct_size = sizeof t;
    t.flags = triangles_.flags & RW_TRIANGLES_SKIP_INVALID;
    t.vertex_count = values_.size();
    t.vertices.type = vertex_array_.type();
    t.vertices.data = vertex_array_.type() == RW_FLOAT32 ? static_cast<const void*>(packed_floats_.data())
                                                         : static_cast<const void*>(packed_doubles_.data());
    t.triangle_count = corners_.size();
    static constexpr std::uint64_t none = 0; // so that there are indices, none of them
    t.indices.data = packed_indices_.empty() ? &none : packed_indices_.data();
    t.indices.type = RW_UINT64;
    return t;
}

bool Mesh::is_unchanged() const {
    return vertex_array_.is_unchanged() && (index_array_.is_absent() || index_array_.is_unchanged());
}

void Mesh::describe() const {
    std::fprintf(stderr, "  %s, flags %u, %zu vertices, %zu triangles\n",
                 vertex_array_.type() == RW_FLOAT32 ? "float32" : "float64", triangles_.flags, values_.size(),
                 corners_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) {
        std::fprintf(stderr, "    v%zu {%a, %a, %a}\n", i, values_[i][0], values_[i][1], values_[i][2]);
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        std::fprintf(stderr, "    triangle %zu {%" PRIu64 ", %" PRIu64 ", %" PRIu64 "}\n", i, corners_[i][0],
                     corners_[i][1], corners_[i][2]);
    }
}

} // namespace raywise::fuzz

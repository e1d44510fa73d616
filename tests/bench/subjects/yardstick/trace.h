// A ray through the yardstick's tree.
//
// Boxes in eight lanes of float32, with a slack that is relative to the ray and to the distance alone; triangles in as many lanes
// of float64 as there are, by sheared edge functions (Woop, Benthin, Wald 2013). Where an error bound does not settle their signs, long double
// decides: it stands for exact arithmetic, and is not exact.
#pragma once

#include "bench/subjects/yardstick/tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace raywise::bench {
namespace {

struct alignas(16) YardstickRay {
    float origin[3];
    float tmin;
    float direction[3];
    float tmax;
};

struct YardstickHit {
    double t, u, v;
    std::uint32_t id;
};
constexpr std::uint32_t nothing = ~0u;

template <class D, class Mask>
HWY_INLINE std::uint32_t bits_of(D d, Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return bytes[0];
}

// A node, or most of a block.
HWY_INLINE void prefetch(const void* memory) {
    for (std::size_t i = 0; i < 256; i += 64) __builtin_prefetch(static_cast<const char*>(memory) + i);
}

inline bool decide_in_long_double(const YardstickRay& ray, const Block& block, std::size_t i, YardstickHit& hit) {
    using Real = long double;
    Real p[3][3];
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) p[k][axis] = Real(block.corner[k][axis][i]) - ray.origin[axis];
    const auto determinant = [&](const Real(&a)[3], const Real(&b)[3]) {
        return Real(ray.direction[0]) * (a[1] * b[2] - a[2] * b[1]) +
               Real(ray.direction[1]) * (a[2] * b[0] - a[0] * b[2]) +
               Real(ray.direction[2]) * (a[0] * b[1] - a[1] * b[0]);
    };
    const Real wa = determinant(p[2], p[1]), wb = determinant(p[0], p[2]), wc = determinant(p[1], p[0]);
    if (std::min({wa, wb, wc}) < 0 && std::max({wa, wb, wc}) > 0) return false;
    const Real sum = wa + wb + wc;
    if (sum == 0) return false;
    std::size_t z = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (std::abs(ray.direction[axis]) > std::abs(ray.direction[z])) z = axis;
    const Real t = (wa * p[0][z] + wb * p[1][z] + wc * p[2][z]) / sum / ray.direction[z];
    hit = {double(t), double(wb / sum), double(wc / sum), block.id[i]};
    return true;
}

// The ray in lanes, for leaves.
class LeafRay {
    using Vector = hn::VFromD<Doubles>;

public:
    HWY_INLINE explicit LeafRay(const YardstickRay& ray) : ray_(ray) {
        const float x = std::abs(ray.direction[0]), y = std::abs(ray.direction[1]), z = std::abs(ray.direction[2]);
        z_ = z > std::max(x, y) ? 2 : y > x ? 1 : 0;
        x_ = z_ == 2 ? 0 : z_ + 1;
        y_ = x_ == 2 ? 0 : x_ + 1;
        const Doubles d;
        inverse_ = 1.0 / double(ray.direction[z_]);
        shear_x_ = hn::Set(d, double(ray.direction[x_]) * inverse_);
        shear_y_ = hn::Set(d, double(ray.direction[y_]) * inverse_);
        origin_x_ = hn::Set(d, double(ray.origin[x_]));
        origin_y_ = hn::Set(d, double(ray.origin[y_]));
        origin_z_ = hn::Set(d, double(ray.origin[z_]));
        extent_ = std::max(std::abs(ray.origin[0]), std::max(std::abs(ray.origin[1]), std::abs(ray.origin[2])));
    }

    // Whether the block holds a hit closer than `hit`, which then is it.
    template <bool any>
    HWY_INLINE bool test(const Block& block, YardstickHit& hit) const {
        const Doubles d;
        const Corner a = corner(block, 0), b = corner(block, 1), c = corner(block, 2);
        const Vector wa = edge(c, b), wb = edge(a, c), wc = edge(b, a);
        const Vector lowest = hn::Min(hn::Min(wa, wb), wc), highest = hn::Max(hn::Max(wa, wb), wc);
        const double reach = double(block.extent) + double(extent_);
        const double error = 0x1p-47 * reach * reach;
        Signs signs(lowest, highest, hn::Set(d, error));
        if (HWY_LIKELY(signs.possible == 0)) return false;
        if (HWY_UNLIKELY((signs.possible & ~signs.certain) != 0)) signs = Signs(lowest, highest, own_error(a, b, c));
        std::uint32_t left = signs.possible;
        const std::uint32_t certain = signs.certain;
        const Vector sum = hn::Add(hn::Add(wa, wb), wc);
        const Vector z = hn::Add(hn::Add(hn::Mul(wa, a.z), hn::Mul(wb, b.z)), hn::Mul(wc, c.z));
        const Vector t = hn::Mul(hn::Div(z, sum), hn::Set(d, inverse_));
        const std::uint32_t inside =
            bits_of(d, hn::And(hn::Ge(t, hn::Set(d, double(ray_.tmin))), hn::Le(t, hn::Set(d, hit.t))));
        left &= inside | ~certain;
        if (left == 0) return false;
        alignas(64) double ts[block_size], us[block_size], vs[block_size];
        hn::Store(t, d, ts);
        hn::Store(hn::Div(wb, sum), d, us);
        hn::Store(hn::Div(wc, sum), d, vs);
        bool closer = false;
        for (; left != 0; left &= left - 1) {
            const auto i = static_cast<std::size_t>(__builtin_ctz(left));
            YardstickHit found{ts[i], us[i], vs[i], block.id[i]};
            if (HWY_UNLIKELY((certain >> i & 1u) == 0) &&
                !(decide_in_long_double(ray_, block, i, found) && found.t >= double(ray_.tmin)))
                continue;
            if (found.t > hit.t || (found.t == hit.t && found.id > hit.id)) continue;
            hit = found;
            if (any) return true;
            closer = true;
        }
        return closer;
    }

private:
    struct Corner {
        Vector x, y, z; // relative to the origin, sheared
    };

    // Bits of lanes: hits that an error of the edge functions leaves possible, and those that it cannot undo.
    struct Signs {
        std::uint32_t possible, certain;

        HWY_INLINE Signs(Vector lowest, Vector highest, Vector error)
            : possible(bits_of(Doubles(), hn::Or(hn::Ge(lowest, hn::Neg(error)), hn::Le(highest, error)))),
              certain(bits_of(Doubles(), hn::Or(hn::Gt(lowest, error), hn::Lt(highest, hn::Neg(error))))) {}
    };

    // From each triangle's own distances to the ray: they are small where the scene is large or far away.
    HWY_INLINE Vector own_error(const Corner& a, const Corner& b, const Corner& c) const {
        const Doubles d;
        const auto largest = [](Vector p, Vector q, Vector r)
                                 HWY_ATTR { return hn::Max(hn::Max(hn::Abs(p), hn::Abs(q)), hn::Abs(r)); };
        const Vector beside = hn::Max(largest(a.x, b.x, c.x), largest(a.y, b.y, c.y));
        const Vector sheared = hn::Mul(hn::Max(hn::Abs(shear_x_), hn::Abs(shear_y_)), largest(a.z, b.z, c.z));
        const Vector rounding = hn::Mul(hn::Set(d, 0x1p-50), hn::Add(beside, sheared));
        return hn::Mul(hn::Mul(hn::Set(d, 5.0), rounding), hn::Add(beside, rounding));
    }

    HWY_INLINE static Vector load(const float* values) {
        return hn::PromoteTo(Doubles(), hn::Load(hn::Rebind<float, Doubles>(), values));
    }
    HWY_INLINE Corner corner(const Block& block, std::size_t k) const {
        const Vector z = hn::Sub(load(block.corner[k][z_]), origin_z_);
        return {hn::Sub(hn::Sub(load(block.corner[k][x_]), origin_x_), hn::Mul(shear_x_, z)),
                hn::Sub(hn::Sub(load(block.corner[k][y_]), origin_y_), hn::Mul(shear_y_, z)), z};
    }
    HWY_INLINE static Vector edge(const Corner& p, const Corner& q) {
        return hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x));
    }

    const YardstickRay& ray_;
    std::size_t x_, y_, z_; // axes, the longest of the direction last
    double inverse_;
    Vector shear_x_, shear_y_, origin_x_, origin_y_, origin_z_;
    float extent_; // largest coordinate of the origin
};

// Not below x.
inline float rounded_up(double x) {
    return static_cast<float>(x) * (1.0f + 0x1p-22f) + std::numeric_limits<float>::min();
}

// Children still to be visited, as the distance's bits above the child: as numbers they are in the order of the distances.
class Stack {
public:
    HWY_INLINE bool empty() const { return size_ == 0; }
    HWY_INLINE void push(std::uint64_t entry) { entries_[size_++] = entry; }
    HWY_INLINE std::uint64_t pop() { return entries_[--size_]; }
    // The last `count`, the farthest first.
    HWY_INLINE void sort_last(std::size_t count) {
        std::uint64_t* const e = entries_ + size_ - count;
        if (count == 3) {
            order(e[0], e[1]), order(e[1], e[2]), order(e[0], e[1]);
        } else if (count == 4) {
            order(e[0], e[1]), order(e[2], e[3]), order(e[0], e[2]), order(e[1], e[3]), order(e[1], e[2]);
        } else {
            for (std::size_t i = 1; i < count; ++i) {
                const std::uint64_t entry = e[i];
                std::size_t place = i;
                for (; place > 0 && e[place - 1] < entry; --place) e[place] = e[place - 1];
                e[place] = entry;
            }
        }
    }

private:
    HWY_INLINE static void order(std::uint64_t& a, std::uint64_t& b) {
        const std::uint64_t larger = std::max(a, b);
        b = std::min(a, b);
        a = larger;
    }

    std::uint64_t entries_[most_levels * (node_width - 1) + 1];
    std::size_t size_ = 0;
};

class Traversal {
    using Floats = hn::FixedTag<float, node_width>;
    using Vector = hn::VFromD<Floats>;

public:
    HWY_INLINE Traversal(const Tree& tree, const YardstickRay& ray) : tree_(tree), ray_(ray), leaf_ray_(ray) {
        const hn::FixedTag<float, 4> d4;
        const Floats d;
        const auto direction = hn::Load(d4, ray.direction); // and tmax behind it, which is as good as any number
        const auto size = hn::Max(hn::Abs(direction), hn::Set(d4, 1e-18f));
        const auto inverse = hn::CopySign(hn::Div(hn::Set(d4, 1.0f), size), direction);
        // plane * inverse - offset: fused, so off by the rounding of offset on each axis, and relatively beyond that.
        const auto offset = hn::Mul(inverse, hn::Load(d4, ray.origin));
        const auto slack = hn::Mul(hn::Abs(offset), hn::Set(d4, 0x1p-21f));
        alignas(16) float inverses[4], entries[4], exits[4];
        hn::Store(inverse, d4, inverses);
        hn::Store(hn::Add(offset, slack), d4, entries);
        hn::Store(hn::Sub(offset, slack), d4, exits);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            inverse_[axis] = hn::Set(d, inverses[axis]);
            entry_[axis] = hn::Set(d, entries[axis]);
            exit_[axis] = hn::Set(d, exits[axis]);
            near_[axis] = 2 * axis + (std::signbit(ray.direction[axis]) ? 1 : 0);
        }
    }

    template <bool any>
    HWY_INLINE bool trace(YardstickHit& hit) {
        hit = {double(ray_.tmax), 0.0, 0.0, nothing};
        farthest_ = rounded_up(hit.t);
        std::uint32_t current = 0;
        for (;;) {
            if ((current & leaf_flag) == 0) {
                if (enter<any>(tree_.nodes[current], current)) continue;
            } else if (leaf_ray_.test<any>(tree_.blocks[current & ~leaf_flag], hit)) {
                if (any) return true;
                farthest_ = rounded_up(hit.t);
            }
            if (!next<any>(current)) return hit.id != nothing;
        }
    }

private:
    // Leaves the nearest child in `current` and the others on the stack; for any hit in no order. Returns whether there is one.
    template <bool any>
    HWY_INLINE bool enter(const Node& node, std::uint32_t& current) {
        const Floats d;
        const auto distance = [&](std::size_t plane, std::size_t axis, const Vector(&offset)[3]) HWY_ATTR {
            return hn::MulSub(hn::Load(d, node.planes[plane]), inverse_[axis], offset[axis]);
        };
        const Vector entry = hn::Max(hn::Max(distance(near_[0], 0, entry_), distance(near_[1], 1, entry_)),
                                     hn::Max(distance(near_[2], 2, entry_), hn::Set(d, ray_.tmin)));
        const Vector exit = hn::Min(hn::Min(distance(near_[0] ^ 1, 0, exit_), distance(near_[1] ^ 1, 1, exit_)),
                                    hn::Min(distance(near_[2] ^ 1, 2, exit_), hn::Set(d, farthest_)));
        std::uint32_t hits = bits_of(d, hn::Le(entry, hn::Mul(exit, hn::Set(d, 1.0f + 0x1p-20f))));
        if (hits == 0) return false;
        const auto take = [&hits] {
            const auto i = static_cast<std::size_t>(__builtin_ctz(hits));
            hits &= hits - 1;
            return i;
        };
        const std::size_t first = take();
        current = node.child[first];
        if (hits == 0) return true;
        if (any) {
            while (hits != 0) push(node.child[take()]);
            return true;
        }
        alignas(32) float distances[node_width];
        hn::Store(entry, d, distances);
        const auto key = [&](std::size_t i) {
            std::uint32_t bits;
            std::memcpy(&bits, &distances[i], sizeof bits);
            return std::uint64_t{bits} << 32 | node.child[i];
        };
        const std::uint64_t a = key(first), b = key(take());
        if (hits == 0) {
            push(std::max(a, b));
            current = static_cast<std::uint32_t>(std::min(a, b));
            return true;
        }
        std::size_t count = 2;
        stack_.push(a);
        push(b);
        for (; hits != 0; ++count) push(key(take()));
        stack_.sort_last(count);
        current = static_cast<std::uint32_t>(stack_.pop());
        return true;
    }

    HWY_INLINE void push(std::uint64_t entry) {
        stack_.push(entry);
        const auto child = static_cast<std::uint32_t>(entry);
        // A choice of addresses, not of branches: nobody could predict those.
        const void* const node = tree_.nodes.data() + (child & ~leaf_flag);
        const void* const block = tree_.blocks.data() + (child & ~leaf_flag);
        prefetch((child & leaf_flag) != 0 ? block : node);
    }

    template <bool any>
    HWY_INLINE bool next(std::uint32_t& current) {
        while (!stack_.empty()) {
            const std::uint64_t entry = stack_.pop();
            const auto bits = static_cast<std::uint32_t>(entry >> 32);
            float distance;
            std::memcpy(&distance, &bits, sizeof distance);
            current = static_cast<std::uint32_t>(entry);
            if (any || distance <= farthest_) return true;
        }
        return false;
    }

    const Tree& tree_;
    const YardstickRay& ray_;
    LeafRay leaf_ray_;
    std::size_t near_[3]; // planes of entry; those of exit are theirs ^ 1
    Vector inverse_[3], entry_[3], exit_[3];
    float farthest_ = 0.0f;
    Stack stack_;
};

// One call for each ray, as libraries have it.
template <bool any>
HWY_NOINLINE bool trace(const Tree& tree, const YardstickRay& ray, YardstickHit& hit) {
    return Traversal(tree, ray).trace<any>(hit);
}

} // namespace
} // namespace raywise::bench

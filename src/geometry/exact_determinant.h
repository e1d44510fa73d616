// The exact value of the determinant that tells on which side of a ray an edge passes.
#pragma once

#include "base/vec.h"

namespace raywise {

// Powers of two by which the axes are scaled before anything is multiplied, so that neither overflow nor underflow disturbs the
// result. All determinants of one triangle and ray have to use the same, and come out multiplied by the same factor.
struct AxisScale {
    int exponents[3];

    // For differences whose largest magnitudes on each axis are these; 0 where nothing differs.
    static AxisScale of(const Vec3& largest);
};

// The sign, and the value to a few units in the last place, of
//     determinant(d, p - o, q - o) = d . ((p - o) x (q - o))
// times a positive factor that depends on d and scale only. Nothing is rounded on the way: differences and products are kept as
// sums of doubles (expansions; Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", section 2).
//
// Scaling an axis of all three vectors multiplies the determinant by the scale and leaves its sign. What remains
// are numbers around 1; exactness ends only where the exponents of one axis' own numbers differ by more than about 900.
// Swapping p and q negates the result exactly.
double exact_determinant(const Vec3& d, const Vec3& o, const Vec3& p, const Vec3& q, const AxisScale& scale);

} // namespace raywise

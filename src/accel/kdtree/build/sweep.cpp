#include "accel/kdtree/build/sweep.h"

namespace raywise {

void sweep_axis(const KdEvent* first, std::size_t count, int axis, const KdTask& task, const KdCosts& costs,
                KdPlane& best) {
    const CellAreas areas(task.cell, axis);
    if (!(areas.lower < areas.upper)) return;
    std::uint32_t below = 0;
    std::uint32_t above = task.count;
    const auto consider = [&](float position, std::uint32_t n_below, std::uint32_t n_above, bool flat_below,
                              double kept) {
        const auto plane = static_cast<double>(position);
        const double tests =
            kept * (costs.tests(n_below) * areas.below(plane) + costs.tests(n_above) * areas.above(plane));
        if (tests < best.tests && areas.contains(plane)) best = {tests, axis, position, flat_below};
    };
    // Each event is a plane to consider, with no look at the next: among events at one place the last that ends and the first that begins count
    // the fewest primitives, which is what the place costs; the others only count more. One side can be empty only at the first and at the
    // last event, and where primitives lie flat.
    const KdEvent* const last = first + count - 1;
    for (const KdEvent* event = first; event <= last; ++event) {
        const float position = event->position();
        if (event->kind() == KdEvent::lies) {
            // All that lie here go to the same side.
            const std::uint64_t here = event->key();
            std::uint32_t lying = 1;
            while (event < last && event[1].key() == here) {
                ++event;
                ++lying;
            }
            above -= lying;
            consider(position, below + lying, above, true, costs.kept(below + lying, above));
            consider(position, below, above + lying, false, costs.kept(below, above + lying));
            below += lying;
            continue;
        }
        const std::uint32_t beginning = event->kind() == KdEvent::begins ? 1 : 0;
        above -= 1 - beginning;
        if (event == first || event == last) {
            consider(position, below, above, true, costs.kept(below, above));
        } else {
            consider(position, below, above, true, 1.0);
        }
        below += beginning;
    }
}

} // namespace raywise

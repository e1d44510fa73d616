#include "accel/bvh/build/nearest.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/bvh/build/nearest.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Lane by lane the same operations on every instruction set, so the same nearest ones.
void search_nearest(NearestBoxes& boxes, std::size_t count) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const std::size_t lanes = hn::Lanes(d);

    // Half the area of each box together with each of the next ones. The boxes after the last are infinite.
    const float* planes[6];
    for (int p = 0; p < 6; ++p) planes[p] = boxes.plane(p);
    for (std::size_t i = 0; i < count; i += lanes) {
        const auto x0 = hn::LoadU(d, planes[0] + i);
        const auto y0 = hn::LoadU(d, planes[1] + i);
        const auto z0 = hn::LoadU(d, planes[2] + i);
        const auto x1 = hn::LoadU(d, planes[3] + i);
        const auto y1 = hn::LoadU(d, planes[4] + i);
        const auto z1 = hn::LoadU(d, planes[5] + i);
        for (std::ptrdiff_t step = 1; step <= nearest_radius; ++step) {
            const std::size_t j = i + static_cast<std::size_t>(step);
            const auto x = hn::Add(hn::Max(x0, hn::LoadU(d, planes[0] + j)), hn::Max(x1, hn::LoadU(d, planes[3] + j)));
            const auto y = hn::Add(hn::Max(y0, hn::LoadU(d, planes[1] + j)), hn::Max(y1, hn::LoadU(d, planes[4] + j)));
            const auto z = hn::Add(hn::Max(z0, hn::LoadU(d, planes[2] + j)), hn::Max(z1, hn::LoadU(d, planes[5] + j)));
            const auto area = hn::Add(hn::Mul(x, hn::Add(y, z)), hn::Mul(y, z));
            hn::StoreU(area, d, boxes.distances(step) + i);
        }
    }

    const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < count; i += lanes) {
        const auto index = hn::Iota(di, static_cast<std::int32_t>(i));
        const auto odd = hn::RebindMask(d, hn::Eq(hn::And(index, hn::Set(di, 1)), hn::Set(di, 1)));
        const auto ahead = hn::LoadU(d, boxes.distances(1) + i);
        const auto behind = hn::LoadU(d, boxes.distances(1) + i - 1);
        const auto is_behind = hn::Or(hn::Lt(behind, ahead), hn::And(odd, hn::Eq(behind, ahead)));
        auto best = hn::IfThenElse(is_behind, behind, ahead);
        auto offset = hn::IfThenElse(hn::RebindMask(di, is_behind), hn::Set(di, -1), hn::Set(di, 1));
        for (std::ptrdiff_t step = 2; step <= nearest_radius; ++step) {
            for (const std::ptrdiff_t signed_step : {step, -step}) {
                const float* const row = boxes.distances(step);
                const auto area = hn::LoadU(d, signed_step > 0 ? row + i : row + i - step);
                const auto better = hn::Lt(area, best);
                best = hn::IfThenElse(better, area, best);
                offset = hn::IfThenElse(hn::RebindMask(di, better), hn::Set(di, static_cast<std::int32_t>(signed_step)),
                                        offset);
            }
        }
        const auto none = hn::RebindMask(di, hn::Not(hn::Lt(best, infinity)));
        hn::StoreU(hn::IfThenZeroElse(none, offset), di, boxes.offsets() + i);
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(search_nearest);

NearestBoxes::NearestBoxes(std::size_t capacity)
    : stride_(capacity + 2 * padding),
      planes_(new float[6 * stride_]),
      distances_(new float[nearest_radius * stride_]),
      offsets_(new std::int32_t[stride_]) {
    std::fill_n(planes_.get(), 6 * stride_, std::numeric_limits<float>::infinity());
    std::fill_n(distances_.get(), nearest_radius * stride_, std::numeric_limits<float>::infinity());
}

void NearestBoxes::search(std::size_t count) {
    for (int p = 0; p < 6; ++p) {
        std::fill_n(plane(p) + count, padding, std::numeric_limits<float>::infinity());
    }
    HWY_DYNAMIC_DISPATCH(search_nearest)(*this, count);
}

} // namespace raywise
#endif

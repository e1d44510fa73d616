#include "contract/sweep_manner.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace raywise::sweep {
namespace {

void backwards(void*, std::uint64_t count, rw_task task, void* task_data) {
    for (std::uint64_t i = count; i-- > 0;) task(task_data, i);
}

rw_query_options options_of(const Manner& manner) {
    rw_query_options options = sized<rw_query_options>();
    options.threads = manner.threads;
    if (manner.call == Manner::Call::host_batch) options.parallel_for = backwards;
    return options;
}

// Rays put in the manner's order and layout. A reversed order is one of negative strides, for answers as well, so that the
// arrays themselves stay as they were made.
class Arranged {
public:
    Arranged(const std::vector<rw_ray>& rays, const Manner& manner, bool may_reverse = true)
        : reversed_(manner.order == Manner::Order::reversed && may_reverse) {
        const std::vector<rw_ray>* source = &rays;
        if (manner.order == Manner::Order::shuffled) {
            places_.resize(rays.size());
            std::iota(places_.begin(), places_.end(), std::uint32_t{0});
            std::mt19937_64 random(manner.shuffle);
            std::shuffle(places_.begin(), places_.end(), random);
            records_.reserve(rays.size());
            for (const std::uint32_t place : places_) records_.push_back(rays[place]);
            source = &records_;
        }
        rays_.count = rays.size();
        switch (manner.layout) {
            case Manner::Layout::records:
                describe_records(*source);
                break;
            case Manner::Layout::arrays:
                describe_arrays(*source, numbers64_, RW_FLOAT64);
                break;
            case Manner::Layout::float32:
                describe_arrays(*source, numbers32_, RW_FLOAT32);
                break;
        }
    }
    Arranged(const Arranged&) = delete;
    Arranged& operator=(const Arranged&) = delete;

    const rw_rays& rays() const { return rays_; }

    // An output of one element per ray, the rays being in this order.
    rw_output output(void* first, std::int64_t stride, std::int32_t type) const {
        rw_output output{};
        output.data = reversed_ ? static_cast<std::byte*>(first) + stride * last() : first;
        output.stride = reversed_ ? -stride : stride;
        output.type = type;
        return output;
    }

    // Which ray of the caller's stands at a place of the arrangement.
    std::size_t place(std::size_t i) const { return places_.empty() ? i : places_[i]; }

    template <class Answer>
    void put_back(std::vector<Answer>& answers) const {
        if (places_.empty()) return;
        std::vector<Answer> sorted(answers.size());
        for (std::size_t i = 0; i < answers.size(); ++i) sorted[places_[i]] = answers[i];
        answers.swap(sorted);
    }

private:
    std::int64_t last() const { return static_cast<std::int64_t>(rays_.count) - 1; }

    rw_array input(const void* first, std::int64_t stride, std::int64_t component, std::int32_t type) const {
        rw_array array{};
        array.data = reversed_ ? static_cast<const std::byte*>(first) + stride * last() : first;
        array.stride = reversed_ ? -stride : stride;
        array.component_stride = component;
        array.type = type;
        return array;
    }

    void describe_records(const std::vector<rw_ray>& rays) {
        constexpr std::int64_t stride = sizeof(rw_ray);
        rays_.origin = input(rays[0].origin, stride, 0, RW_FLOAT64);
        rays_.direction = input(rays[0].direction, stride, 0, RW_FLOAT64);
        rays_.tmin = input(&rays[0].tmin, stride, 0, RW_FLOAT64);
        rays_.tmax = input(&rays[0].tmax, stride, 0, RW_FLOAT64);
    }

    // Each component in an array of its own.
    template <class Number>
    void describe_arrays(const std::vector<rw_ray>& rays, std::vector<Number>& numbers, std::int32_t type) {
        const std::size_t count = rays.size();
        numbers.resize(8 * count);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                numbers[axis * count + i] = static_cast<Number>(rays[i].origin[axis]);
                numbers[(3 + axis) * count + i] = static_cast<Number>(rays[i].direction[axis]);
            }
            numbers[6 * count + i] = static_cast<Number>(rays[i].tmin);
            numbers[7 * count + i] = static_cast<Number>(rays[i].tmax);
        }
        constexpr std::int64_t stride = sizeof(Number);
        const std::int64_t component = stride * static_cast<std::int64_t>(count);
        rays_.origin = input(&numbers[0], stride, component, type);
        rays_.direction = input(&numbers[3 * count], stride, component, type);
        rays_.tmin = input(&numbers[6 * count], stride, 0, type);
        rays_.tmax = input(&numbers[7 * count], stride, 0, type);
    }

    bool reversed_;
    std::vector<std::uint32_t> places_; // empty: each where it was
    std::vector<rw_ray> records_;
    std::vector<double> numbers64_;
    std::vector<float> numbers32_;
    rw_rays rays_ = sized<rw_rays>();
};

// Answers are written as rw_hit records, so that batches and single calls can be compared byte for byte.
rw_hits described(std::vector<rw_hit>& hits, const Arranged& arranged) {
    constexpr std::int64_t stride = sizeof(rw_hit);
    rw_hits described = sized<rw_hits>();
    rw_hit& first = hits[0];
    described.t = arranged.output(&first.t, stride, RW_FLOAT64);
    described.uv = arranged.output(&first.u, stride, RW_FLOAT64);
    described.instance = arranged.output(&first.instance, stride, RW_UINT32);
    described.geometry = arranged.output(&first.geometry, stride, RW_UINT32);
    described.primitive = arranged.output(&first.primitive, stride, RW_UINT32);
    return described;
}

void ask_all_singly(const Subject& subject, const std::vector<rw_ray>& rays, AllHits& all) {
    all.offsets.assign(1, 0);
    all.hits.clear();
    std::vector<rw_hit> some(64);
    for (const rw_ray& ray : rays) {
        std::uint64_t needed = 0;
        std::int32_t status = subject.all(&ray, some.data(), some.size(), &needed);
        if (status == RW_ERROR_CAPACITY) {
            some.resize(needed);
            status = subject.all(&ray, some.data(), some.size(), &needed);
        }
        must(status, "rw_scene_intersect_all");
        all.hits.insert(all.hits.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(needed));
        all.offsets.push_back(all.hits.size());
    }
}

} // namespace

std::string Manner::text() const {
    static const char* const calls[] = {"batch", "batch with the host's loop", "single calls"};
    static const char* const orders[] = {"as made", "reversed", "shuffled"};
    static const char* const layouts[] = {"records", "arrays", "float32 arrays"};
    std::string text = calls[static_cast<int>(call)];
    if (call == Call::single) return text;
    if (call == Call::batch) text += threads == 0 ? ", all threads" : ", " + std::to_string(threads) + " thread(s)";
    return text + ", " + orders[static_cast<int>(order)] + ", " + layouts[static_cast<int>(layout)];
}

Manner random_manner(Random& random, bool float32) {
    Manner manner;
    manner.shuffle = random.bits();
    const std::uint64_t call = random.below(8);
    manner.call = call == 0 ? Manner::Call::single : call == 1 ? Manner::Call::host_batch : Manner::Call::batch;
    manner.order = static_cast<Manner::Order>(random.below(3));
    manner.layout = static_cast<Manner::Layout>(random.below(float32 ? 3 : 2));
    // The sweep runs blocks side by side already: more threads inside each are for variety.
    const std::uint32_t threads[] = {1, 1, 1, 2, 3, 0};
    manner.threads = threads[random.below(6)];
    return manner;
}

void ask_closest(const Subject& subject, const std::vector<rw_ray>& rays, const Manner& manner,
                 std::vector<rw_hit>& hits) {
    hits.assign(rays.size(), rw_hit{});
    if (rays.empty()) return;
    if (manner.call == Manner::Call::single) {
        for (std::size_t i = 0; i < rays.size(); ++i) must(subject.closest(&rays[i], &hits[i]), "rw_scene_intersect");
        return;
    }
    const Arranged arranged(rays, manner);
    const rw_hits outputs = described(hits, arranged);
    const rw_query_options options = options_of(manner);
    must(subject.closest_batch(&arranged.rays(), &outputs, &options), "rw_scene_intersect_batch");
    arranged.put_back(hits);
}

void ask_any(const Subject& subject, const std::vector<rw_ray>& rays, const Manner& manner,
             std::vector<std::uint8_t>& hit) {
    constexpr std::uint8_t unwritten = 7;
    hit.assign(rays.size(), unwritten);
    if (rays.empty()) return;
    if (manner.call == Manner::Call::single) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            std::int32_t answer = unwritten;
            must(subject.any(&rays[i], &answer), "rw_scene_occluded");
            hit[i] = static_cast<std::uint8_t>(answer);
        }
        return;
    }
    const Arranged arranged(rays, manner);
    const rw_output output = arranged.output(hit.data(), 1, RW_UINT8);
    const rw_query_options options = options_of(manner);
    must(subject.any_batch(&arranged.rays(), &output, &options), "rw_scene_occluded_batch");
    arranged.put_back(hit);
}

void ask_all(const Subject& subject, const std::vector<rw_ray>& rays, const Manner& manner, AllHits& all) {
    if (rays.empty() || manner.call == Manner::Call::single) return ask_all_singly(subject, rays, all);
    // The hits of all rays lie one after the other, in the order of the rays: no stride turns that round.
    const Arranged arranged(rays, manner, false);
    const rw_query_options options = options_of(manner);
    std::vector<std::uint64_t> offsets(rays.size() + 1);
    std::vector<rw_hit> hits(8 * rays.size() + 64);
    for (;;) {
        std::uint64_t needed = 0;
        const rw_hits outputs = described(hits, arranged);
        const std::int32_t status =
            subject.all_batch(&arranged.rays(), offsets.data(), &outputs, hits.size(), &needed, &options);
        if (status == RW_ERROR_CAPACITY) {
            hits.assign(needed, rw_hit{});
            continue;
        }
        must(status, "rw_scene_intersect_all_batch");
        break;
    }
    std::vector<std::size_t> stands_at(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) stands_at[arranged.place(i)] = i;
    all.offsets.assign(1, 0);
    all.hits.clear();
    for (const std::size_t i : stands_at) {
        all.hits.insert(all.hits.end(), hits.begin() + static_cast<std::ptrdiff_t>(offsets[i]),
                        hits.begin() + static_cast<std::ptrdiff_t>(offsets[i + 1]));
        all.offsets.push_back(all.hits.size());
    }
}

} // namespace raywise::sweep

#include "base/page_pool.h"

#include "base/page_block.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <new>
#include <type_traits>

#include <pthread.h>

namespace raywise {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t small_page = std::size_t{4} << 10;

// Held for the time of a walk along the list and no longer: memory comes from the system, and goes back to it, without the lock.
class Pool {
public:
    // Of those kept that will do the one most like a new block, null: none. The smallest might be what another array, a little shorter,
    // is going to need, and that one would find none.
    PageBlock* take_kept(std::size_t bytes) {
        const std::size_t wanted = capacity_for(bytes);
        const auto off = [&](std::size_t capacity) { return std::max(capacity, wanted) - std::min(capacity, wanted); };
        PageBlock** best = nullptr;
        for (PageBlock** each = &kept_; *each != nullptr; each = &(*each)->next) {
            const std::size_t capacity = (*each)->capacity;
            const bool fits = capacity >= bytes && capacity - bytes <= bytes / 4;
            if (fits && (best == nullptr || off(capacity) < off((*best)->capacity))) best = each;
        }
        if (best == nullptr) return nullptr;
        PageBlock* const block = *best;
        *best = block->next;
        kept_bytes_ -= block->capacity;
        note_use(block->capacity);
        return block;
    }

    // Arrays of a structure differ in length from frame to frame. So blocks that are to be kept have some room.
    bool gives_room() const { return keepers_ > 0 || most_ > 0; }
    std::size_t capacity_for(std::size_t bytes) const {
        const std::size_t wanted = gives_room() ? bytes + bytes / 8 : bytes;
        return (wanted + small_page - 1) / small_page * small_page;
    }

    void note_use(std::size_t bytes) {
        in_use_ += bytes;
        peaks_[build_] = std::max(peaks_[build_], in_use_);
    }
    void note_fresh(std::size_t bytes) {
        ++figures_.fresh_blocks;
        figures_.fresh_bytes += bytes;
        note_use(bytes);
    }
    void note_refused(std::size_t bytes, std::uint64_t peak_before) {
        --figures_.fresh_blocks;
        figures_.fresh_bytes -= bytes;
        in_use_ -= bytes;
        peaks_[build_] = std::max(peak_before, in_use_);
    }
    std::uint64_t peak_of_build() const { return peaks_[build_]; }

    void keep(PageBlock* block) {
        in_use_ -= block->capacity;
        kept_bytes_ += block->capacity;
        block->next = kept_;
        kept_ = block;
    }

    // Takes out what may not be kept, of which the caller disposes: those without room, and those that were kept longest before others.
    PageBlock* surplus() { return surplus_above(most_kept()); }
    PageBlock* surplus_above(std::uint64_t most) {
        PageBlock* result = nullptr;
        std::uint64_t sum = 0;
        for (PageBlock** each = &kept_; *each != nullptr;) {
            PageBlock* const block = *each;
            if (block->has_room && sum + block->capacity <= most) {
                sum += block->capacity;
                each = &block->next;
            } else {
                *each = block->next;
                block->next = result;
                result = block;
            }
        }
        kept_bytes_ = sum;
        return result;
    }

    void add_keeper(int n) { keepers_ += n; }
    void end_build() {
        build_ = (build_ + 1) % builds_remembered;
        peaks_[build_] = in_use_;
    }
    void set_most(std::uint64_t most) { most_ = most; }

    PagePoolFigures figures() const {
        PagePoolFigures result = figures_;
        result.in_use = in_use_;
        result.kept = kept_bytes_;
        return result;
    }

    std::mutex mutex;

private:
    std::uint64_t most_kept() const;

    PageBlock* kept_ = nullptr; // the last one that was released first
    std::uint64_t kept_bytes_ = 0;
    std::uint64_t in_use_ = 0;
    std::array<std::uint64_t, builds_remembered> peaks_{}; // of what was in use, one for each build
    std::size_t build_ = 0;
    int keepers_ = 0;
    std::uint64_t most_ = 0;
    PagePoolFigures figures_;
};

// Arrays may be released when static objects are destroyed: it is not destroyed itself.
static_assert(std::is_trivially_destructible_v<Pool>);
Pool pool;

// The thread that forks holds the lock meanwhile, so that the child finds it free and the list whole.
const bool survives_fork =
    pthread_atfork([] { pool.mutex.lock(); }, [] { pool.mutex.unlock(); }, [] { pool.mutex.unlock(); }) == 0;

std::uint64_t Pool::most_kept() const {
    if (!survives_fork) return 0;
    const std::uint64_t peak = *std::max_element(peaks_.begin(), peaks_.end());
    // The steps of a build need arrays of different lengths: with once the peak those of one step would go for those of the next.
    const std::uint64_t room = 2 * peak - in_use_;
    return keepers_ > 0 ? room : std::min(room, most_);
}

// Calls change() with the lock, and gives back what may not be kept afterwards.
template <class Change>
void change_pool(const Change& change) noexcept {
    PageBlock* surplus = nullptr;
    {
        const std::lock_guard lock(pool.mutex);
        change();
        surplus = pool.surplus();
    }
    release_blocks(surplus);
}

PageBlock* take_fresh(std::size_t bytes) {
    std::size_t capacity = 0;
    std::uint64_t peak_before = 0;
    bool has_room = false;
    change_pool([&] {
        capacity = pool.capacity_for(bytes);
        has_room = pool.gives_room();
        peak_before = pool.peak_of_build();
        pool.note_fresh(capacity);
    });
    try {
        return allocate_block(capacity, has_room);
    } catch (const std::bad_alloc&) {
        change_pool([&] { pool.note_refused(capacity, peak_before); });
        throw;
    }
}

void give_back_all_kept() {
    PageBlock* kept = nullptr;
    {
        const std::lock_guard lock(pool.mutex);
        kept = pool.surplus_above(0);
    }
    release_blocks(kept);
}

PageBlock* take_block(std::size_t bytes) {
    {
        const std::lock_guard lock(pool.mutex);
        if (PageBlock* const kept = pool.take_kept(bytes)) return kept;
    }
    try {
        return take_fresh(bytes);
    } catch (const std::bad_alloc&) {
        if (page_pool_figures().kept == 0) throw;
        give_back_all_kept(); // which may be what is missing
        return take_fresh(bytes);
    }
}

} // namespace

std::byte* take_pages(std::size_t bytes) {
    if (bytes < least_pooled_bytes)
        return static_cast<std::byte*>(::operator new(bytes, static_cast<std::align_val_t>(cache_line)));
    if (bytes > PTRDIFF_MAX - (PTRDIFF_MAX >> 3)) throw std::bad_alloc(); // room for growth would not fit
    PageBlock* const block = take_block(bytes);
    open_block(block, bytes);
    return block->memory();
}

void give_pages(std::byte* memory, std::size_t bytes) noexcept {
    if (bytes < least_pooled_bytes) {
        ::operator delete(memory, static_cast<std::align_val_t>(cache_line));
        return;
    }
    PageBlock* const block = PageBlock::of(memory);
    close_block(block);
    change_pool([&] { pool.keep(block); });
}

KeepPages::KeepPages() noexcept {
    change_pool([] { pool.add_keeper(1); });
}
KeepPages::~KeepPages() {
    change_pool([] { pool.add_keeper(-1); });
}

void note_build() noexcept {
    change_pool([] { pool.end_build(); });
}

void keep_pages(std::uint64_t most) noexcept {
    PageBlock* surplus = nullptr;
    {
        const std::lock_guard lock(pool.mutex);
        pool.set_most(most);
        surplus = pool.surplus_above(std::min(most, pool.figures().kept));
    }
    release_blocks(surplus);
}

PagePoolFigures page_pool_figures() noexcept {
    const std::lock_guard lock(pool.mutex);
    return pool.figures();
}

} // namespace raywise

/* Atomics without a library: several threads may allocate at once. */
#include "refusing.h"

static int refusing; /* 0: nothing is refused; otherwise 1 + refusal */
static long until;   /* allocations until the first that is refused */
static long refused;
static long live, bytes_live;
static long largest;

void refuse(refusal which, long number) {
    __atomic_store_n(&until, number, __ATOMIC_SEQ_CST);
    __atomic_store_n(&refused, 0, __ATOMIC_SEQ_CST);
    __atomic_store_n(&refusing, 1 + (int)which, __ATOMIC_SEQ_CST);
}

long stop_refusing(void) {
    __atomic_store_n(&refusing, 0, __ATOMIC_SEQ_CST);
    return __atomic_load_n(&refused, __ATOMIC_SEQ_CST);
}

long live_allocations(void) { return __atomic_load_n(&live, __ATOMIC_SEQ_CST); }
long live_bytes(void) { return __atomic_load_n(&bytes_live, __ATOMIC_SEQ_CST); }

int is_refused(void) {
    const int how = __atomic_load_n(&refusing, __ATOMIC_SEQ_CST);
    long before;
    if (how == 0) return 0;
    before = __atomic_fetch_sub(&until, 1, __ATOMIC_SEQ_CST);
    if (how == 1 + REFUSE_ONE ? before != 0 : before > 0) return 0;
    __atomic_fetch_add(&refused, 1, __ATOMIC_SEQ_CST);
    return 1;
}

long largest_allocation(void) { return __atomic_exchange_n(&largest, 0, __ATOMIC_SEQ_CST); }

void count_live(long difference, long bytes) {
    long before = __atomic_load_n(&largest, __ATOMIC_SEQ_CST);
    while (bytes > before &&
           !__atomic_compare_exchange_n(&largest, &before, bytes, 0, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST)) {
    }
    __atomic_fetch_add(&live, difference, __ATOMIC_SEQ_CST);
    __atomic_fetch_add(&bytes_live, bytes, __ATOMIC_SEQ_CST);
}

/* malloc and its family, which can refuse. glibc's own, behind them, have the names below. */
#include "refusing.h"

#include <errno.h>
#include <malloc.h>
#include <stddef.h>
#include <stdlib.h>

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void *memory);

static long size_of(void *memory) { return (long)malloc_usable_size(memory); }

static void *counted(void *memory) {
    if (memory != NULL) {
        count_live(1, size_of(memory));
    } else {
        errno = ENOMEM;
    }
    return memory;
}

EXPORTED void *malloc(size_t size) { return counted(is_refused() ? NULL : __libc_malloc(size)); }
EXPORTED void *calloc(size_t count, size_t size) { return counted(is_refused() ? NULL : __libc_calloc(count, size)); }
EXPORTED void *memalign(size_t alignment, size_t size) {
    return counted(is_refused() ? NULL : __libc_memalign(alignment, size));
}
EXPORTED void *aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
EXPORTED int posix_memalign(void **memory, size_t alignment, size_t size) {
    void *fresh = memalign(alignment, size);
    if (fresh == NULL) return ENOMEM;
    *memory = fresh;
    return 0;
}
EXPORTED void free(void *memory) {
    if (memory != NULL) count_live(-1, -size_of(memory));
    __libc_free(memory);
}
EXPORTED void *realloc(void *old, size_t size) {
    void *grown;
    long before;
    if (old == NULL) return malloc(size);
    if (size == 0) {
        free(old);
        return NULL;
    }
    if (is_refused()) {
        errno = ENOMEM;
        return NULL;
    }
    before = size_of(old);
    grown = __libc_realloc(old, size);
    if (grown != NULL) count_live(0, size_of(grown) - before);
    return grown;
}

/* Memory that can refuse: the program's allocations, the library's included, are counted and can be made to fail.
 * refusing_malloc.c does it for malloc and all that stands on it; sanitizers bring a malloc of their own, with them
 * refusing_new.cc does it for C++'s operator new. */
#ifndef RAYWISE_TESTS_CAPI_REFUSING_H
#define RAYWISE_TESTS_CAPI_REFUSING_H

#ifdef __cplusplus
extern "C" {
#endif

/* The library is to find the replaced functions in the program. */
#define EXPORTED __attribute__((visibility("default")))

/* Which allocations fail from now on, counted from 0. */
typedef enum refusal {
    REFUSE_ONE,     /* only that one */
    REFUSE_FROM_ON, /* that one and all that follow */
} refusal;

void refuse(refusal which, long number);
/* All succeed again. Tells how many were refused since. */
long stop_refusing(void);
/* Allocations made and not given back yet, and their bytes. */
long live_allocations(void);
long live_bytes(void);
/* The bytes of the largest allocation since this was asked last. */
long largest_allocation(void);

/* For the replaced functions: whether to refuse this one, and the count of what lives. */
int is_refused(void);
void count_live(long difference, long bytes);

#ifdef __cplusplus
}
#endif

#endif

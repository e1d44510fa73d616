/* A small interface with one of everything, for the tests of the generator. */
#ifndef RW_SMALL_H
#define RW_SMALL_H

#include <stdint.h>

#define RW_API
#define RW_OK 0
#define RW_FLAG 2u
#define RW_LOWEST (-9223372036854775807LL - 1)
#define RW_HIGHEST 0xFFFFFFFFFFFFFFFFull

typedef struct rw_thing rw_thing;

/* Called for each thing: index below [0, count). */
typedef int32_t (*rw_visit)(void *user, double fraction, const char *stage);

typedef struct rw_part {
    uint32_t struct_size;
    int32_t type; /* a word that belongs to Rust */
    const void *data;
    double origin[3];
} rw_part;

typedef struct rw_whole {
    uint32_t struct_size;
    uint32_t flags;
    rw_part part;
    const rw_part *parts;
    rw_visit visit;
    void *visit_user;
    const rw_thing *thing;
} rw_whole;

RW_API int32_t rw_thing_create(const rw_whole *whole, rw_thing **thing);
RW_API int32_t rw_thing_ask(const rw_thing *thing, const double *point, uint64_t count, float *answers);
RW_API const char *rw_thing_name(void);

#endif

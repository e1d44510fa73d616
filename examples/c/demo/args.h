/* The command line. */
#ifndef DEMO_ARGS_H
#define DEMO_ARGS_H

#include <stdint.h>

struct args {
    const char *library;   /* NULL: libraywise.so.1 as the loader finds it */
    const char *calibrate; /* the raywise-calibrate program; NULL: do not calibrate */
    const char *profile;   /* NULL: as the library finds it */
    const char *mesh;      /* NULL: a scene of the demo's own */
    const char *scene;     /* "sphereflake" or "terrain" */
    uint32_t detail;       /* how fine that scene is, 1 ... 5 */
    uint64_t rays;         /* one more row of the table; 0: none */
    uint32_t size;         /* of the picture, pixels */
    uint32_t samples;      /* per pixel, 1 or 4; 0: 4 when there is time */
    const char *output;    /* the picture */
    const char *json;      /* the decisions; NULL: not wanted */
    uint32_t threads;      /* 0: as many as the process may use */
    double cap_seconds;    /* for timing one candidate */
    int explain;           /* print what the library says about its choice as well */
};

enum args_result {
    ARGS_RUN,
    ARGS_HELP,
    ARGS_WRONG
};

/* Reads the command line; on ARGS_WRONG the reason has been printed. */
enum args_result args_parse(struct args *args, int argc, char **argv);

#endif

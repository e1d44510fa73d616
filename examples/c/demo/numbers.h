/* Figures as people read them. Each function writes into the caller's text and returns it, for use inside printf. */
#ifndef DEMO_NUMBERS_H
#define DEMO_NUMBERS_H

#include <stdint.h>

struct number {
    char text[40];
};

/* A whole number with separators: 1,048,576. */
const char *number_count(struct number *number, uint64_t value);

/* About three digits: 0.012, 3.14, 31.4, 314, 3,141, 31.4 k, 3.14 M. "-" for NaN, "never" for infinity.
 * mark: a character put in front, or 0. */
const char *number_short(struct number *number, double value, char mark);

/* Bytes: 512 B, 61.2 MB. "-" for 0. */
const char *number_bytes(struct number *number, uint64_t bytes);

#endif

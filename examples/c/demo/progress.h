/* A stopwatch, and a word now and then about work that takes long. */
#ifndef DEMO_PROGRESS_H
#define DEMO_PROGRESS_H

#include <stdbool.h>

/* Nanoseconds on a clock that never jumps. */
double clock_ns(void);

/* On a terminal one line that is rewritten, elsewhere (a log file) a line every few seconds. Silent for short work. */
struct progress {
    char title[64];
    double started;
    double shown;
    bool terminal;
    bool visible;
};

void progress_begin(struct progress *progress, const char *title);
/* fraction: 0 to 1, or below 0 when it is not known. */
void progress_update(struct progress *progress, double fraction);
void progress_end(struct progress *progress);

#endif

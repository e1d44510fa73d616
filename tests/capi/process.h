/* What the system says of this process. */
#ifndef RAYWISE_TESTS_CAPI_PROCESS_H
#define RAYWISE_TESTS_CAPI_PROCESS_H

#include <stdio.h>
#include <string.h>

/* A number of /proc/self/status; -1: there is none of that name. */
static inline long process_number(const char *name) {
    char line[256];
    long number = -1;
    FILE *file = fopen("/proc/self/status", "r");
    if (file == NULL) return -1;
    while (number < 0 && fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, name, strlen(name)) == 0 && line[strlen(name)] == ':')
            sscanf(line + strlen(name) + 1, "%ld", &number);
    }
    fclose(file);
    return number;
}

static inline long process_threads(void) { return process_number("Threads"); }
static inline long resident_bytes(void) { return process_number("VmRSS") * 1024; }

#endif

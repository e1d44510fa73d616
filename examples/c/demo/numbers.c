#include "numbers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *number_count(struct number *number, uint64_t value) {
    char digits[32];
    const int length = snprintf(digits, sizeof digits, "%llu", (unsigned long long)value);
    size_t at = 0;
    for (int i = 0; i < length; ++i) {
        if (i > 0 && (length - i) % 3 == 0) number->text[at++] = ',';
        number->text[at++] = digits[i];
    }
    number->text[at] = '\0';
    return number->text;
}

const char *number_short(struct number *number, double value, char mark) {
    static const char units[] = {'k', 'M', 'G', 'T', 'P', 'E'};
    char *text = number->text;
    size_t room = sizeof number->text;
    if (isnan(value)) return strcpy(text, "-");
    if (isinf(value)) return strcpy(text, "never");
    if (mark != 0) {
        *text++ = mark;
        --room;
    }
    /* The limits lie a little below the powers of ten so that rounding never yields 10.00 or 1000. */
    if (value == 0.0)
        snprintf(text, room, "0");
    else if (value < 0.0005)
        snprintf(text, room, "<0.001");
    else if (value < 0.9995)
        snprintf(text, room, "%.3f", value);
    else if (value < 9.995)
        snprintf(text, room, "%.2f", value);
    else if (value < 99.95)
        snprintf(text, room, "%.1f", value);
    else if (value < 999.5)
        snprintf(text, room, "%.0f", value);
    else if (value < 9999.5)
        snprintf(text, room, "%d,%03d", (int)(value + 0.5) / 1000, (int)(value + 0.5) % 1000);
    else {
        size_t unit = 0;
        double scaled = value / 1000.0;
        while (scaled >= 999.5 && unit + 1 < sizeof units) {
            scaled /= 1000.0;
            ++unit;
        }
        snprintf(text, room, scaled < 9.995 ? "%.2f %c" : scaled < 99.95 ? "%.1f %c" : "%.0f %c", scaled, units[unit]);
    }
    return number->text;
}

const char *number_bytes(struct number *number, uint64_t bytes) {
    static const char *const units[] = {"kB", "MB", "GB", "TB"};
    if (bytes == 0) return strcpy(number->text, "-");
    if (bytes < 1000) {
        snprintf(number->text, sizeof number->text, "%u B", (unsigned)bytes);
        return number->text;
    }
    size_t unit = 0;
    double scaled = (double)bytes / 1000.0;
    while (scaled >= 999.5 && unit < 3) {
        scaled /= 1000.0;
        ++unit;
    }
    snprintf(number->text, sizeof number->text, scaled < 99.95 ? "%.1f %s" : "%.0f %s", scaled, units[unit]);
    return number->text;
}

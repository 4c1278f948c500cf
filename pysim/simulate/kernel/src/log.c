/* What an FMU says, kept by the instance it says it of. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "fmi.h"

static char *next_line(Log *log) { return log->lines + (log->count++ % LINES) * LINE_LENGTH; }

void fmi_log_2(void *environment, const char *instance, int status, const char *category, const char *format, ...) {
    (void)instance, (void)category;
    if (!environment || status <= OK || !format || !*format) return;
    va_list values;
    va_start(values, format);
    vsnprintf(next_line(environment), LINE_LENGTH, format, values);
    va_end(values);
}

void fmi_log_3(void *environment, int status, const char *category, const char *message) {
    (void)category;
    if (!environment || status <= OK || !message || !*message) return;
    snprintf(next_line(environment), LINE_LENGTH, "%s", message);
}

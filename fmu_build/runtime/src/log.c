#include "log.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "instance.h"

enum { MESSAGE_SIZE = 1024 };

static const char *const category_names[LOG_CATEGORIES] = {
    "logStatusError", "logStatusWarning", "logStatusDiscard", "logEvents"};
static const int category_status[LOG_CATEGORIES] = {STATUS_ERROR, STATUS_WARNING, STATUS_DISCARD, STATUS_OK};

void log_message(Instance *s, LogCategory category, const char *format, ...) {
    if (!s->log.sink || (category != LOG_ERROR && !s->log.enabled[category])) return;
    if (category == LOG_DISCARD && s->log.quiet) return;
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    s->log.sink(s->log.environment, s->log.instance_name, category_status[category], category_names[category],
                message);
}

void log_begin(Log *log, bool debug) {
    for (int k = 0; k < LOG_CATEGORIES; k++) log->enabled[k] = k != LOG_EVENTS || debug;
}

static int find_category(const char *name) {
    for (int k = 0; name && k < LOG_CATEGORIES; k++)
        if (strcmp(name, category_names[k]) == 0) return k;
    return -1;
}

bool log_enable(Instance *s, bool on, size_t n, const char *const names[]) {
    if (n > 0 && !names) {
        log_message(s, LOG_ERROR, "SetDebugLogging: the array of categories is null.");
        return false;
    }
    bool known = true;
    for (size_t k = 0; k < n; k++) {
        int category = find_category(names[k]);
        if (category >= 0) {
            s->log.enabled[category] = on;
        } else {
            log_message(s, LOG_ERROR, "SetDebugLogging: unknown category \"%s\".", names[k] ? names[k] : "(null)");
            known = false;
        }
    }
    for (int k = 0; n == 0 && k < LOG_CATEGORIES; k++) s->log.enabled[k] = on;
    return known;
}

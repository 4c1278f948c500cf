/* Messages to the host. */
#ifndef LOG_H
#define LOG_H

#include <stdbool.h>
#include <stddef.h>

/* Categories, as declared in modelDescription.xml. */
typedef enum { LOG_ERROR, LOG_WARNING, LOG_DISCARD, LOG_EVENTS, LOG_CATEGORIES } LogCategory;

/* Hands a message to the callback of one FMI version; `status` is numbered as in FMI. */
typedef void LogSink(void *environment, const char *instance_name, int status, const char *category,
                     const char *message);

typedef struct {
    LogSink *sink;
    void *environment;
    char *instance_name;
    bool enabled[LOG_CATEGORIES];
    bool quiet; /* no Discard messages: a trial step may fail */
} Log;

struct Instance;

/* The categories of a new instance: all, but events only where the importer switches debug logging on. */
void log_begin(Log *log, bool debug);

/* Sends a printf-style message. Errors are sent whatever is enabled, as FMI demands. */
#if defined(__MINGW32__) && !defined(__clang__)
__attribute__((format(gnu_printf, 3, 4))) /* its plain printf format is Microsoft's, without %zu */
#elif defined(__GNUC__) || defined(__clang__)
__attribute__((format(printf, 3, 4)))
#endif
void log_message(struct Instance *s, LogCategory category, const char *format, ...);

/* Switches categories on or off; n = 0 means all. False if a name is null or unknown (it is logged). */
bool log_enable(struct Instance *s, bool on, size_t n, const char *const names[]);

#endif

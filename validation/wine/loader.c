/* Load an FMI 2.0 co-simulation library and step it: the part of an importer that a binary for Windows has to please.
 *
 * Usage: loader LIBRARY GUID RESOURCES_URI INPUT_REFERENCE OUTPUT_REFERENCE INPUT_VALUE STEP COUNT
 *        TOLERANCE
 * Prints time and output after every step; exit code 0, or the number of the call that failed.
 * Declarations follow the FMI 2.0.4 standard, Sections 2.1 and 4.2.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <windows.h>

typedef void *Component;
typedef void (*Logger)(void *, const char *, int, const char *, const char *, ...);
typedef struct {
    Logger logger;
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, int);
    void *environment;
} Callbacks;

typedef Component (*InstantiateFunction)(const char *, int, const char *, const char *, const Callbacks *, int, int);
typedef int (*SetupFunction)(Component, int, double, double, int, double);
typedef int (*PlainFunction)(Component);
typedef int (*SetRealFunction)(Component, const unsigned *, size_t, const double *);
typedef int (*GetRealFunction)(Component, const unsigned *, size_t, double *);
typedef int (*DoStepFunction)(Component, double, double, int);
typedef void (*FreeFunction)(Component);

static void print_message(void *environment, const char *name, int status, const char *category, const char *text, ...) {
    va_list values;
    (void)environment;
    fprintf(stderr, "%s [%d, %s] ", name, status, category);
    va_start(values, text);
    vfprintf(stderr, text, values);
    va_end(values);
    fputc('\n', stderr);
}

static FARPROC find(HMODULE library, const char *name) {
    FARPROC function = GetProcAddress(library, name);
    if (function == NULL) {
        fprintf(stderr, "the library has no function %s\n", name);
        exit(2);
    }
    return function;
}

#define FUNCTION(type, name) type name = (type)(void (*)(void))find(library, "fmi2" #name)
#define TRY(number, call) \
    do { \
        if ((call) > 1) { /* beyond OK and warning */ \
            fprintf(stderr, "%s failed\n", #call); \
            return (number); \
        } \
    } while (0)

int main(int count, char **words) {
    static const Callbacks callbacks = {print_message, calloc, free, NULL, NULL};
    if (count != 10) {
        fprintf(stderr, "loader LIBRARY GUID RESOURCES_URI INPUT_REFERENCE OUTPUT_REFERENCE INPUT_VALUE STEP COUNT TOLERANCE\n");
        return 1;
    }
    HMODULE library = LoadLibraryA(words[1]);
    if (library == NULL) {
        fprintf(stderr, "cannot load %s: error %lu\n", words[1], GetLastError());
        return 3;
    }
    const unsigned input = (unsigned)strtoul(words[4], NULL, 10), output = (unsigned)strtoul(words[5], NULL, 10);
    const double command = strtod(words[6], NULL), step = strtod(words[7], NULL);
    const int steps = atoi(words[8]);
    FUNCTION(InstantiateFunction, Instantiate);
    FUNCTION(SetupFunction, SetupExperiment);
    FUNCTION(PlainFunction, EnterInitializationMode);
    FUNCTION(PlainFunction, ExitInitializationMode);
    FUNCTION(SetRealFunction, SetReal);
    FUNCTION(GetRealFunction, GetReal);
    FUNCTION(DoStepFunction, DoStep);
    FUNCTION(PlainFunction, Terminate);
    FUNCTION(FreeFunction, FreeInstance);

    Component model = Instantiate("wine", 1, words[2], words[3], &callbacks, 0, 0);
    if (model == NULL) return 4;
    TRY(5, SetupExperiment(model, 1, strtod(words[9], NULL), 0.0, 0, 0.0));
    TRY(6, EnterInitializationMode(model));
    TRY(7, ExitInitializationMode(model));
    TRY(8, SetReal(model, &input, 1, &command));
    for (int i = 0; i < steps; i++) {
        double value = 0.0;
        TRY(9, DoStep(model, i * step, step, 1));
        TRY(10, GetReal(model, &output, 1, &value));
        printf("%.17g %.17g\n", (i + 1) * step, value);
    }
    TRY(11, Terminate(model));
    FreeInstance(model);
    return FreeLibrary(library) ? 0 : 12;
}

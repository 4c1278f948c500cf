/* A mass on a spring as an FMI 2 FMU with faults planted: the token "fault N" says which. m v' = g u - k x - d v, y = x.
   Co-simulation takes steps of Runge and Kutta of at most 2 ms. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef void *Me;
typedef unsigned int Ref;
typedef struct { int more, end, nominals, values, timed; double next; } Events;
typedef struct { void *logger, *allocate, *free_, *finished, *environment; } Callbacks;
enum { OK = 0, DISCARD = 2, ERROR = 3 };
#define GRID 0.04 /* s, of FIXED_STEP */
#define END 0.5   /* s, of EARLY_END */
enum { X, V, DX, DV, U, Y, M, K, D, G, COUNT };
enum { MADE, STARTING, RUNNING, ENDED };
enum {
    NONE, WRONG_SLOPE, WRONG_RUN, UNTOLD_DEPENDENCY, SHARED_DAMPING, IGNORED_START, OTHER_START, IDLE_GAIN, HALF_RESTORED,
    HALF_RESET, CRASH_EARLY, CRASH_SAVE, MEMORY, EULER, ANY_REFERENCE, HANG, BENT, OTHER_DERIVATIVE, TALKATIVE, SLOW,
    FIXED_STEP, EARLY_END
};
typedef struct { double v[COUNT], time, last, inner; int fault, phase, ended; } Mass;

static const double START[COUNT] = {0.5, 0, 0, 0, 0, 0, 2, 80, 1, 3};
static double shared_damping = 1;

static double damping(const Mass *c) { return c->fault == SHARED_DAMPING ? shared_damping : c->v[D]; }

static void rates(Mass *c, const double x[2], double out[2], int running)
{
    double gain = c->fault == IDLE_GAIN ? 3 : c->v[G], d = damping(c);
    if (c->fault == WRONG_RUN && running) d *= 1.2;
    out[0] = x[1];
    out[1] = (gain * c->v[U] - c->v[K] * x[0] - d * x[1]) / c->v[M];
    if (c->fault == MEMORY) { out[1] += 1e-3 * c->last; c->last = x[0]; }
    if (c->fault == BENT) out[1] -= x[0] * x[0] * x[0];
}

static double value(Mass *c, Ref r)
{
    double x[2] = {c->v[X], c->v[V]}, out[2];
    if (r == DX || r == DV) { rates(c, x, out, 0); return out[r - DX] + (c->fault == OTHER_DERIVATIVE && r == DV); }
    if (r == Y) return c->v[X] + (c->fault == UNTOLD_DEPENDENCY ? 0.1 * c->v[U] : 0);
    return c->v[r];
}

static void start_values(Mass *c)
{
    double kept = c->v[D];
    memcpy(c->v, START, sizeof START);
    if (c->fault == HALF_RESET && c->phase == ENDED) c->v[D] = kept;
    if (c->fault == OTHER_START) c->v[X] = 0.4;
    c->time = c->last = c->inner = c->ended = 0;
    c->phase = MADE;
}

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }
int fmi2SetDebugLogging(Me c, int on, size_t n, const char **names) { (void)c, (void)on, (void)n, (void)names; return OK; }

Me fmi2Instantiate(const char *name, int type, const char *token, const char *where, const Callbacks *f, int vis, int log)
{
    Mass *c = calloc(1, sizeof *c);
    (void)name, (void)type, (void)where, (void)f, (void)vis, (void)log;
    if (!c || strncmp(token, "fault ", 6)) return NULL;
    c->fault = atoi(token + 6);
    for (int k = 0; c->fault == TALKATIVE && k < 10000; k++) fputs("no word of \374se to you\n", stderr); /* not UTF-8 */
    for (clock_t end = clock() + CLOCKS_PER_SEC / 2; c->fault == SLOW && clock() < end;) {}
    start_values(c);
    return c;
}
void fmi2FreeInstance(Me c) { free(c); }
int fmi2SetupExperiment(Me c, int td, double t, double s, int ed, double e)
{
    (void)td, (void)t, (void)ed, (void)e;
    if (!c) return ERROR;
    ((Mass *)c)->time = s;
    return OK;
}
static int go(Mass *c, int from, int to)
{
    if (!c || c->phase != from) return ERROR;
    c->phase = to;
    return OK;
}
int fmi2EnterInitializationMode(Me c) { return go(c, MADE, STARTING); }
int fmi2ExitInitializationMode(Me c) { return go(c, STARTING, RUNNING); }
int fmi2Terminate(Me c)
{
    volatile int for_ever = c && ((Mass *)c)->fault == HANG;
    while (for_ever) {}
    return go(c, RUNNING, ENDED);
}
int fmi2Reset(Me c) { ((Mass *)c)->phase = ENDED; start_values(c); return OK; }

int fmi2GetReal(Me me, const Ref *r, size_t n, double *out)
{
    Mass *c = me;
    if (!c || (n && (!r || !out))) return ERROR;
    for (size_t i = 0; i < n; i++) {
        if (r[i] >= COUNT && c->fault != ANY_REFERENCE) return ERROR;
        out[i] = r[i] < COUNT ? value(c, r[i]) : 0;
    }
    return OK;
}
int fmi2SetReal(Me me, const Ref *r, size_t n, const double *in)
{
    Mass *c = me;
    if (!c || (n && (!r || !in))) return ERROR;
    for (size_t i = 0; i < n; i++) {
        if (r[i] >= COUNT || r[i] == DX || r[i] == DV || r[i] == Y) return ERROR;
        if (c->fault == IGNORED_START && r[i] == X && c->phase == MADE) continue;
        c->v[r[i]] = in[i];
        if (r[i] == D) shared_damping = in[i];
    }
    return OK;
}

typedef struct { Mass kept; } Saved;
int fmi2GetFMUstate(Me c, Me *s)
{
    if (((Mass *)c)->fault == CRASH_SAVE) *(volatile int *)0 = 1;
    if (!*s) *s = malloc(sizeof(Saved));
    ((Saved *)*s)->kept = *(Mass *)c;
    return OK;
}
int fmi2SetFMUstate(Me me, Me s)
{
    Mass *c = me;
    double v = c->v[V];
    *c = ((Saved *)s)->kept;
    if (c->fault == HALF_RESTORED) c->v[V] = v;
    return OK;
}
int fmi2FreeFMUstate(Me c, Me *s) { (void)c; free(*s); *s = NULL; return OK; }

int fmi2GetDirectionalDerivative(Me me, const Ref *z, size_t nz, const Ref *w, size_t nw, const double *dw, double *dz)
{
    Mass *c = me;
    for (size_t i = 0; i < nz; i++) {
        dz[i] = 0;
        for (size_t k = 0; k < nw; k++) {
            double slope = 0;
            if (z[i] == DX) slope = w[k] == V;
            if (z[i] == Y) slope = (w[k] == X) + (w[k] == U && c->fault == UNTOLD_DEPENDENCY ? 0.1 : 0);
            if (z[i] == DV) {
                if (w[k] == X) slope = -c->v[K] / c->v[M] - (c->fault == BENT ? 3 * c->v[X] * c->v[X] : 0);
                if (w[k] == V) slope = -damping(c) / c->v[M] * (c->fault == WRONG_SLOPE ? 1.01 : 1);
                if (w[k] == U) slope = (c->fault == IDLE_GAIN ? 3 : c->v[G]) / c->v[M];
            }
            dz[i] += slope * dw[k];
        }
    }
    return OK;
}

int fmi2EnterEventMode(Me c) { return ((Mass *)c)->phase == RUNNING ? OK : ERROR; }
int fmi2NewDiscreteStates(Me c, Events *e) { memset(e, 0, sizeof *e); return ((Mass *)c)->phase == RUNNING ? OK : ERROR; }
int fmi2EnterContinuousTimeMode(Me c) { return ((Mass *)c)->phase == RUNNING ? OK : ERROR; }
int fmi2CompletedIntegratorStep(Me me, int n, int *e, int *t)
{
    Mass *c = me;
    (void)n;
    *e = 0;
    *t = c->fault == EARLY_END && c->time >= END - 1e-9;
    return OK;
}
int fmi2GetBooleanStatus(Me me, int kind, int *value)
{
    Mass *c = me;
    if (c->fault != EARLY_END || kind != 3) return ERROR;
    *value = c->ended;
    return OK;
}
int fmi2SetTime(Me c, double t)
{
    if (((Mass *)c)->phase != RUNNING) return ERROR;
    ((Mass *)c)->time = t;
    return OK;
}
int fmi2SetContinuousStates(Me c, const double *x, size_t n)
{
    if (((Mass *)c)->phase != RUNNING || n != 2) return ERROR;
    memcpy(((Mass *)c)->v, x, 2 * sizeof *x);
    return OK;
}
int fmi2GetContinuousStates(Me c, double *x, size_t n)
{
    memcpy(x, ((Mass *)c)->v, n * sizeof *x);
    return OK;
}
int fmi2GetDerivatives(Me me, double *out, size_t n)
{
    Mass *c = me;
    if (c->phase != RUNNING && c->fault == CRASH_EARLY) *(volatile int *)0 = 1;
    if (c->phase != RUNNING || n != 2) return ERROR;
    rates(c, c->v, out, 0);
    return OK;
}
int fmi2GetEventIndicators(Me c, double *z, size_t n) { (void)c, (void)z, (void)n; return OK; }
int fmi2GetNominalsOfContinuousStates(Me c, double *x, size_t n) { (void)c; while (n) x[--n] = 1; return OK; }

int fmi2DoStep(Me me, double t, double h, int unused)
{
    Mass *c = me;
    double k0[2];
    (void)unused;
    if (!c || c->phase != RUNNING || !(h > 0)) return ERROR;
    if (c->fault == EARLY_END && t + h > END + 1e-9) return c->ended = 1, DISCARD;
    for (; c->fault == FIXED_STEP && c->inner + GRID <= t + h + 1e-9; c->inner += GRID) {
        rates(c, c->v, k0, 1);
        for (int m = 0; m < 2; m++) c->v[m] += GRID * k0[m];
    }
    if (c->fault == FIXED_STEP) return OK;
    int count = c->fault == EULER ? 1 : (int)ceil(h / 2e-3 - 1e-9);
    double s = h / count, *x = c->v, k[4][2], z[2];
    for (int i = 0; i < count; i++) {
        rates(c, x, k[0], 1);
        for (int j = 1; j < 4; j++) {
            for (int m = 0; m < 2; m++) z[m] = x[m] + (j == 3 ? s : s / 2) * k[j - 1][m];
            rates(c, z, k[j], 1);
        }
        for (int m = 0; m < 2; m++)
            x[m] += c->fault == EULER ? s * k[0][m] : s / 6 * (k[0][m] + 2 * k[1][m] + 2 * k[2][m] + k[3][m]);
    }
    c->time = t + h;
    return OK;
}

/* What this FMU does not offer. */
#define REFUSED(name) int name(void) { return ERROR; }
REFUSED(fmi2GetInteger) REFUSED(fmi2GetBoolean) REFUSED(fmi2GetString) REFUSED(fmi2SetInteger) REFUSED(fmi2SetBoolean)
REFUSED(fmi2SetString) REFUSED(fmi2SerializedFMUstateSize) REFUSED(fmi2SerializeFMUstate) REFUSED(fmi2DeSerializeFMUstate)
REFUSED(fmi2SetRealInputDerivatives) REFUSED(fmi2GetRealOutputDerivatives) REFUSED(fmi2CancelStep) REFUSED(fmi2GetStatus)
REFUSED(fmi2GetRealStatus) REFUSED(fmi2GetIntegerStatus) REFUSED(fmi2GetStringStatus)

/* Model exchange: life cycle, variables, derivatives, against the closed form of the oscillator. */
#include "importer.h"

static void derivatives_at(fmi2Component c, double t, const double *x, double *dx) {
    CHECK(fmi2SetTime(c, t) == fmi2OK);
    CHECK(fmi2SetContinuousStates(c, x, 2) == fmi2OK);
    CHECK(fmi2GetDerivatives(c, dx, 2) == fmi2OK);
}

/* Classical Runge-Kutta, 1000 steps per second. */
static void integrate(fmi2Component c, double stop, double *x) {
    const double h = 1e-3;
    for (int n = 0; n < (int)lround(stop / h); n++) {
        double k[4][2], y[2];
        const double t = n * h, part[4] = {0.0, 0.5, 0.5, 1.0};
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 2; j++) y[j] = x[j] + (i ? part[i] * h * k[i - 1][j] : 0.0);
            derivatives_at(c, t + part[i] * h, y, k[i]);
        }
        for (int j = 0; j < 2; j++) x[j] += h / 6.0 * (k[0][j] + 2.0 * k[1][j] + 2.0 * k[2][j] + k[3][j]);
        fmi2Boolean event = fmi2True, end = fmi2True;
        CHECK(fmi2SetTime(c, (n + 1) * h) == fmi2OK);
        CHECK(fmi2SetContinuousStates(c, x, 2) == fmi2OK);
        CHECK(fmi2CompletedIntegratorStep(c, fmi2True, &event, &end) == fmi2OK && !event && !end);
    }
}

static void follows_the_closed_form(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(set(c, "k", 9.0) == fmi2OK && set(c, "x", 2.0) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    const fmi2EventInfo info = handle_event(c);
    CHECK(!info.nextEventTimeDefined && !info.terminateSimulation && !info.valuesOfContinuousStatesChanged);
    double x[2];
    CHECK(fmi2GetContinuousStates(c, x, 2) == fmi2OK);
    CHECK(x[0] == 2.0 && x[1] == 0.0);
    integrate(c, 1.0, x);
    CHECK_NEAR(x[0], 2.0 * cos(3.0), 1e-10);
    CHECK_NEAR(x[1], -6.0 * sin(3.0), 1e-10);
    CHECK_NEAR(get(c, "force"), -9.0 * 2.0 * cos(3.0), 1e-9);
    CHECK(get(c, "y") == x[0] && get(c, "time") == 1.0);
    CHECK(fmi2Terminate(c) == fmi2OK);
    fmi2FreeInstance(c);
}

static void parameters_take_effect(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(fmi2EnterInitializationMode(c) == fmi2OK);
    CHECK(get(c, "omega") == 2.0);
    CHECK(set(c, "k", 16.0) == fmi2OK && get(c, "omega") == 4.0 && get(c, "der(v)") == -16.0);
    CHECK(set(c, "x", 0.5) == fmi2OK && get(c, "der(v)") == -8.0 && get(c, "y") == 0.5);
    CHECK(fmi2ExitInitializationMode(c) == fmi2OK);
    CHECK(set(c, "k", 25.0) == fmi2OK && get(c, "omega") == 5.0 && get(c, "der(v)") == -12.5); /* event mode */
    CHECK(set(c, "damping", 1.0) == fmi2Error && logged("damping") && logged("fixed"));
    CHECK(set(c, "y", 1.0) == fmi2Error && logged("only inputs and tunable"));
    handle_event(c);
    CHECK(set(c, "k", 1.0) == fmi2Error && logged("event mode"));
    CHECK(set(c, "u", 1.0) == fmi2OK && get(c, "der(v)") == 12.5);
    CHECK(set(c, "omega", 1.0) == fmi2Error && logged("omega") && logged("calculated"));
    CHECK(fmi2Reset(c) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    CHECK(get(c, "omega") == 2.0 && get(c, "u") == 0.0 && get(c, "y") == 1.0);
    fmi2FreeInstance(c);
}

/* As CasADi does: states and inputs together by fmi2SetReal, in event mode and later. */
static void states_are_set_by_reference(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    initialise_from(c, 0.0, 0.0);
    const fmi2ValueReference vr[] = {reference("x"), reference("u"), reference("v")};
    for (int continuous = 0; continuous <= 1; continuous++) {
        double x[2];
        CHECK(fmi2SetReal(c, vr, 3, (double[]){0.5, 3.0 + continuous, -2.0}) == fmi2OK);
        CHECK(get(c, "der(x)") == -2.0 && get(c, "der(v)") == 4.0 * (2.5 + continuous) && get(c, "y") == 0.5);
        CHECK(fmi2GetContinuousStates(c, x, 2) == fmi2OK && x[0] == 0.5 && x[1] == -2.0);
        CHECK(set(c, "y", 1.0) == fmi2Error && set(c, "der(x)", 1.0) == fmi2Error);
        if (!continuous) handle_event(c);
    }
    CHECK(fmi2Terminate(c) == fmi2OK && set(c, "x", 1.0) == fmi2Error);
    fmi2FreeInstance(c);
    c = instantiate(fmi2CoSimulation);
    initialise_from(c, 0.0, 0.0);
    CHECK(set(c, "x", 1.0) == fmi2Error && logged("only inputs and tunable"));
    fmi2FreeInstance(c);
}

static void partial_derivatives_are_exact(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(set(c, "damping", 0.5) == fmi2OK && set(c, "u", 3.0) == fmi2OK && set(c, "v", 0.25) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    const char *unknown_names[] = {"der(x)", "der(v)", "force", "y"}, *known_names[] = {"x", "v", "u", "k", "damping"};
    /* rows: unknowns; columns: knowns, at x = 1, v = 0.25, u = 3, k = 4, damping = 0.5 */
    const double expected[4][5] = {
        {0, 1, 0, 0, 0}, {-4, -0.5, 4, 2, -0.25}, {-4, 0, 4, 2, 0}, {1, 0, 0, 0, 0}};
    fmi2ValueReference unknowns[4];
    for (size_t i = 0; i < 4; i++) unknowns[i] = reference(unknown_names[i]);
    for (size_t j = 0; j < 5; j++) {
        const fmi2ValueReference known = reference(known_names[j]);
        const double seed = 2.0;
        double change[4];
        CHECK(fmi2GetDirectionalDerivative(c, unknowns, 4, &known, 1, &seed, change) == fmi2OK);
        for (size_t i = 0; i < 4; i++) CHECK(change[i] == 2.0 * expected[i][j]);
    }
    const fmi2ValueReference omega = reference("omega");
    double seed = 1.0, change;
    CHECK(fmi2GetDirectionalDerivative(c, unknowns, 1, &omega, 1, &seed, &change) == fmi2Error && logged("omega"));
    fmi2FreeInstance(c);
}

static void bad_values_are_discarded(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    double x[2] = {NAN, 0.0}, dx[2];
    CHECK(fmi2SetContinuousStates(c, x, 2) == fmi2OK);
    CHECK(fmi2GetDerivatives(c, dx, 2) == fmi2Discard && logged("der(v)") && logged("nan"));
    x[0] = 1.0;
    CHECK(fmi2SetContinuousStates(c, x, 2) == fmi2OK && fmi2GetDerivatives(c, dx, 2) == fmi2OK && dx[1] == -4.0);
    fmi2FreeInstance(c);
}

static void many_instances_are_independent(void) {
    enum { N = 50 };
    fmi2Component c[N];
    for (int n = 0; n < N; n++) {
        c[n] = instantiate(fmi2ModelExchange);
        CHECK(set(c[n], "k", n + 1.0) == fmi2OK);
    }
    for (int n = 0; n < N; n++) initialise_from(c[n], 0.0, 0.0);
    for (int n = 0; n < N; n++) CHECK(get(c[n], "der(v)") == -(n + 1.0));
    for (int n = 0; n < N; n++) fmi2FreeInstance(c[n]);
    for (int n = 0; n < 2000; n++) fmi2FreeInstance(instantiate(n % 2 ? fmi2CoSimulation : fmi2ModelExchange));
}

int main(void) {
    follows_the_closed_form();
    parameters_take_effect();
    states_are_set_by_reference();
    partial_derivatives_are_exact();
    bad_values_are_discarded();
    many_instances_are_independent();
    return 0;
}

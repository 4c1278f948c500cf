/* delay(): the method of steps gives x' = -x(t - T) in closed form. */
#include "importer.h"

/* x(t) for T = 1, x = 1 before 0: the sum of (-1)^k (t - k + 1)^k / k! over all k with t > k - 1. */
static double solution(double t) {
    double sum = 1.0, factorial = 1.0;
    for (int k = 1; t > k - 1; k++) {
        factorial *= k;
        sum += (k % 2 ? -1.0 : 1.0) * pow(t - k + 1, k) / factorial;
    }
    return sum;
}

static void cosimulation_follows(void) {
    const double steps[] = {5.0, 0.5, 0.01};
    for (size_t k = 0; k < COUNT(steps); k++) {
        fmi2Component c = instantiate(fmi2CoSimulation);
        initialise_from(c, 0.0, 1e-9);
        run_steps(c, 0.0, 5.0, steps[k]);
        CHECK_NEAR(get(c, "x"), solution(5.0), 1e-7);
        fmi2FreeInstance(c);
    }
}

/* A jump of the input arrives after exactly T, without a smooth ramp around it. */
static void jumps_stay_jumps(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    CHECK(set(c, "T", 0.37) == fmi2OK);
    initialise_from(c, 0.0, 1e-9);
    run_steps(c, 0.0, 0.5, 0.1);
    CHECK(set(c, "u", 1.0) == fmi2OK);
    run_steps(c, 0.5, 0.8, 0.1);
    CHECK(set(c, "u", -2.0) == fmi2OK);
    CHECK(get(c, "y") == 0.0);
    run_steps(c, 0.8, 1.5, 0.1);
    CHECK_NEAR(get(c, "y"), 0.3 * 1.0 - 2.0 * (1.5 - 1.17), 1e-9);
    fmi2FreeInstance(c);
}

static void model_exchange_announces_breaks(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(set(c, "T", 0.25) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    fmi2EventInfo info = handle_event(c);
    CHECK(info.nextEventTimeDefined && info.nextEventTime == 0.25); /* the history bends where it begins */
    double x[2] = {1.0, 0.0};
    fmi2Boolean event, end;
    for (int n = 1; n <= 250; n++) { /* x = 1 - t: Euler is exact */
        x[0] = 1.0 - n * 1e-3;
        CHECK(fmi2SetTime(c, n * 1e-3) == fmi2OK && fmi2SetContinuousStates(c, x, 2) == fmi2OK);
        CHECK(fmi2CompletedIntegratorStep(c, fmi2True, &event, &end) == fmi2OK && get(c, "der(x)") == -1.0);
    }
    CHECK(fmi2EnterEventMode(c) == fmi2OK && set(c, "u", 3.0) == fmi2OK);
    info = handle_event(c);
    CHECK(info.nextEventTimeDefined && info.nextEventTime == 0.5); /* the jump of u arrives */
    CHECK(fmi2SetTime(c, 0.4) == fmi2OK);
    CHECK_NEAR(get(c, "der(x)"), -0.85, 1e-12);
    CHECK(fmi2SetTime(c, 0.5) == fmi2OK && get(c, "der(y)") == 0.0);
    CHECK(fmi2EnterEventMode(c) == fmi2OK);
    handle_event(c);
    CHECK(get(c, "der(y)") == 3.0);
    fmi2FreeInstance(c);
}

static void a_bad_delay_time_is_refused(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(set(c, "T", 6.0) == fmi2OK && fmi2EnterInitializationMode(c) == fmi2OK);
    CHECK(fmi2ExitInitializationMode(c) == fmi2Error && logged("maximum 5 s"));
    fmi2FreeInstance(c);
}

static void no_delay_is_no_delay(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    CHECK(set(c, "T", 0.0) == fmi2OK && set(c, "u", 2.0) == fmi2OK);
    initialise_from(c, 0.0, 1e-6);
    run_steps(c, 0.0, 1.0, 0.1);
    CHECK_NEAR(get(c, "x"), exp(-1.0), 1e-5);
    CHECK_NEAR(get(c, "y"), 2.0, 1e-12);
    fmi2FreeInstance(c);
}

/* One step of 1 s, in which a delay is followed by at most 20000 steps: shorter ones are interpolated. */
static void a_tiny_delay_is_no_hang(void) {
    const double delays[] = {1e-5, 1e-9, 1e-15};
    for (size_t k = 0; k < COUNT(delays); k++) {
        fmi2Component c = instantiate(fmi2CoSimulation);
        CHECK(set(c, "T", delays[k]) == fmi2OK && set(c, "u", 2.0) == fmi2OK);
        initialise_from(c, 0.0, 1e-8);
        run_steps(c, 0.0, 1.0, 1.0);
        CHECK_NEAR(get(c, "x"), exp(-1.0 - delays[k]), 1e-6);
        CHECK_NEAR(get(c, "y"), 2.0, 1e-12);
        fmi2FreeInstance(c);
    }
}

static void only_numbers_are_inputs(void) {
    const double values[] = {NAN, INFINITY, -INFINITY};
    fmi2Component c = instantiate(fmi2CoSimulation);
    initialise_from(c, 0.0, 1e-6);
    for (size_t k = 0; k < COUNT(values); k++) {
        CHECK(set(c, "u", values[k]) == fmi2Error && logged("give it a number"));
        CHECK(get(c, "u") == 0.0);
    }
    run_steps(c, 0.0, 1.0, 0.5);
    fmi2FreeInstance(c);
}

int main(void) {
    cosimulation_follows();
    jumps_stay_jumps();
    model_exchange_announces_breaks();
    a_bad_delay_time_is_refused();
    no_delay_is_no_delay();
    a_tiny_delay_is_no_hang();
    only_numbers_are_inputs();
    return 0;
}

/* Clocks and relations of time against the recursion of the sampled integrator. */
#include "importer.h"

static void ticks_at_exact_times(void) {
    const double steps[] = {1.0, 0.1, 0.04};
    for (size_t k = 0; k < COUNT(steps); k++) {
        fmi2Component c = instantiate(fmi2CoSimulation);
        initialise_from(c, 0.0, 0.0);
        CHECK(get_integer(c, "initial") == 1 && get_integer(c, "n") == 1);
        run_steps(c, 0.0, 1.0, steps[k]);
        CHECK(get_integer(c, "n") == 11);
        CHECK_NEAR(get(c, "x"), pow(0.8, 10), 1e-12); /* x(n+1) = x(n) (1 - gain interval) */
        CHECK_NEAR(get(c, "y"), 0.75, 1e-12);
        CHECK(fmi2Terminate(c) == fmi2OK);
        CHECK(get_integer(c, "initial") == 11);
        fmi2FreeInstance(c);
    }
}

/* Of every three steps the third ends at a tick, one rounding step ahead of it or behind. */
static void a_tick_within_rounding_of_a_steps_end_belongs_to_the_step(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    initialise_from(c, 0.0, 0.0);
    for (int k = 0; k < 300; k++) {
        const double here = k * (1.0 / 30.0), next = (k + 1) * (1.0 / 30.0);
        CHECK(fmi2DoStep(c, here, next - here, fmi2True) == fmi2OK);
        CHECK(get_integer(c, "n") == (k + 1) / 3 + 1);
    }
    fmi2FreeInstance(c);
}

/* A million ticks: start + n interval, not a sum with a million rounding errors. */
static void ticks_do_not_drift(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(set(c, "interval", 0.1) == fmi2OK && set(c, "t_step", 1e9) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    fmi2EventInfo info = handle_event(c);
    for (int n = 1; n <= 1000000; n++) {
        CHECK(info.nextEventTimeDefined && info.nextEventTime == n * 0.1);
        CHECK(fmi2SetTime(c, info.nextEventTime) == fmi2OK && fmi2EnterEventMode(c) == fmi2OK);
        info = handle_event(c);
    }
    CHECK(get_integer(c, "n") == 1000001);
    fmi2FreeInstance(c);
}

static void no_tick_comes_before_the_start_of_the_clock(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    CHECK(set(c, "start", 0.55) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    run_steps(c, 0.0, 0.5, 0.05);
    CHECK(get_integer(c, "n") == 0);
    run_steps(c, 0.5, 1.0, 0.05);
    CHECK(get_integer(c, "n") == 5); /* 0.55, 0.65, ... 0.95 */
    fmi2FreeInstance(c);
}

static void a_tick_happens_once(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    fmi2EventInfo info;
    initialise_from(c, 0.0, 0.0);
    CHECK(fmi2NewDiscreteStates(c, &info) == fmi2OK && fmi2NewDiscreteStates(c, &info) == fmi2OK);
    CHECK(get_integer(c, "n") == 1 && info.nextEventTime == 0.1);
    CHECK(set(c, "interval", 0.03) == fmi2OK && fmi2NewDiscreteStates(c, &info) == fmi2OK);
    CHECK(get_integer(c, "n") == 1);
    CHECK_NEAR(info.nextEventTime, 0.03, 1e-15);
    CHECK(set(c, "interval", 0.0) == fmi2OK && fmi2NewDiscreteStates(c, &info) == fmi2Error && logged("must be positive"));
    fmi2FreeInstance(c);
}

static void a_discrete_input_acts_between_steps(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    const fmi2ValueReference on = reference("on");
    const fmi2Boolean yes = fmi2True;
    initialise_from(c, 0.0, 0.0);
    run_steps(c, 0.0, 0.3, 0.1);
    CHECK(fmi2SetBoolean(c, &on, 1, &yes) == fmi2OK);
    run_steps(c, 0.3, 1.0, 0.1);
    CHECK_NEAR(get(c, "z"), 0.7, 1e-12);
    fmi2FreeInstance(c);
}

static void the_start_may_lie_anywhere(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(set(c, "start", -0.05) == fmi2OK);
    initialise_from(c, 10.0, 0.0);
    const fmi2EventInfo info = handle_event(c);
    CHECK(get_integer(c, "n") == 0 && get(c, "y") == 0.0);
    CHECK_NEAR(info.nextEventTime, 10.05, 1e-14);
    fmi2FreeInstance(c);
}

/* t_step is the start itself: not yet passed while the model is initialised, but at the first event. */
static void a_relation_of_time_may_turn_at_the_start(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    double rates[3] = {NAN, NAN, NAN};
    CHECK(set(c, "t_step", 2.0) == fmi2OK);
    initialise_from(c, 2.0, 0.0);
    CHECK(fmi2GetDerivatives(c, rates, 3) == fmi2OK && rates[1] == 0.0);
    handle_event(c);
    CHECK(fmi2GetDerivatives(c, rates, 3) == fmi2OK && rates[1] == 1.0);
    fmi2FreeInstance(c);
}

int main(void) {
    ticks_at_exact_times();
    a_tick_within_rounding_of_a_steps_end_belongs_to_the_step();
    ticks_do_not_drift();
    no_tick_comes_before_the_start_of_the_clock();
    a_tick_happens_once();
    a_discrete_input_acts_between_steps();
    the_start_may_lie_anywhere();
    a_relation_of_time_may_turn_at_the_start();
    return 0;
}

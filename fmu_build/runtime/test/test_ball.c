/* State events against the closed form of the bouncing ball, in both kinds of FMU. */
#include "importer.h"

static const double g = 9.81, e = 0.7;

/* Time of bounce n = 1, 2, ... of a ball dropped from 1 m. */
static double bounce_time(int n) {
    const double first = sqrt(2.0 / g);
    return first * (1.0 + 2.0 * (e - pow(e, n)) / (1.0 - e));
}

static double height(double t) {
    int n = 0;
    while (bounce_time(n + 1) <= t) n++;
    const double since = n ? t - bounce_time(n) : t;
    const double speed = n ? pow(e, n) * g * sqrt(2.0 / g) : 0.0;
    return (n ? 0.0 : 1.0) + speed * since - 0.5 * g * since * since;
}

static void cosimulation_is_independent_of_the_step(void) {
    const double steps[] = {2.0, 0.5, 0.1, 0.0125};
    for (size_t k = 0; k < COUNT(steps); k++) {
        fmi2Component c = instantiate(fmi2CoSimulation);
        initialise_from(c, 0.0, 1e-10);
        run_steps(c, 0.0, 2.0, steps[k]);
        CHECK(get_integer(c, "bounces") == 4); /* the next one is at 2.05 s */
        CHECK_NEAR(get(c, "h"), height(2.0), 1e-8);
        fmi2FreeInstance(c);
    }
}

/* Puts the ball where it is `since` seconds after it was at x0. */
static double fly(fmi2Component c, double begin, const double *x0, double since) {
    const double x[2] = {x0[0] + x0[1] * since - 0.5 * g * since * since, x0[1] - g * since};
    double z = 0.0;
    CHECK(fmi2SetTime(c, begin + since) == fmi2OK && fmi2SetContinuousStates(c, x, 2) == fmi2OK);
    CHECK(fmi2GetEventIndicators(c, &z, 1) == fmi2OK);
    return z;
}

/* Time from x0 until the event indicator changes its sign: steps of 1 ms, then halves. */
static double fly_to_event(fmi2Component c, double begin, const double *x0) {
    const double side = fly(c, begin, x0, 0.0);
    double low = 0.0, high = 1e-3;
    CHECK(side != 0.0); /* no event at once after an event */
    while (side * fly(c, begin, x0, high) > 0.0) low = high, high += 1e-3;
    for (int n = 0; n < 50; n++) {
        const double middle = 0.5 * (low + high);
        *(side * fly(c, begin, x0, middle) > 0.0 ? &low : &high) = middle;
    }
    fly(c, begin, x0, high);
    return high;
}

/* A ball that lies on the ground from the start: its indicator has never had a size, and still no event is due. */
static void a_ball_that_lies_makes_no_event(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(set(c, "g", 0.0) == fmi2OK && set(c, "h", 0.0) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    const double lying[2] = {0.0, 0.0};
    double z = 0.0;
    for (int n = 0; n < 3; n++) {
        CHECK(fmi2SetTime(c, 0.1 * n) == fmi2OK && fmi2SetContinuousStates(c, lying, 2) == fmi2OK);
        CHECK(fmi2GetEventIndicators(c, &z, 1) == fmi2OK && z > 0.0); /* on the side of h <= 0 */
    }
    fmi2FreeInstance(c);
}

static void model_exchange_finds_each_bounce(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    double t = 0.0, x[2];
    for (int n = 1; n <= 4; n++) {
        fmi2Boolean wants_event = fmi2False, end = fmi2True;
        int rises = 0;
        do { /* after a bounce the indicator changes back when the ball has risen above the ground */
            CHECK(fmi2GetContinuousStates(c, x, 2) == fmi2OK);
            t += fly_to_event(c, t, x);
            CHECK(fmi2CompletedIntegratorStep(c, fmi2True, &wants_event, &end) == fmi2OK && wants_event && !end);
            CHECK(fmi2EnterEventMode(c) == fmi2OK);
            CHECK(handle_event(c).valuesOfContinuousStatesChanged == (get_integer(c, "bounces") == n));
        } while (get_integer(c, "bounces") < n && ++rises < 2);
        CHECK_NEAR(t, bounce_time(n), 1e-9);
    }
    fmi2FreeInstance(c);
}

static void the_model_can_end_the_run(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    double time = 0.0;
    fmi2Boolean ended = fmi2False;
    CHECK(set(c, "last", 3.0) == fmi2OK);
    initialise_from(c, 0.0, 1e-10);
    CHECK(fmi2DoStep(c, 0.0, 5.0, fmi2True) == fmi2Discard);
    CHECK(fmi2GetBooleanStatus(c, fmi2Terminated, &ended) == fmi2OK && ended);
    CHECK(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK);
    CHECK_NEAR(time, bounce_time(3), 1e-8);
    CHECK(get_integer(c, "bounces") == 3);
    const double end = get(c, "time");
    CHECK(fmi2DoStep(c, end, 0.1, fmi2True) == fmi2Discard && get(c, "time") == end); /* it stays ended */
    CHECK(fmi2Terminate(c) == fmi2OK);
    fmi2FreeInstance(c);
}

static void the_model_can_end_the_run_at_its_start(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    double time = NAN;
    fmi2Boolean ended = fmi2False;
    CHECK(set(c, "last", 0.0) == fmi2OK);
    initialise_from(c, 0.5, 1e-10);
    CHECK(fmi2DoStep(c, 0.5, 5.0, fmi2True) == fmi2Discard);
    CHECK(fmi2GetBooleanStatus(c, fmi2Terminated, &ended) == fmi2OK && ended);
    CHECK(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK && time == 0.5);
    CHECK(fmi2Terminate(c) == fmi2OK && fmi2Reset(c) == fmi2OK);
    initialise_from(c, 0.0, 1e-10); /* with the default, it does not end */
    CHECK(fmi2DoStep(c, 0.0, 1.0, fmi2True) == fmi2OK);
    fmi2FreeInstance(c);
}

static void checks_warn_once_or_fail(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    CHECK(set(c, "g", 1000.0) == fmi2OK && set(c, "h", 20.0) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    messages = 0;
    CHECK(fmi2DoStep(c, 0.0, 0.15, fmi2True) == fmi2Warning && messages == 1);
    CHECK(logged("faster than 100 m/s") && logged("time"));
    CHECK(fmi2DoStep(c, 0.15, 0.04, fmi2True) == fmi2OK && messages == 1);
    CHECK(set(c, "g", -1.0) == fmi2OK);
    CHECK(fmi2DoStep(c, 0.19, 0.1, fmi2True) == fmi2Error && logged("Gravity is negative"));
    CHECK(fmi2DoStep(c, 0.19, 0.1, fmi2True) == fmi2Error && logged("not allowed"));
    CHECK(fmi2Reset(c) == fmi2OK);
    initialise_from(c, 0.0, 0.0);
    CHECK(fmi2DoStep(c, 0.0, 0.1, fmi2True) == fmi2OK);
    fmi2FreeInstance(c);
}

int main(void) {
    cosimulation_is_independent_of_the_step();
    model_exchange_finds_each_bounce();
    a_ball_that_lies_makes_no_event();
    the_model_can_end_the_run();
    the_model_can_end_the_run_at_its_start();
    checks_warn_once_or_fail();
    return 0;
}

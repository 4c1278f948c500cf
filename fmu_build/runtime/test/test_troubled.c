/* What fails ends in a status and a message, and an instance that can be used again. */
#include "importer.h"

enum { QUIET, RESTLESS, NOT_A_NUMBER, NO_SOLUTION, INFINITE, NO_SHARE, ROUGH };

static fmi2Component with_trouble(fmi2Type type, int kind) {
    fmi2Component c = instantiate(type);
    const fmi2ValueReference vr = reference("trouble");
    CHECK(fmi2SetInteger(c, &vr, 1, &kind) == fmi2OK);
    return c;
}

static void restless_events_are_an_error(void) {
    fmi2Component c = with_trouble(fmi2ModelExchange, RESTLESS);
    CHECK(fmi2EnterInitializationMode(c) == fmi2OK);
    CHECK(fmi2ExitInitializationMode(c) == fmi2Error && logged("do not come to rest"));
    fmi2FreeInstance(c);
}

/* x runs from 1 into a region without a solution at 0.5: the step is undone, and a shorter one may follow. */
static void impossible_steps_are_undone(int kind) {
    fmi2Component c = with_trouble(fmi2CoSimulation, kind);
    fmi2FMUstate before = NULL;
    double time = -1.0;
    initialise_from(c, 0.0, 1e-8);
    CHECK(fmi2DoStep(c, 0.0, 0.1, fmi2True) == fmi2OK);
    CHECK(fmi2GetFMUstate(c, &before) == fmi2OK);
    const double x = get(c, "x"), q = get(c, "q"), slope = get(c, "der(x)"), reciprocal = get(c, "reciprocal");
    CHECK(fmi2DoStep(c, 0.1, 5.0, fmi2False) == fmi2Discard && logged("cannot be evaluated"));
    CHECK(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK && time == 0.1);
    CHECK(get(c, "x") == x && get(c, "time") == 0.1);
    CHECK(get(c, "q") == q && get(c, "der(x)") == slope && get(c, "reciprocal") == reciprocal);
    CHECK(fmi2DoStep(c, 0.1, 0.1, fmi2False) == fmi2Error && logged("not allowed in state"));
    CHECK(fmi2SetFMUstate(c, before) == fmi2OK);
    CHECK(fmi2DoStep(c, 0.1, 0.1, fmi2False) == fmi2OK);
    CHECK(fmi2FreeFMUstate(c, &before) == fmi2OK && !before);
    fmi2FreeInstance(c);
}

/* Each step gets on a little, and a second would take 1e10 of them. */
static void an_endless_step_is_an_error(void) {
    fmi2Component c = with_trouble(fmi2CoSimulation, ROUGH);
    initialise_from(c, 0.0, 1e-8);
    CHECK(fmi2DoStep(c, 0.0, 1.0, fmi2True) == fmi2Error && logged("inside one communication step of 1 s"));
    CHECK(logged("x asks for the shortest"));
    fmi2FreeInstance(c);
}

static void impossible_points_are_discarded(int kind) {
    fmi2Component c = with_trouble(fmi2ModelExchange, kind);
    double x = 0.4, dx;
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    CHECK(fmi2SetContinuousStates(c, &x, 1) == fmi2OK);
    CHECK(fmi2GetDerivatives(c, &dx, 1) == fmi2Discard && logged("time 0 s"));
    CHECK(kind != NO_SOLUTION || logged("the non-linear equations lead nowhere at q = "));
    x = 0.6;
    CHECK(fmi2SetContinuousStates(c, &x, 1) == fmi2OK && fmi2GetDerivatives(c, &dx, 1) == fmi2OK);
    if (kind == NO_SOLUTION) {
        CHECK_NEAR(get(c, "q"), sqrt(0.1), 1e-14);
    }
    fmi2FreeInstance(c);
}

/* One value that does not exist is no reason to withhold the others. */
static void infinite_outputs_are_discarded(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    const fmi2ValueReference vr = reference("reciprocal");
    double x = 0.75, dx, value;
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    CHECK(fmi2SetContinuousStates(c, &x, 1) == fmi2OK);
    CHECK(fmi2GetReal(c, &vr, 1, &value) == fmi2Discard && logged("fmi2GetReal: reciprocal is infinite at time 0 s."));
    CHECK(fmi2GetDerivatives(c, &dx, 1) == fmi2OK && get(c, "q") == 1.0);
    x = 0.8;
    CHECK(fmi2SetContinuousStates(c, &x, 1) == fmi2OK);
    CHECK_NEAR(get(c, "reciprocal"), 20.0, 1e-12);
    fmi2FreeInstance(c);
}

static void infinite_discrete_values_are_discarded(void) {
    fmi2Component c = with_trouble(fmi2ModelExchange, INFINITE);
    const fmi2ValueReference vr = reference("d");
    double value;
    initialise_from(c, 0.0, 0.0);
    CHECK(fmi2GetReal(c, &vr, 1, &value) == fmi2Discard && logged("fmi2GetReal: d is infinite at time 0 s."));
    CHECK(get(c, "share") == -1.0);
    fmi2FreeInstance(c);
}

static void infinite_calculated_parameters_are_discarded(void) {
    fmi2Component c = with_trouble(fmi2ModelExchange, NO_SHARE);
    const fmi2ValueReference vr = reference("share");
    double value;
    initialise_from(c, 0.0, 0.0);
    CHECK(fmi2GetReal(c, &vr, 1, &value) == fmi2Discard && logged("share is infinite"));
    CHECK(get(c, "d") == 0.0);
    fmi2FreeInstance(c);
}

/* What the status functions say belongs to the state, not to the last step that was tried. */
static void a_restored_state_brings_its_status(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    fmi2FMUstate before = NULL;
    double time = -1.0;
    initialise_from(c, 0.0, 1e-8);
    CHECK(fmi2DoStep(c, 0.0, 0.1, fmi2True) == fmi2OK && fmi2GetFMUstate(c, &before) == fmi2OK);
    CHECK(fmi2DoStep(c, 0.1, 0.3, fmi2False) == fmi2OK);
    CHECK(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK && time == 0.4);
    CHECK(fmi2SetFMUstate(c, before) == fmi2OK);
    CHECK(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK && time == 0.1);
    CHECK(fmi2FreeFMUstate(c, &before) == fmi2OK);
    fmi2FreeInstance(c);
}

static void calls_out_of_order_are_errors(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    double x = 0.0;
    CHECK(fmi2DoStep(c, 0.0, 1.0, fmi2True) == fmi2Error && logged("not allowed in state \"instantiated\""));
    CHECK(fmi2ExitInitializationMode(c) == fmi2Error && logged("fmi2ExitInitializationMode"));
    initialise_from(c, 0.0, 0.0);
    CHECK(fmi2GetDerivatives(c, &x, 1) == fmi2Error);
    CHECK(fmi2DoStep(c, 0.5, 1.0, fmi2True) == fmi2Error && logged("begins at 0.5 s, but the FMU is at 0 s"));
    CHECK(fmi2DoStep(c, 0.0, -1.0, fmi2True) == fmi2Error && logged("must be positive"));
    CHECK(fmi2DoStep(c, 0.0, NAN, fmi2True) == fmi2Error && logged("nan"));
    CHECK(fmi2EnterInitializationMode(c) == fmi2Error);
    CHECK(fmi2DoStep(c, 0.0, 0.25, fmi2True) == fmi2OK); /* misuse does no harm */
    CHECK_NEAR(get(c, "x"), 0.75, 1e-12);
    fmi2FreeInstance(c);
}

static void wrong_arguments_are_errors(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    fmi2ValueReference vr[] = {1, 99};
    double values[2];
    fmi2String text;
    CHECK(fmi2GetReal(c, vr, 2, values) == fmi2Error && logged("no variable with value reference 99"));
    CHECK(fmi2GetReal(c, NULL, 1, values) == fmi2Error && logged("null"));
    CHECK(fmi2GetReal(c, vr, 1, NULL) == fmi2Error && fmi2SetReal(c, vr, 1, NULL) == fmi2Error);
    CHECK(fmi2GetReal(c, NULL, 0, NULL) == fmi2OK);
    vr[0] = reference("trouble");
    CHECK(fmi2GetReal(c, vr, 1, values) == fmi2Error && logged("trouble is of type Integer, not Real"));
    CHECK(fmi2GetString(c, vr, 1, &text) == fmi2Error && logged("no String variables"));
    CHECK(fmi2GetDerivatives(c, values, 2) == fmi2Error && logged("2 values were given, but there are 1"));
    CHECK(fmi2SetTime(c, INFINITY) == fmi2Error && logged("inf"));
    CHECK(fmi2GetReal(NULL, vr, 1, values) == fmi2Error);
    CHECK(fmi2SetDebugLogging(c, fmi2True, 1, (const fmi2String[]){"nonsense"}) == fmi2Error && logged("nonsense"));
    fmi2FreeInstance(c);
    fmi2FreeInstance(NULL);
    CHECK(!fmi2Instantiate("test", fmi2CoSimulation, "{other}", NULL, &callbacks, 0, 0) && logged("GUID"));
    CHECK(!fmi2Instantiate(NULL, fmi2CoSimulation, model.token, NULL, &callbacks, 0, 0) && logged("name"));
    c = fmi2Instantiate("silent", fmi2CoSimulation, model.token, NULL, NULL, 0, 0);
    CHECK(c && fmi2DoStep(c, 0.0, 1.0, 0) == fmi2Error);
    fmi2FreeInstance(c);
}

static void nothing_goes_beyond_the_stop_time(void) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    CHECK(fmi2SetupExperiment(c, fmi2False, 0.0, 2.0, fmi2True, 1.0) == fmi2Error && logged("not usable"));
    CHECK(fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2True, 0.2) == fmi2OK);
    CHECK(fmi2EnterInitializationMode(c) == fmi2OK && fmi2ExitInitializationMode(c) == fmi2OK);
    CHECK(fmi2DoStep(c, 0.0, 0.2, fmi2True) == fmi2OK);
    CHECK(fmi2DoStep(c, 0.2, 0.1, fmi2True) == fmi2Error && logged("stop time"));
    fmi2FreeInstance(c);
}

int main(void) {
    restless_events_are_an_error();
    impossible_steps_are_undone(NOT_A_NUMBER);
    impossible_steps_are_undone(NO_SOLUTION);
    impossible_points_are_discarded(NOT_A_NUMBER);
    impossible_points_are_discarded(NO_SOLUTION);
    an_endless_step_is_an_error();
    infinite_outputs_are_discarded();
    infinite_discrete_values_are_discarded();
    infinite_calculated_parameters_are_discarded();
    a_restored_state_brings_its_status();
    calls_out_of_order_are_errors();
    wrong_arguments_are_errors();
    nothing_goes_beyond_the_stop_time();
    return 0;
}

/* FMI 3: the abilities that FMI 2 has not, with the bouncing ball. */
#include <string.h>

#include "check.h"
#include "fmi3Functions.h"
#include "model.h"

static const double g = 9.81;
static char last_message[1024];

static void keep_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                         fmi3String message) {
    (void)environment, (void)status, (void)category;
    snprintf(last_message, sizeof last_message, "%s", message);
}

static fmi3ValueReference reference(const char *name) {
    for (size_t k = 0; k < model.n_variables; k++)
        if (strcmp(model.variables[k].name, name) == 0) return (fmi3ValueReference)k;
    fprintf(stderr, "no variable %s\n", name);
    exit(1);
}

static double get(fmi3Instance c, const char *name) {
    const fmi3ValueReference vr = reference(name);
    double value = NAN;
    CHECK(fmi3GetFloat64(c, &vr, 1, &value, 1) == fmi3OK);
    return value;
}

static int bounces(fmi3Instance c) {
    const fmi3ValueReference vr = reference("bounces");
    int32_t value = -1;
    int64_t same = -2;
    CHECK(fmi3GetInt32(c, &vr, 1, &value, 1) == fmi3OK && fmi3GetInt64(c, &vr, 1, &same, 1) == fmi3OK);
    CHECK(value == same);
    return value;
}

typedef struct {
    bool event, end, early;
    double time;
} Step;

static fmi3Status do_step(fmi3Instance c, double from, double size, Step *step) {
    return fmi3DoStep(c, from, size, fmi3True, &step->event, &step->end, &step->early, &step->time);
}

static bool states_changed;

static double update(fmi3Instance c) {
    bool more, end, nominals, defined;
    double next;
    CHECK(fmi3UpdateDiscreteStates(c, &more, &end, &nominals, &states_changed, &defined, &next) == fmi3OK);
    CHECK(!more && !end && !nominals);
    return defined ? next : INFINITY;
}

static fmi3Instance cosimulation(bool event_mode, bool early, void *environment, fmi3IntermediateUpdateCallback callback) {
    fmi3Instance c = fmi3InstantiateCoSimulation("ball", model.token, NULL, false, false, event_mode, early, NULL, 0,
                                                 environment, keep_message, callback);
    CHECK(c);
    CHECK(fmi3EnterInitializationMode(c, true, 1e-10, 0.0, false, 0.0) == fmi3OK);
    CHECK(fmi3ExitInitializationMode(c) == fmi3OK);
    return c;
}

static void the_importer_handles_events(void) {
    fmi3Instance c = cosimulation(true, true, NULL, NULL);
    Step step;
    CHECK(update(c) == INFINITY && fmi3EnterStepMode(c) == fmi3OK);
    CHECK(do_step(c, 0.0, 1.0, &step) == fmi3OK && step.event && step.early && !step.end);
    CHECK_NEAR(step.time, sqrt(2.0 / g), 1e-9);
    CHECK(bounces(c) == 0 && get(c, "v") < 0.0);
    CHECK(fmi3EnterEventMode(c) == fmi3OK);
    update(c);
    CHECK(states_changed && bounces(c) == 1 && get(c, "v") > 0.0);
    CHECK(fmi3EnterStepMode(c) == fmi3OK);
    fmi3FreeInstance(c);
}

static void without_early_return_the_step_is_finished(void) {
    fmi3Instance c = cosimulation(true, false, NULL, NULL);
    Step step;
    update(c);
    CHECK(fmi3EnterStepMode(c) == fmi3OK);
    CHECK(do_step(c, 0.0, 2.0, &step) == fmi3OK && !step.event && !step.early && step.time == 2.0 && bounces(c) == 4);
    fmi3FreeInstance(c);
}

static void without_event_mode_it_is_not_entered(void) {
    fmi3Instance c = cosimulation(false, true, NULL, NULL);
    Step step;
    CHECK(fmi3EnterEventMode(c) == fmi3Error && strstr(last_message, "eventModeUsed"));
    CHECK(do_step(c, 0.0, 2.0, &step) == fmi3OK && !step.event && !step.early && bounces(c) == 4);
    fmi3FreeInstance(c);
}

static void the_model_can_end_the_run_at_its_start(void) {
    const fmi3ValueReference last = reference("last");
    for (int early = 0; early <= 1; early++) {
        fmi3Instance c = fmi3InstantiateCoSimulation("ball", model.token, NULL, false, false, false, early, NULL, 0,
                                                     NULL, keep_message, NULL);
        CHECK(c && fmi3SetFloat64(c, &last, 1, (double[]){0.0}, 1) == fmi3OK);
        CHECK(fmi3EnterInitializationMode(c, false, 0.0, 0.0, false, 0.0) == fmi3OK);
        CHECK(fmi3ExitInitializationMode(c) == fmi3OK);
        for (int again = 0; again <= 1; again++) {
            Step step;
            CHECK(do_step(c, 0.0, 1.0, &step) == fmi3OK && step.end && !step.event && step.time == 0.0);
            CHECK(step.early == early);
        }
        CHECK(fmi3Terminate(c) == fmi3OK);
        fmi3FreeInstance(c);
    }
}

typedef struct {
    fmi3Instance instance;
    double last;
    int calls;
} Watch;

static void stop_after_half_a_second(fmi3InstanceEnvironment environment, double time, bool set_requested,
                                     bool get_allowed, bool finished, bool can_return, bool *wanted, double *at) {
    Watch *watch = environment;
    CHECK(!set_requested && get_allowed && finished && can_return && time >= watch->last);
    CHECK(get(watch->instance, "time") == time);
    CHECK(fmi3Reset(watch->instance) == fmi3Error);
    watch->last = time;
    watch->calls++;
    if (time > 0.45) *wanted = true, *at = 0.5;
}

static void the_importer_stops_a_step(void) {
    Watch watch = {NULL, 0.0, 0};
    fmi3Instance c = cosimulation(false, true, &watch, stop_after_half_a_second);
    Step step;
    watch.instance = c;
    CHECK(do_step(c, 0.0, 0.3, &step) == fmi3OK && !step.early && watch.calls > 0);
    CHECK(do_step(c, 0.3, 1.0, &step) == fmi3OK && step.early && !step.event);
    CHECK(step.time >= 0.5 && step.time == watch.last && get(c, "time") == step.time);
    fmi3FreeInstance(c);
}

/* Without debug logging an importer hears of failed assertions all the same, and not of events. */
static void what_matters_is_always_said(void) {
    for (int debug = 0; debug <= 1; debug++) {
        fmi3Instance c = fmi3InstantiateModelExchange("ball", model.token, NULL, false, debug, NULL, keep_message);
        const fmi3ValueReference vr[] = {reference("g"), reference("h")};
        bool event, end;
        CHECK(c && fmi3SetFloat64(c, vr, 2, (double[]){1000.0, 20.0}, 2) == fmi3OK);
        CHECK(fmi3EnterInitializationMode(c, false, 0.0, 0.0, false, 0.0) == fmi3OK);
        CHECK(fmi3ExitInitializationMode(c) == fmi3OK);
        update(c);
        CHECK(fmi3EnterContinuousTimeMode(c) == fmi3OK);
        CHECK(fmi3SetContinuousStates(c, (double[]){10.0, -150.0}, 2) == fmi3OK);
        last_message[0] = '\0';
        CHECK(fmi3CompletedIntegratorStep(c, true, &event, &end) == fmi3Warning);
        CHECK(strstr(last_message, "faster than 100 m/s"));
        CHECK(fmi3SetContinuousStates(c, (double[]){-1e-3, -1.0}, 2) == fmi3OK && fmi3EnterEventMode(c) == fmi3OK);
        last_message[0] = '\0';
        update(c);
        CHECK(bounces(c) == 1 && (strstr(last_message, "Event at") != NULL) == debug);
        fmi3FreeInstance(c);
    }
}

/* In event mode not the one that a bounce changes; co-simulation keeps them to itself. */
static void states_are_set_by_reference(void) {
    fmi3Instance c = fmi3InstantiateModelExchange("ball", model.token, NULL, false, true, NULL, keep_message);
    const fmi3ValueReference h = reference("h"), v = reference("v");
    const double value = 2.0;
    double dx[2];
    CHECK(c && fmi3EnterInitializationMode(c, false, 0.0, 0.0, false, 0.0) == fmi3OK);
    CHECK(fmi3ExitInitializationMode(c) == fmi3OK);
    CHECK(fmi3SetFloat64(c, &h, 1, &value, 1) == fmi3OK && get(c, "energy") == 2.0 * g);
    CHECK(fmi3SetFloat64(c, &v, 1, &value, 1) == fmi3Error && strstr(last_message, "v cannot be set"));
    update(c);
    CHECK(fmi3EnterContinuousTimeMode(c) == fmi3OK && fmi3SetFloat64(c, &v, 1, &value, 1) == fmi3OK);
    CHECK(fmi3GetContinuousStateDerivatives(c, dx, 2) == fmi3OK && dx[0] == 2.0);
    fmi3FreeInstance(c);
    c = cosimulation(true, true, NULL, NULL); /* in event mode */
    CHECK(fmi3SetFloat64(c, &h, 1, &value, 1) == fmi3Error);
    fmi3FreeInstance(c);
}

static void model_exchange_gives_sizes_and_values(void) {
    fmi3Instance c = fmi3InstantiateModelExchange("ball", model.token, NULL, false, true, NULL, keep_message);
    size_t n_x = 0, n_z = 0;
    double x[2], dx[2], z, nominal[2];
    CHECK(c && fmi3GetNumberOfContinuousStates(c, &n_x) == fmi3OK && n_x == 2);
    CHECK(fmi3GetNumberOfEventIndicators(c, &n_z) == fmi3OK && n_z == 1);
    CHECK(get(c, "h") == 1.0); /* start values can be read at once */
    CHECK(fmi3EnterInitializationMode(c, false, 0.0, 0.5, false, 0.0) == fmi3OK);
    CHECK(fmi3ExitInitializationMode(c) == fmi3OK);
    update(c);
    CHECK(fmi3EnterContinuousTimeMode(c) == fmi3OK);
    CHECK(fmi3GetContinuousStates(c, x, 2) == fmi3OK && x[0] == 1.0);
    CHECK(fmi3GetNominalsOfContinuousStates(c, nominal, 2) == fmi3OK && nominal[0] == 1.0);
    CHECK(fmi3SetTime(c, 1.0) == fmi3OK && fmi3SetContinuousStates(c, (double[]){0.5, -2.0}, 2) == fmi3OK);
    CHECK(fmi3GetContinuousStateDerivatives(c, dx, 2) == fmi3OK && dx[0] == -2.0 && dx[1] == -g);
    CHECK(fmi3GetEventIndicators(c, &z, 1) == fmi3OK && z < 0.0);
    CHECK_NEAR(get(c, "energy"), g * 0.5 + 2.0, 1e-14);
    CHECK(fmi3GetFloat64(c, &(fmi3ValueReference){1}, 1, x, 2) == fmi3Error && strstr(last_message, "2 values"));
    CHECK(fmi3EnterStepMode(c) == fmi3Error && fmi3EnterConfigurationMode(c) == fmi3Error);
    fmi3FreeInstance(c);
    CHECK(!fmi3InstantiateScheduledExecution("ball", model.token, NULL, 0, 0, NULL, keep_message, NULL, NULL, NULL));
}

int main(void) {
    the_importer_handles_events();
    without_early_return_the_step_is_finished();
    without_event_mode_it_is_not_entered();
    the_importer_stops_a_step();
    the_model_can_end_the_run_at_its_start();
    what_matters_is_always_said();
    model_exchange_gives_sizes_and_values();
    states_are_set_by_reference();
    return 0;
}

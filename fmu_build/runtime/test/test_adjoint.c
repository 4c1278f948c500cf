/* FMI 3, for any model: adjoint and directional derivatives are transposes of each other, and the latter agree with
   central differences of what the FMU returns. */
#include <string.h>

#include "check.h"
#include "fmi3Functions.h"
#include "model.h"

enum { MOST = 16 };

static double random_number(void) {
    static uint64_t state = 20240521u; /* Knuth's MMIX generator */
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0 * 2.0 - 1.0;
}

typedef struct {
    fmi3ValueReference list[MOST];
    size_t n;
} References;

static void add(References *r, size_t k) {
    if (r->n < MOST) r->list[r->n++] = (fmi3ValueReference)k;
}

static References unknowns, knowns;

static void collect(void) {
    for (size_t k = 0; k < model.n_variables; k++) {
        const ModelVariable *v = &model.variables[k];
        if (v->type != TYPE_REAL) continue;
        if (v->vector == VECTOR_DX || v->vector == VECTOR_W || (v->vector == VECTOR_X && v->causality == OUTPUT))
            add(&unknowns, k);
        if (v->vector == VECTOR_X || v->vector == VECTOR_U || v->vector == VECTOR_P) add(&knowns, k);
    }
}

static double point[MOST]; /* values of the knowns */

static void move_to(fmi3Instance c, size_t known, double value) {
    const ModelVariable *v = &model.variables[knowns.list[known]];
    double x[MOST];
    if (v->vector != VECTOR_X) {
        CHECK(fmi3SetFloat64(c, &knowns.list[known], 1, &value, 1) == fmi3OK);
        return;
    }
    CHECK(fmi3EnterContinuousTimeMode(c) == fmi3OK && fmi3GetContinuousStates(c, x, model.n_x) == fmi3OK);
    x[v->index] = value;
    CHECK(fmi3SetContinuousStates(c, x, model.n_x) == fmi3OK && fmi3EnterEventMode(c) == fmi3OK);
}

static void values_at(fmi3Instance c, size_t known, double value, double *values) {
    move_to(c, known, value);
    CHECK(fmi3GetFloat64(c, unknowns.list, unknowns.n, values, unknowns.n) == fmi3OK);
    move_to(c, known, point[known]);
}

static void agrees_with_differences(fmi3Instance c) {
    for (size_t j = 0; j < knowns.n; j++) {
        const double one = 1.0, h = 1e-5;
        double exact[MOST], low[MOST], high[MOST];
        if (model.variables[knowns.list[j]].variability == FIXED) continue;
        CHECK(fmi3GetDirectionalDerivative(c, unknowns.list, unknowns.n, &knowns.list[j], 1, &one, 1, exact,
                                           unknowns.n) == fmi3OK);
        values_at(c, j, point[j] - h, low);
        values_at(c, j, point[j] + h, high);
        for (size_t i = 0; i < unknowns.n; i++)
            CHECK_NEAR(exact[i], (high[i] - low[i]) / (2.0 * h), 1e-8 * (1.0 + fabs(exact[i])));
    }
}

static void is_the_transpose(fmi3Instance c) {
    double seed[MOST], weight[MOST], change[MOST], sensitivity[MOST], forward = 0.0, reverse = 0.0;
    for (size_t j = 0; j < knowns.n; j++) seed[j] = random_number();
    for (size_t i = 0; i < unknowns.n; i++) weight[i] = random_number();
    CHECK(fmi3GetDirectionalDerivative(c, unknowns.list, unknowns.n, knowns.list, knowns.n, seed, knowns.n, change,
                                       unknowns.n) == fmi3OK);
    CHECK(fmi3GetAdjointDerivative(c, unknowns.list, unknowns.n, knowns.list, knowns.n, weight, unknowns.n, sensitivity,
                                   knowns.n) == fmi3OK);
    for (size_t i = 0; i < unknowns.n; i++) forward += weight[i] * change[i];
    for (size_t j = 0; j < knowns.n; j++) reverse += sensitivity[j] * seed[j];
    CHECK(forward != 0.0);
    CHECK_NEAR(reverse, forward, 1e-13 * (1.0 + fabs(forward)));
}

int main(void) {
    fmi3Instance c = fmi3InstantiateModelExchange("test", model.token, NULL, false, false, NULL, NULL);
    bool flags[5];
    double next;
    collect();
    CHECK(c && fmi3EnterInitializationMode(c, false, 0.0, 0.0, false, 0.0) == fmi3OK);
    CHECK(fmi3ExitInitializationMode(c) == fmi3OK);
    CHECK(fmi3UpdateDiscreteStates(c, flags, flags + 1, flags + 2, flags + 3, flags + 4, &next) == fmi3OK);
    CHECK(fmi3GetFloat64(c, knowns.list, knowns.n, point, knowns.n) == fmi3OK);
    for (size_t j = 0; j < knowns.n; j++) {
        if (model.variables[knowns.list[j]].variability == FIXED) continue;
        point[j] += 0.3 * (random_number() + 1.5);
        move_to(c, j, point[j]);
    }
    agrees_with_differences(c);
    for (int n = 0; n < 100; n++) is_the_transpose(c);
    fmi3FreeInstance(c);
    return 0;
}

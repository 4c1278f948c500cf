/* Newton's iteration by itself: how close is close enough where one unknown is large and another is next to nothing. */
#include "importer.h"
#include "newton.h"

static double unknowns[2];
static const double LARGE = 1e6, REST = 3e-11; /* below the rounding of LARGE, which is 1e-10 */

/* q1 = LARGE, and (q2 + LARGE) - LARGE = REST, which no q2 meets: the sum moves in steps of its rounding. */
static Status never_quite(Instance *s, double *residual, double *jacobian) {
    (void)s;
    const volatile double sum = unknowns[1] + LARGE;
    residual[0] = unknowns[0] - LARGE;
    residual[1] = (sum - LARGE) - REST;
    if (jacobian) jacobian[0] = jacobian[3] = 1.0, jacobian[1] = jacobian[2] = 0.0;
    return STATUS_OK;
}

static void what_is_below_the_largest_unknown_s_rounding_is_solved(void) {
    fmi2Component c = instantiate(fmi2ModelExchange); /* its work space has room for two unknowns */
    CHECK(model.n_q >= 2);
    unknowns[0] = 2e6, unknowns[1] = 0.0;
    CHECK(newton_solve((Instance *)c, never_quite, unknowns, 2) == STATUS_OK);
    CHECK(unknowns[0] == LARGE);
    CHECK_NEAR(unknowns[1], 0.0, 1e-9);
    fmi2FreeInstance(c);
}

/* q1^2 = -1 - q2^2 has no solution; what was there stays. */
static Status nowhere(Instance *s, double *residual, double *jacobian) {
    (void)s;
    residual[0] = unknowns[0] * unknowns[0] + unknowns[1] * unknowns[1] + 1.0;
    residual[1] = unknowns[1];
    if (jacobian) jacobian[0] = 2.0 * unknowns[0], jacobian[1] = 0.0, jacobian[2] = 2.0 * unknowns[1], jacobian[3] = 1.0;
    return STATUS_OK;
}

static void no_solution_leaves_the_unknowns_as_they_were(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    unknowns[0] = 3.0, unknowns[1] = 2.0;
    CHECK(newton_solve((Instance *)c, nowhere, unknowns, 2) == STATUS_DISCARD);
    CHECK(unknowns[0] == 3.0 && unknowns[1] == 2.0);
    fmi2FreeInstance(c);
}

int main(void) {
    what_is_below_the_largest_unknown_s_rounding_is_solved();
    no_solution_leaves_the_unknowns_as_they_were();
    return 0;
}

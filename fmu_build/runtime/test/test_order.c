/* The integrator's order with fixed steps: 5 at the end of a step, 4 for the dense output inside. */
#include "check.h"
#include "instance.h"
#include "rodas.h"

/* Largest error over [0, 2] with n steps: at their ends, and within them. */
static void errors(int n, double *at_ends, double *inside) {
    Instance *s = instance_new(&model, CO_SIMULATION);
    double estimate;
    CHECK(s);
    *at_ends = *inside = 0.0;
    for (int k = 0; k < n; k++) {
        CHECK(rodas_begin(s) == STATUS_OK && rodas_try(s, 2.0 * (k + 1) / n, &estimate) == STATUS_OK);
        for (int i = 1; i < 8; i++) {
            rodas_move(s, i / 8.0);
            *inside = fmax(*inside, fabs(s->x[0] - sin(*s->t)) + fabs(s->x[1] - exp(sin(*s->t))));
        }
        rodas_move(s, 1.0);
        *at_ends = fmax(*at_ends, fabs(s->x[0] - sin(*s->t)) + fabs(s->x[1] - exp(sin(*s->t))));
    }
    instance_free(s);
}

static void has_the_order_it_claims(void) {
    double ends[3], inside[3];
    for (int k = 0; k < 3; k++) errors(20 << k, ends + k, inside + k);
    for (int k = 0; k < 2; k++) {
        const double order = log2(ends[k] / ends[k + 1]), dense = log2(inside[k] / inside[k + 1]);
        printf("order %.2f at the ends, %.2f inside\n", order, dense);
        CHECK(order > (double)RODAS_ORDER - 0.4 && dense > (double)RODAS_ORDER - 1.4);
    }
}

int main(void) {
    has_the_order_it_claims();
    return 0;
}

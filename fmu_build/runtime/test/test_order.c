/* The integrator's order with fixed steps: 5 at the end of a step, 4 for the dense output inside; and the linear solver
   it stands on. */
#include <string.h>

#include "check.h"
#include "instance.h"
#include "linear.h"
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

/* A 5 x 5 matrix that needs its rows exchanged at nearly every pivot; A x and A' x are undone exactly enough. */
static void solves_linear_systems(void) {
    enum { N = 5 };
    double a[N * N], lu[N * N], b[N], c[N];
    int pivot[N];
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) a[j * N + i] = sin(1.0 + 7.0 * i + 3.0 * i * j) + (i == (j + 2) % N ? 4.0 : 0.0);
    for (int i = 0; i < N; i++) {
        b[i] = c[i] = 0.0;
        for (int j = 0; j < N; j++) b[i] += a[j * N + i] * (j - 1.5), c[i] += a[i * N + j] * (j - 1.5);
    }
    memcpy(lu, a, sizeof a);
    CHECK(lu_factor(N, lu, pivot));
    lu_solve(N, lu, pivot, b);
    lu_solve_transposed(N, lu, pivot, c);
    for (int i = 0; i < N; i++) {
        CHECK_NEAR(b[i], i - 1.5, 1e-13);
        CHECK_NEAR(c[i], i - 1.5, 1e-13);
    }
    memset(lu, 0, sizeof lu);
    CHECK(!lu_factor(N, lu, pivot));
}

int main(void) {
    has_the_order_it_claims();
    solves_linear_systems();
    return 0;
}

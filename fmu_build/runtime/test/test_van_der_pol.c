/* A stiff system: the reference solution of the test set for IVP solvers (F. Mazzia, C. Magherini, problem VDPOL), and
   how much work it takes. */
#include "importer.h"
#include "van_der_pol.h"

static void run(double tolerance, double step, double allowed, int most_jacobians) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    derivative_calls = jacobian_calls = 0;
    initialise_from(c, 0.0, tolerance);
    run_steps(c, 0.0, 2.0, step);
    printf("tolerance %.0e, step %g s: %d Jacobians, %d derivatives, y off by %.2e\n", tolerance, step, jacobian_calls,
           derivative_calls, get(c, "y") - 0.1706167732170483e1);
    CHECK_NEAR(get(c, "y"), 0.1706167732170483e1, allowed);
    CHECK_NEAR(get(c, "v"), -0.8928097010247975, allowed);
    CHECK(jacobian_calls < most_jacobians);
    fmi2FreeInstance(c);
}

/* A stiff importer asks state by state; the model is asked once per point. */
static void one_jacobian_serves_every_column(void) {
    const double x[] = {0.5, 3.0};
    fmi2Component c = instantiate(fmi2ModelExchange);
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    CHECK(fmi2SetContinuousStates(c, x, 2) == fmi2OK);
    const fmi2ValueReference states[] = {reference("y"), reference("v")};
    const fmi2ValueReference rates[] = {reference("der(y)"), reference("der(v)")};
    const double expected[2][2] = {{0.0, (-2.0 * 0.5 * 3.0 - 1.0) / 1e-6}, {1.0, (1.0 - 0.25) / 1e-6}}, seed = 1.0;
    jacobian_calls = 0;
    for (int k = 0; k < 2; k++) {
        double change[2];
        CHECK(fmi2GetDirectionalDerivative(c, rates, 2, states + k, 1, &seed, change) == fmi2OK);
        CHECK(change[0] == expected[k][0] && change[1] == expected[k][1]);
    }
    CHECK(jacobian_calls == 1);
    fmi2FreeInstance(c);
}

int main(void) {
    one_jacobian_serves_every_column();
    run(1e-4, 2.0, 1e-3, 400);
    run(1e-6, 2.0, 1e-5, 700);
    run(1e-8, 2.0, 1e-7, 2100);
    run(1e-6, 1e-3, 1e-5, 3000);
    return 0;
}

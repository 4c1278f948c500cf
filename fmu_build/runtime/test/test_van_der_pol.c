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

int main(void) {
    run(1e-4, 2.0, 1e-3, 400);
    run(1e-6, 2.0, 1e-5, 700);
    run(1e-8, 2.0, 1e-7, 2100);
    run(1e-6, 1e-3, 1e-5, 3000);
    return 0;
}

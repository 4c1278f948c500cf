/* Co-simulation of the oscillator: accuracy follows the tolerance, not the communication step. */
#include "importer.h"

static double error_at_end(double tolerance, double step) {
    fmi2Component c = instantiate(fmi2CoSimulation);
    CHECK(set(c, "k", 100.0) == fmi2OK);
    initialise_from(c, 0.0, tolerance);
    run_steps(c, 0.0, 2.0, step);
    const double error = fabs(get(c, "x") - cos(20.0)) + 0.1 * fabs(get(c, "v") + 10.0 * sin(20.0));
    CHECK(get(c, "time") == 2.0);
    fmi2FreeInstance(c);
    return error;
}

static void error_follows_the_tolerance(void) {
    const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10}, steps[] = {1.0, 0.1, 0.01};
    for (size_t i = 0; i < COUNT(tolerances); i++)
        for (size_t j = 0; j < COUNT(steps); j++) {
            const double error = error_at_end(tolerances[i], steps[j]);
            printf("tolerance %.0e, step %.2f s: error %.2e\n", tolerances[i], steps[j], error);
            CHECK(error < 30.0 * tolerances[i]); /* some 20 radians of phase add up */
        }
}

int main(void) {
    error_follows_the_tolerance();
    return 0;
}

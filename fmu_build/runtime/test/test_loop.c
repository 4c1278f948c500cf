/* Non-linear blocks and initial equations, against bisection; partial derivatives through them, against the implicit
   function theorem written out by hand. */
#include "importer.h"

static double bisect(double (*function)(double, double), double value) {
    double low = -100.0, high = 100.0;
    for (int n = 0; n < 200; n++) {
        const double middle = 0.5 * (low + high);
        *(function(middle, value) < 0.0 ? &low : &high) = middle;
    }
    return low;
}

static double cubic(double a, double value) { return a + a * a * a - value; }
static double lambert(double b, double value) { return b > 0.0 ? b * exp(b) - value : -1.0; }

static void starts_at_rest(void) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    CHECK(fmi2EnterInitializationMode(c) == fmi2OK);
    CHECK(set(c, "u", 3.0) == fmi2OK);
    CHECK_NEAR(get(c, "der(x)"), 0.0, 1e-14);
    CHECK_NEAR(get(c, "x"), 3.0 + 27.0 - 1.5, 1e-12);
    CHECK_NEAR(get(c, "b"), bisect(lambert, 9.0), 1e-13);
    CHECK(set(c, "u", -1.0) == fmi2OK);
    CHECK_NEAR(get(c, "x"), -2.0 + 0.5, 1e-13);
    CHECK(set(c, "x", 1.0) == fmi2Error && logged("calculated"));
    CHECK(fmi2ExitInitializationMode(c) == fmi2OK);
    fmi2FreeInstance(c);
}

static fmi2Component at(double t, double x, double u) {
    fmi2Component c = instantiate(fmi2ModelExchange);
    initialise_from(c, 0.0, 0.0);
    handle_event(c);
    CHECK(fmi2SetTime(c, t) == fmi2OK && fmi2SetContinuousStates(c, &x, 1) == fmi2OK && set(c, "u", u) == fmi2OK);
    return c;
}

static void blocks_are_solved(void) {
    for (int n = 0; n < 200; n++) {
        const double t = 0.1 * n, x = 50.0 * sin(n), u = 3.0 * cos(3.0 * n);
        fmi2Component c = at(t, x, u);
        const double a = bisect(cubic, x + 0.5 * u);
        CHECK_NEAR(get(c, "der(x)"), u - a, 1e-12 * (1.0 + fabs(a)));
        if (a * a + t > 1e-3) CHECK_NEAR(get(c, "b"), bisect(lambert, a * a + t), 1e-11);
        fmi2FreeInstance(c);
    }
}

static void partial_derivatives_follow_the_blocks(void) {
    const double t = 1.5, x = 4.0, u = 0.75;
    fmi2Component c = at(t, x, u);
    const double a = bisect(cubic, x + 0.5 * u), b = get(c, "b");
    const double da = 1.0 / (1.0 + 3.0 * a * a), db = 2.0 * a * da / ((1.0 + b) * exp(b));
    const char *names[] = {"x", "u", "s"};
    const double factor[] = {1.0, 0.5, u}, direct[] = {0.0, 1.0, 0.0}; /* of a, and of x' */
    const fmi2ValueReference unknowns[] = {reference("der(x)"), reference("b")};
    for (size_t k = 0; k < COUNT(names); k++) {
        const fmi2ValueReference known = reference(names[k]);
        const double seed = 1.0;
        double change[2];
        CHECK(fmi2GetDirectionalDerivative(c, unknowns, 2, &known, 1, &seed, change) == fmi2OK);
        CHECK_NEAR(change[0], direct[k] - factor[k] * da, 1e-13);
        CHECK_NEAR(change[1], factor[k] * db, 1e-13);
    }
    fmi2FreeInstance(c);
}

/* The derivative by the state alone comes from the Jacobian kept for the point, so it must notice every move. */
static void the_jacobian_follows_the_point(void) {
    const fmi2ValueReference unknown = reference("der(x)"), known = reference("x");
    fmi2Component c = at(1.5, 4.0, 0.75);
    for (int n = 0; n < 20; n++) {
        const double x = 4.0 - 0.5 * n, u = n < 10 ? 0.75 : -1.0, seed = 2.0;
        double change[2];
        CHECK(fmi2SetContinuousStates(c, &x, 1) == fmi2OK && set(c, "u", u) == fmi2OK);
        for (int k = 0; k < 2; k++)
            CHECK(fmi2GetDirectionalDerivative(c, &unknown, 1, &known, 1, &seed, change + k) == fmi2OK);
        const double a = bisect(cubic, x + 0.5 * u);
        CHECK_NEAR(change[0], -2.0 / (1.0 + 3.0 * a * a), 1e-13);
        CHECK(change[0] == change[1]);
    }
    fmi2FreeInstance(c);
}

/* The initial state keeps x' = 0 for a constant input; after a jump, x follows u and the communication step is free. */
static void cosimulation_uses_the_reduced_jacobian(void) {
    double x[3];
    const double steps[] = {2.0, 0.1, 0.01};
    for (int k = 0; k < 3; k++) {
        fmi2Component c = instantiate(fmi2CoSimulation);
        initialise_from(c, 0.0, 1e-9);
        CHECK(set(c, "u", 1.0) == fmi2OK);
        run_steps(c, 0.0, 2.0, steps[k]);
        x[k] = get(c, "x");
        run_steps(c, 2.0, 100.0, 49.0);
        CHECK_NEAR(get(c, "x"), 1.5, 1e-7); /* a = u = 1 */
        fmi2FreeInstance(c);
    }
    CHECK_NEAR(x[0], x[2], 1e-7);
    CHECK_NEAR(x[1], x[2], 1e-7);
}

int main(void) {
    starts_at_rest();
    blocks_are_solved();
    partial_derivatives_follow_the_blocks();
    the_jacobian_follows_the_point();
    cosimulation_uses_the_reduced_jacobian();
    return 0;
}

#include "rodas.h"

#include <math.h>
#include <string.h>

#include "delay.h"
#include "evaluate.h"
#include "linear.h"
#include "linearise.h"

/* Coefficients for the transformed stages U (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II,
   Section IV.7), which save the products with the Jacobian:
   (1/(gamma h) I - J) U_i = f(t + c_i h, x + sum_j a_ij U_j) + sum_j C_ij/h U_j + h d_i df/dt. */
static const double GAMMA = 0.21193756319429014;

static const double A[RODAS_STAGES][RODAS_STAGES] = {
    {0},
    {3.0},
    {2.849394379747939, 0.45842242204463923},
    {-6.954028509809101, 2.489845061869568, -10.358996098473584},
    {2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641},
    {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946},
    {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946, 1.0},
    {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946, 1.0, 1.0}};

static const double C[RODAS_STAGES][RODAS_STAGES] = {
    {0},
    {-14.155112264123755},
    {-17.97296035885952, -2.859693295451294},
    {147.12150275711716, -1.41221402718213, 71.68940251302358},
    {165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306},
    {24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471},
    {30.91273214028599, -3.1208243349937974, 77.79954646070892, 34.28646028294783, -19.097331116725623,
     -28.087943162872662},
    {37.80277123390563, -3.2571969029072276, 112.26918849496327, 66.9347231244047, -40.06618937091002,
     -54.66780262877968, -9.48861652309627}};

static const double NODE[RODAS_STAGES] = {0.0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716,
                                          0.4288403609558664, 1.0, 1.0, 1.0};
static const double TIME_WEIGHT[RODAS_STAGES] = {0.21193756319429014, -0.42387512638858027, -0.3384627126235924,
                                                 1.8046452872882734, 2.325825639765069, 0.0, 0.0, 0.0};

/* Dense output: three polynomials in U. */
static const double H[3][RODAS_STAGES] = {
    {25.948786856663858, -2.5579724845846235, 10.433815404888879, -2.3679251022685204, 0.524948541321073,
     1.1241088310450404, 0.4272876194431874, -0.17202221070155493},
    {-9.91568850695171, -0.9689944594115154, 3.0438037242978453, -24.495224566215796, 20.176138334709044,
     15.98066361424651, -6.789040303419874, -6.710236069923372},
    {11.419903575922262, 2.8879645146136994, 72.92137995996029, 80.12511834622643, -52.072871366152654,
     -59.78993625266729, -0.15582684282751913, 4.883087185713722}};

/* Adds the part of df/dt that comes from delayed values moving through their history. */
static Status add_delay_rates(Instance *s) {
    const Model *m = s->model;
    DerivativeWork *d = &s->derivative;
    if (m->n_v == 0 || !m->forward) return STATUS_OK;
    delay_rates(s, d->seed_v);
    double *res[] = {d->out_dx, NULL, m->n_q > 0 ? d->out_g : NULL};
    const Status status = call_model(s, m->forward, res);
    memset(d->seed_v, 0, m->n_v * sizeof *d->seed_v);
    for (size_t k = 0; k < m->n_x; k++) s->integrator.rate[k] += d->out_dx[k];
    for (size_t k = 0; k < m->n_q; k++) s->integrator.dg_dt[k] += d->out_g[k];
    return status;
}

Status rodas_begin(Instance *s) {
    IntegratorWork *w = &s->integrator;
    w->begin = *s->t;
    w->end = *s->t;
    if (s->model->n_x == 0) return STATUS_OK;
    memcpy(w->x_start, s->x, s->model->n_x * sizeof *s->x);
    Status status = evaluate_derivatives(s);
    if (status == STATUS_OK) status = linearise(s, w->rate, w->dg_dt);
    if (status == STATUS_OK) status = add_delay_rates(s);
    if (status == STATUS_OK) let_blocks_follow(s, w->rate, w->dg_dt);
    return status;
}

/* 1/(gamma h) I - J, factored. */
static bool factor_iteration_matrix(Instance *s, double h) {
    const size_t n = s->model->n_x;
    IntegratorWork *w = &s->integrator;
    for (size_t k = 0; k < n * n; k++) w->iteration[k] = -s->jacobian.xx[k];
    for (size_t k = 0; k < n; k++) w->iteration[k * n + k] += 1.0 / (GAMMA * h);
    return lu_factor(n, w->iteration, w->pivot_x) == n;
}

static void set_point(Instance *s, double time, const double *x) {
    *s->t = time;
    if (s->model->n_x > 0) memcpy(s->x, x, s->model->n_x * sizeof *x);
    changed_point(s);
}

/* sum += factor * U_j */
static void add_stage(const Instance *s, size_t j, double factor, double *sum) {
    const size_t n = s->model->n_x;
    const double *u = s->integrator.stages + j * n;
    if (factor == 0.0) return;
    for (size_t k = 0; k < n; k++) sum[k] += factor * u[k];
}

static Status stage(Instance *s, size_t i, double h) {
    const size_t n = s->model->n_x;
    IntegratorWork *w = &s->integrator;
    double *u = w->stages + i * n;
    memcpy(w->x_stage, w->x_start, n * sizeof *u);
    for (size_t j = 0; j < i; j++) add_stage(s, j, A[i][j], w->x_stage);
    set_point(s, NODE[i] == 1.0 ? w->end : w->begin + NODE[i] * h, w->x_stage);
    if (evaluate_derivatives(s) != STATUS_OK) return STATUS_DISCARD;
    for (size_t k = 0; k < n; k++) u[k] = s->dx[k] + h * TIME_WEIGHT[i] * w->rate[k];
    for (size_t j = 0; j < i; j++) add_stage(s, j, C[i][j] / h, u);
    lu_solve(n, w->iteration, w->pivot_x, u);
    return STATUS_OK;
}

/* The last stage is the difference to the embedded solution of order 4. */
static double scaled_error(const Instance *s, size_t k) {
    const size_t n = s->model->n_x;
    const IntegratorWork *w = &s->integrator;
    const double size = fmax(fabs(w->x_start[k]), fabs(w->x_end[k]));
    return w->stages[(RODAS_STAGES - 1) * n + k] / (s->memory->tolerance * (s->model->nominal_x[k] + size));
}

static double error_norm(const Instance *s) {
    const size_t n = s->model->n_x;
    double sum = 0.0;
    for (size_t k = 0; k < n; k++) {
        const double ratio = scaled_error(s, k);
        sum += ratio * ratio;
    }
    return sqrt(sum / (double)n);
}

size_t rodas_worst(const Instance *s) {
    size_t worst = 0;
    for (size_t k = 1; k < s->model->n_x; k++)
        if (fabs(scaled_error(s, k)) > fabs(scaled_error(s, worst))) worst = k;
    return worst;
}

Status rodas_try(Instance *s, double end, double *error) {
    const size_t n = s->model->n_x;
    IntegratorWork *w = &s->integrator;
    const double h = end - w->begin;
    w->end = end;
    *error = 0.0;
    if (n == 0) {
        set_point(s, end, s->x);
        return STATUS_OK;
    }
    if (!factor_iteration_matrix(s, h)) return STATUS_DISCARD;
    for (size_t i = 0; i < RODAS_STAGES; i++)
        if (stage(s, i, h) != STATUS_OK) return STATUS_DISCARD;
    memcpy(w->x_end, w->x_stage, n * sizeof *w->x_end);
    add_stage(s, RODAS_STAGES - 1, 1.0, w->x_end);
    set_point(s, end, w->x_end);
    *error = error_norm(s);
    return isfinite(*error) ? STATUS_OK : STATUS_DISCARD;
}

void rodas_move(Instance *s, double part) {
    const size_t n = s->model->n_x;
    IntegratorWork *w = &s->integrator;
    const double rest = 1.0 - part;
    const double time = part < 1.0 ? w->begin + part * (w->end - w->begin) : w->end;
    for (size_t k = 0; k < n; k++) w->x_stage[k] = rest * w->x_start[k] + part * w->x_end[k];
    for (size_t j = 0; j < RODAS_STAGES; j++)
        add_stage(s, j, part * rest * (H[0][j] + part * (H[1][j] + part * H[2][j])), w->x_stage);
    set_point(s, time, w->x_stage);
}

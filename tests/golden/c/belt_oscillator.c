/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "belt_oscillator.h"

#include <math.h>

typedef belt_oscillator_real real;

/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)t;
    (void)u;
    const real x_p = x[belt_oscillator_X_p];
    const real x_w = x[belt_oscillator_X_w];
    const real x_Fc_a = x[belt_oscillator_X_Fc_a];
    const real p_M = p[belt_oscillator_P_M];
    const real p_k1 = p[belt_oscillator_P_k1];
    const real p_k2 = p[belt_oscillator_P_k2];
    const real p_F = p[belt_oscillator_P_F];
    const real p_V = p[belt_oscillator_P_V];
    const real p_u = p[belt_oscillator_P_u];
    const real p_Fc_K = p[belt_oscillator_P_Fc_K];
    const real p_Fc_beta = p[belt_oscillator_P_Fc_beta];
    const real b_Fc_z = x_Fc_a + p_Fc_beta*x_w;
    const real b_Fc_Z = p_F/(p_V + fabs(x_w))*(1/p_Fc_K);
    const real b_Fc_s = sat(b_Fc_Z, b_Fc_z);
    const real b_Fc = p_Fc_K*b_Fc_s;
    dx[belt_oscillator_X_p] = p_u - x_w;
    dx[belt_oscillator_X_w] = (p_k2*(x_p*x_p*x_p) - p_k1*x_p - b_Fc)*(1/p_M);
    dx[belt_oscillator_X_Fc_a] = (b_Fc_s - x_Fc_a)*(1/p_Fc_beta);
    return belt_oscillator_OK;
}

#ifdef belt_oscillator_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real x_w = x[belt_oscillator_X_w];
    const real p_F = p[belt_oscillator_P_F];
    const real p_V = p[belt_oscillator_P_V];
    const real p_Fc_K = p[belt_oscillator_P_Fc_K];
    const real p_Fc_beta = p[belt_oscillator_P_Fc_beta];
    if (!(p_F/(p_V + fabs(x_w)) >= 0)) {
        return belt_oscillator_BROKEN + 0;
    }
    if (!(p_F >= 0)) {
        return belt_oscillator_BROKEN + 1;
    }
    if (!(p_V > 0)) {
        return belt_oscillator_BROKEN + 2;
    }
    if (!(p_Fc_K > 0)) {
        return belt_oscillator_BROKEN + 3;
    }
    if (!(p_Fc_beta > 0)) {
        return belt_oscillator_BROKEN + 4;
    }
    return belt_oscillator_OK;
}
#endif

static const int jac_rows[] = {
    1, 0, 1, 2, 1, 2
};

static const int jac_columns[] = {
    0, 1, 4, 6
};

int belt_oscillator_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef belt_oscillator_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int belt_oscillator_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_w = x[belt_oscillator_X_w];
    const real x_Fc_a = x[belt_oscillator_X_Fc_a];
    const real p_F = p[belt_oscillator_P_F];
    const real p_V = p[belt_oscillator_P_V];
    const real p_Fc_K = p[belt_oscillator_P_Fc_K];
    const real p_Fc_beta = p[belt_oscillator_P_Fc_beta];
    const real b_Fc_z = x_Fc_a + p_Fc_beta*x_w;
    const real b_Fc_Z = p_F/(p_V + fabs(x_w))*(1/p_Fc_K);
    const real b_Fc_s = sat(b_Fc_Z, b_Fc_z);
    const real b_Fc = p_Fc_K*b_Fc_s;
    y[belt_oscillator_Y_Fc] = b_Fc;
    return belt_oscillator_OK;
}

int belt_oscillator_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_p = x[belt_oscillator_X_p];
    const real x_w = x[belt_oscillator_X_w];
    const real x_Fc_a = x[belt_oscillator_X_Fc_a];
    const real p_M = p[belt_oscillator_P_M];
    const real p_k1 = p[belt_oscillator_P_k1];
    const real p_k2 = p[belt_oscillator_P_k2];
    const real p_F = p[belt_oscillator_P_F];
    const real p_V = p[belt_oscillator_P_V];
    const real p_Fc_K = p[belt_oscillator_P_Fc_K];
    const real p_Fc_beta = p[belt_oscillator_P_Fc_beta];
    const real b_shared_1 = 1/p_M;
    const real b_shared_2 = 1/p_Fc_beta;
    const real b_Fc_z = x_Fc_a + p_Fc_beta*x_w;
    const real b_Fc_Z = p_F/(p_V + fabs(x_w))*(1/p_Fc_K);
    const real b_Fc_Z_part1 = p_V + fabs(x_w);
    const real b_Fc_Z_part1_d_w = (x_w > 0 ? (real)1 : 0) + (x_w < 0 ? (real)-1 : 0);
    const real b_Fc_Z_d_w = 1/p_Fc_K*(-p_F/b_Fc_Z_part1/b_Fc_Z_part1)*b_Fc_Z_part1_d_w;
    const real b_Fc_s_d_Fc_a = fabs(b_Fc_z) < b_Fc_Z ? (real)1 : 0;
    const real b_Fc_s_d_w = (fabs(b_Fc_z) < b_Fc_Z ? p_Fc_beta : 0) + (b_Fc_z >= b_Fc_Z && b_Fc_z >
        0 ? b_Fc_Z_d_w : 0) + (-b_Fc_z >= b_Fc_Z && b_Fc_z < 0 ? -b_Fc_Z_d_w : 0);
    J[1] = -1;
    J[0] = b_shared_1*p_k2*(3*(x_p*x_p)) + (-b_shared_1*p_k1);
    J[4] = -b_shared_1*(p_Fc_K*b_Fc_s_d_Fc_a);
    J[2] = -b_shared_1*(p_Fc_K*b_Fc_s_d_w);
    J[5] = b_shared_2*b_Fc_s_d_Fc_a - b_shared_2;
    J[3] = b_shared_2*b_Fc_s_d_w;
    return belt_oscillator_OK;
}

int belt_oscillator_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < belt_oscillator_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= belt_oscillator_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return belt_oscillator_OK;
}

int belt_oscillator_init(const real *p, real *x)
{
    (void)p;
    x[belt_oscillator_X_p] = (real)1.19149;
    x[belt_oscillator_X_w] = 0;
    x[belt_oscillator_X_Fc_a] = 0;
    return belt_oscillator_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return belt_oscillator_NOT_FINITE;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return belt_oscillator_OK;
}

int belt_oscillator_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef belt_oscillator_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[3], k2[3], k3[3], k4[3], next[3];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int belt_oscillator_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef belt_oscillator_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[3], k2[3], next[3];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int belt_oscillator_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef belt_oscillator_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[3], next[3];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_oscillator_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const belt_oscillator_real belt_oscillator_p0[] = {
    1, 1, 1, (real)0.2, 1, 1, 100000, (real)0.5
};

const char belt_oscillator_x_names[] =
    "p\0w\0Fc.a\0";

const char belt_oscillator_u_names[] =
    "";

const char belt_oscillator_p_names[] =
    "M\0k1\0k2\0F\0V\0u\0Fc.K\0Fc.beta\0";

const char belt_oscillator_y_names[] =
    "Fc\0";

/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "dry_friction.h"

#include <math.h>

typedef dry_friction_real real;

static inline real smaller(real a, real b)
{
    return a < b ? a : b <= a ? b : a + b;
}

/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)u;
    const real x_v = x[dry_friction_X_v];
    const real x_F_a = x[dry_friction_X_F_a];
    const real p_M = p[dry_friction_P_M];
    const real p_F0 = p[dry_friction_P_F0];
    const real p_ramp = p[dry_friction_P_ramp];
    const real p_top = p[dry_friction_P_top];
    const real p_mean = p[dry_friction_P_mean];
    const real p_swing = p[dry_friction_P_swing];
    const real p_omega = p[dry_friction_P_omega];
    const real p_F_K = p[dry_friction_P_F_K];
    const real p_F_beta = p[dry_friction_P_F_beta];
    const real b_fe = t < 2 ? smaller(p_top, p_ramp*t) : p_mean + p_swing*cos(p_omega*t);
    const real b_F_z = x_F_a + p_F_beta*x_v;
    const real b_F_Z = p_F0/p_F_K;
    const real b_F_s = sat(b_F_Z, b_F_z);
    const real b_F = p_F_K*b_F_s;
    dx[dry_friction_X_p] = x_v;
    dx[dry_friction_X_v] = (b_fe - b_F)*(1/p_M);
    dx[dry_friction_X_F_a] = (b_F_s - x_F_a)*(1/p_F_beta);
    return dry_friction_OK;
}

#ifdef dry_friction_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)x;
    (void)u;
    const real p_F0 = p[dry_friction_P_F0];
    const real p_F_K = p[dry_friction_P_F_K];
    const real p_F_beta = p[dry_friction_P_F_beta];
    if (!(p_F0 >= 0)) {
        return dry_friction_BROKEN + 0;
    }
    if (!(p_F0 >= 0)) {
        return dry_friction_BROKEN + 1;
    }
    if (!(p_F_K > 0)) {
        return dry_friction_BROKEN + 2;
    }
    if (!(p_F_beta > 0)) {
        return dry_friction_BROKEN + 3;
    }
    return dry_friction_OK;
}
#endif

static const int jac_rows[] = {
    0, 1, 2, 1, 2
};

static const int jac_columns[] = {
    0, 0, 3, 5
};

int dry_friction_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef dry_friction_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int dry_friction_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_v = x[dry_friction_X_v];
    const real x_F_a = x[dry_friction_X_F_a];
    const real p_F0 = p[dry_friction_P_F0];
    const real p_F_K = p[dry_friction_P_F_K];
    const real p_F_beta = p[dry_friction_P_F_beta];
    const real b_F_z = x_F_a + p_F_beta*x_v;
    const real b_F_Z = p_F0/p_F_K;
    const real b_F_s = sat(b_F_Z, b_F_z);
    const real b_F = p_F_K*b_F_s;
    y[dry_friction_Y_F] = b_F;
    return dry_friction_OK;
}

int dry_friction_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_v = x[dry_friction_X_v];
    const real x_F_a = x[dry_friction_X_F_a];
    const real p_M = p[dry_friction_P_M];
    const real p_F0 = p[dry_friction_P_F0];
    const real p_F_K = p[dry_friction_P_F_K];
    const real p_F_beta = p[dry_friction_P_F_beta];
    const real b_shared_1 = 1/p_M;
    const real b_shared_2 = 1/p_F_beta;
    const real b_F_z = x_F_a + p_F_beta*x_v;
    const real b_F_Z = p_F0/p_F_K;
    const real b_F_s_d_F_a = fabs(b_F_z) < b_F_Z ? (real)1 : 0;
    const real b_F_s_d_v = fabs(b_F_z) < b_F_Z ? p_F_beta : 0;
    J[0] = 1;
    J[3] = -b_shared_1*(p_F_K*b_F_s_d_F_a);
    J[1] = -b_shared_1*(p_F_K*b_F_s_d_v);
    J[4] = b_shared_2*b_F_s_d_F_a - b_shared_2;
    J[2] = b_shared_2*b_F_s_d_v;
    return dry_friction_OK;
}

int dry_friction_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < dry_friction_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= dry_friction_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return dry_friction_OK;
}

int dry_friction_init(const real *p, real *x)
{
    (void)p;
    x[dry_friction_X_p] = 0;
    x[dry_friction_X_v] = 0;
    x[dry_friction_X_F_a] = 0;
    return dry_friction_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < dry_friction_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return dry_friction_NOT_FINITE;
    }
    for (int i = 0; i < dry_friction_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return dry_friction_OK;
}

int dry_friction_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef dry_friction_CHECKS
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
    for (int i = 0; i < dry_friction_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < dry_friction_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < dry_friction_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < dry_friction_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int dry_friction_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef dry_friction_CHECKS
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
    for (int i = 0; i < dry_friction_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < dry_friction_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int dry_friction_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef dry_friction_CHECKS
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
    for (int i = 0; i < dry_friction_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const dry_friction_real dry_friction_p0[] = {
    1, (real)0.5, (real)0.8, (real)0.52, (real)0.336, (real)0.144, 100, 5000, (real)0.002
};

const char dry_friction_x_names[] =
    "p\0v\0F.a\0";

const char dry_friction_u_names[] =
    "";

const char dry_friction_p_names[] =
    "M\0F0\0ramp\0top\0mean\0swing\0omega\0F.K\0F.beta\0";

const char dry_friction_y_names[] =
    "F\0";

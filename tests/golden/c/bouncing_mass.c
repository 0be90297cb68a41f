/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "bouncing_mass.h"

#include <math.h>

typedef bouncing_mass_real real;

static inline real max0(real y)
{
    return y <= 0 ? 0 : y;
}

static inline real larger(real a, real b)
{
    return a > b ? a : b >= a ? b : a + b;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)t;
    (void)u;
    const real x_p = x[bouncing_mass_X_p];
    const real x_v = x[bouncing_mass_X_v];
    const real x_f_e = x[bouncing_mass_X_f_e];
    const real p_M = p[bouncing_mass_P_M];
    const real p_fe = p[bouncing_mass_P_fe];
    const real p_f_K = p[bouncing_mass_P_f_K];
    const real p_f_alpha = p[bouncing_mass_P_f_alpha];
    const real p_f_beta = p[bouncing_mass_P_f_beta];
    const real b_f_psi = x_p;
    const real b_f = p_f_K*max0(x_f_e - p_f_beta*(b_f_psi + x_f_e)*(1/p_f_alpha));
    dx[bouncing_mass_X_p] = x_v;
    dx[bouncing_mass_X_v] = (p_fe + b_f)*(1/p_M);
    dx[bouncing_mass_X_f_e] = larger(-x_f_e*(1/p_f_beta), -(b_f_psi + x_f_e)*(1/p_f_alpha));
    return bouncing_mass_OK;
}

#ifdef bouncing_mass_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)x;
    (void)u;
    const real p_f_K = p[bouncing_mass_P_f_K];
    const real p_f_alpha = p[bouncing_mass_P_f_alpha];
    const real p_f_beta = p[bouncing_mass_P_f_beta];
    if (!(p_f_K > 0)) {
        return bouncing_mass_BROKEN + 0;
    }
    if (!(p_f_alpha > 0)) {
        return bouncing_mass_BROKEN + 1;
    }
    if (!(p_f_alpha <= p_f_beta)) {
        return bouncing_mass_BROKEN + 2;
    }
    if (!(p_f_beta > 0)) {
        return bouncing_mass_BROKEN + 3;
    }
    return bouncing_mass_OK;
}
#endif

static const int jac_rows[] = {
    1, 2, 0, 1, 2
};

static const int jac_columns[] = {
    0, 2, 3, 5
};

int bouncing_mass_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef bouncing_mass_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int bouncing_mass_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_p = x[bouncing_mass_X_p];
    const real x_f_e = x[bouncing_mass_X_f_e];
    const real p_f_K = p[bouncing_mass_P_f_K];
    const real p_f_alpha = p[bouncing_mass_P_f_alpha];
    const real p_f_beta = p[bouncing_mass_P_f_beta];
    const real b_f_psi = x_p;
    const real b_f = p_f_K*max0(x_f_e - p_f_beta*(b_f_psi + x_f_e)*(1/p_f_alpha));
    y[bouncing_mass_Y_f] = b_f;
    return bouncing_mass_OK;
}

int bouncing_mass_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_p = x[bouncing_mass_X_p];
    const real x_f_e = x[bouncing_mass_X_f_e];
    const real p_M = p[bouncing_mass_P_M];
    const real p_f_K = p[bouncing_mass_P_f_K];
    const real p_f_alpha = p[bouncing_mass_P_f_alpha];
    const real p_f_beta = p[bouncing_mass_P_f_beta];
    const real b_shared_1 = 1/p_f_alpha;
    const real b_shared_2 = -b_shared_1*p_f_beta;
    const real b_shared_3 = 1/p_f_beta;
    const real b_shared_4 = 1/p_M;
    const real b_f_psi = x_p;
    const real b_f_part1 = x_f_e - p_f_beta*(b_f_psi + x_f_e)*b_shared_1;
    const real b_f_part1_d_f_e = 1 + b_shared_2;
    const real b_f_part1_d_p = b_shared_2;
    const real b_f_d_f_e = 0 < b_f_part1 ? p_f_K*b_f_part1_d_f_e : 0;
    const real b_f_d_p = 0 < b_f_part1 ? p_f_K*b_f_part1_d_p : 0;
    const real b_f_e_rate_part2 = -x_f_e*b_shared_3;
    const real b_f_e_rate_part3 = -(b_f_psi + x_f_e)*b_shared_1;
    const real b_shared_5 = b_f_e_rate_part2 < b_f_e_rate_part3 ? -b_shared_1 : 0;
    J[2] = 1;
    J[3] = b_shared_4*b_f_d_f_e;
    J[0] = b_shared_4*b_f_d_p;
    J[4] = (b_f_e_rate_part2 >= b_f_e_rate_part3 ? -b_shared_3 : 0) + b_shared_5;
    J[1] = b_shared_5;
    return bouncing_mass_OK;
}

int bouncing_mass_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < bouncing_mass_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= bouncing_mass_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return bouncing_mass_OK;
}

int bouncing_mass_init(const real *p, real *x)
{
    (void)p;
    x[bouncing_mass_X_p] = 1;
    x[bouncing_mass_X_v] = 0;
    x[bouncing_mass_X_f_e] = 0;
    return bouncing_mass_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return bouncing_mass_NOT_FINITE;
    }
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return bouncing_mass_OK;
}

int bouncing_mass_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef bouncing_mass_CHECKS
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
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int bouncing_mass_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef bouncing_mass_CHECKS
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
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int bouncing_mass_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef bouncing_mass_CHECKS
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
    for (int i = 0; i < bouncing_mass_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const bouncing_mass_real bouncing_mass_p0[] = {
    1, (real)-9.8, 100000, (real)0.005, (real)0.01
};

const char bouncing_mass_x_names[] =
    "p\0v\0f.e\0";

const char bouncing_mass_u_names[] =
    "";

const char bouncing_mass_p_names[] =
    "M\0fe\0f.K\0f.alpha\0f.beta\0";

const char bouncing_mass_y_names[] =
    "f\0";

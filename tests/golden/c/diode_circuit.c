/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "diode_circuit.h"

#include <math.h>

typedef diode_circuit_real real;

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
    (void)u;
    const real x_i = x[diode_circuit_X_i];
    const real x_vc = x[diode_circuit_X_vc];
    const real x_D_e = x[diode_circuit_X_D_e];
    const real p_L = p[diode_circuit_P_L];
    const real p_C = p[diode_circuit_P_C];
    const real p_Rs = p[diode_circuit_P_Rs];
    const real p_R = p[diode_circuit_P_R];
    const real p_U = p[diode_circuit_P_U];
    const real p_omega = p[diode_circuit_P_omega];
    const real p_D_K = p[diode_circuit_P_D_K];
    const real p_D_alpha = p[diode_circuit_P_D_alpha];
    const real p_D_beta = p[diode_circuit_P_D_beta];
    const real b_source = p_U*sin(p_omega*t);
    const real b_D_psi = x_i;
    const real b_D = p_D_K*max0(x_D_e - p_D_beta*(b_D_psi + x_D_e)*(1/p_D_alpha));
    dx[diode_circuit_X_i] = (b_source - x_vc - p_Rs*x_i + b_D)*(1/p_L);
    dx[diode_circuit_X_vc] = (x_i - x_vc*(1/p_R))*(1/p_C);
    dx[diode_circuit_X_D_e] = larger(-x_D_e*(1/p_D_beta), -(b_D_psi + x_D_e)*(1/p_D_alpha));
    return diode_circuit_OK;
}

#ifdef diode_circuit_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)x;
    (void)u;
    const real p_D_K = p[diode_circuit_P_D_K];
    const real p_D_alpha = p[diode_circuit_P_D_alpha];
    const real p_D_beta = p[diode_circuit_P_D_beta];
    if (!(p_D_K > 0)) {
        return diode_circuit_BROKEN + 0;
    }
    if (!(p_D_alpha > 0)) {
        return diode_circuit_BROKEN + 1;
    }
    if (!(p_D_alpha <= p_D_beta)) {
        return diode_circuit_BROKEN + 2;
    }
    if (!(p_D_beta > 0)) {
        return diode_circuit_BROKEN + 3;
    }
    return diode_circuit_OK;
}
#endif

static const int jac_rows[] = {
    0, 1, 2, 0, 1, 0, 2
};

static const int jac_columns[] = {
    0, 3, 5, 7
};

int diode_circuit_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef diode_circuit_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int diode_circuit_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_i = x[diode_circuit_X_i];
    const real x_vc = x[diode_circuit_X_vc];
    const real x_D_e = x[diode_circuit_X_D_e];
    const real p_R = p[diode_circuit_P_R];
    const real p_D_K = p[diode_circuit_P_D_K];
    const real p_D_alpha = p[diode_circuit_P_D_alpha];
    const real p_D_beta = p[diode_circuit_P_D_beta];
    const real b_D_psi = x_i;
    const real b_D = p_D_K*max0(x_D_e - p_D_beta*(b_D_psi + x_D_e)*(1/p_D_alpha));
    y[diode_circuit_Y_load] = x_vc/p_R;
    y[diode_circuit_Y_D] = b_D;
    return diode_circuit_OK;
}

int diode_circuit_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_i = x[diode_circuit_X_i];
    const real x_D_e = x[diode_circuit_X_D_e];
    const real p_L = p[diode_circuit_P_L];
    const real p_C = p[diode_circuit_P_C];
    const real p_Rs = p[diode_circuit_P_Rs];
    const real p_R = p[diode_circuit_P_R];
    const real p_D_K = p[diode_circuit_P_D_K];
    const real p_D_alpha = p[diode_circuit_P_D_alpha];
    const real p_D_beta = p[diode_circuit_P_D_beta];
    const real b_shared_1 = 1/p_D_alpha;
    const real b_shared_2 = -b_shared_1*p_D_beta;
    const real b_shared_3 = 1/p_D_beta;
    const real b_shared_4 = 1/p_L;
    const real b_shared_5 = 1/p_C;
    const real b_D_psi = x_i;
    const real b_D_part1 = x_D_e - p_D_beta*(b_D_psi + x_D_e)*b_shared_1;
    const real b_D_part1_d_D_e = 1 + b_shared_2;
    const real b_D_part1_d_i = b_shared_2;
    const real b_D_d_D_e = 0 < b_D_part1 ? p_D_K*b_D_part1_d_D_e : 0;
    const real b_D_d_i = 0 < b_D_part1 ? p_D_K*b_D_part1_d_i : 0;
    const real b_D_e_rate_part2 = -x_D_e*b_shared_3;
    const real b_D_e_rate_part3 = -(b_D_psi + x_D_e)*b_shared_1;
    const real b_shared_6 = b_D_e_rate_part2 < b_D_e_rate_part3 ? -b_shared_1 : 0;
    J[3] = -b_shared_4;
    J[0] = -b_shared_4*p_Rs + b_shared_4*b_D_d_i;
    J[5] = b_shared_4*b_D_d_D_e;
    J[1] = b_shared_5;
    J[4] = -b_shared_5*(1/p_R);
    J[6] = (b_D_e_rate_part2 >= b_D_e_rate_part3 ? -b_shared_3 : 0) + b_shared_6;
    J[2] = b_shared_6;
    return diode_circuit_OK;
}

int diode_circuit_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < diode_circuit_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= diode_circuit_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return diode_circuit_OK;
}

int diode_circuit_init(const real *p, real *x)
{
    (void)p;
    x[diode_circuit_X_i] = 0;
    x[diode_circuit_X_vc] = 0;
    x[diode_circuit_X_D_e] = 0;
    return diode_circuit_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < diode_circuit_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return diode_circuit_NOT_FINITE;
    }
    for (int i = 0; i < diode_circuit_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return diode_circuit_OK;
}

int diode_circuit_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef diode_circuit_CHECKS
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
    for (int i = 0; i < diode_circuit_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < diode_circuit_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < diode_circuit_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < diode_circuit_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int diode_circuit_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef diode_circuit_CHECKS
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
    for (int i = 0; i < diode_circuit_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < diode_circuit_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int diode_circuit_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef diode_circuit_CHECKS
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
    for (int i = 0; i < diode_circuit_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const diode_circuit_real diode_circuit_p0[] = {
    (real)0.05, (real)0.002, (real)0.5, 40, 20, (real)314.159265, 2000, (real)0.0001,
    (real)0.0002
};

const char diode_circuit_x_names[] =
    "i\0vc\0D.e\0";

const char diode_circuit_u_names[] =
    "";

const char diode_circuit_p_names[] =
    "L\0C\0Rs\0R\0U\0omega\0D.K\0D.alpha\0D.beta\0";

const char diode_circuit_y_names[] =
    "load\0D\0";

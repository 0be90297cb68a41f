/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "granular_column.h"

#include <math.h>

typedef granular_column_real real;

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
    const real *const x_z = x + granular_column_X_z;
    const real *const x_v = x + granular_column_X_v;
    const real *const x_N_e = x + granular_column_X_N_e;
    const real p_m = p[granular_column_P_m];
    const real p_d = p[granular_column_P_d];
    const real p_g = p[granular_column_P_g];
    const real p_N_K = p[granular_column_P_N_K];
    const real p_N_alpha = p[granular_column_P_N_alpha];
    const real p_N_beta = p[granular_column_P_N_beta];
    real b_N[10];
    {
        const real b_N_psi = x_z[0] - p_d/2;
        b_N[0] = p_N_K*max0(x_N_e[0] - p_N_beta*(b_N_psi + x_N_e[0])*(1/p_N_alpha));
        dx[granular_column_X_N_e] = larger(-x_N_e[0]*(1/p_N_beta), -(b_N_psi +
            x_N_e[0])*(1/p_N_alpha));
    }
    for (int i = 2; i <= 10; ++i) {
        const real b_N_psi = x_z[i - 1] - (x_z[i - 2] + p_d);
        b_N[i - 1] = p_N_K*max0(x_N_e[i - 1] - p_N_beta*(b_N_psi + x_N_e[i - 1])*(1/p_N_alpha));
        dx[granular_column_X_N_e + i - 1] = larger(-x_N_e[i - 1]*(1/p_N_beta), -(b_N_psi + x_N_e[i -
            1])*(1/p_N_alpha));
    }
    for (int i = 1; i <= 10; ++i) {
        dx[granular_column_X_z + i - 1] = x_v[i - 1];
    }
    for (int i = 1; i <= 9; ++i) {
        dx[granular_column_X_v + i - 1] = (b_N[i - 1] - b_N[i] - p_m*p_g)*(1/p_m);
    }
    dx[granular_column_X_v + 9] = (b_N[9] - 0 - p_m*p_g)*(1/p_m);
    return granular_column_OK;
}

#ifdef granular_column_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)x;
    (void)u;
    const real p_N_K = p[granular_column_P_N_K];
    const real p_N_alpha = p[granular_column_P_N_alpha];
    const real p_N_beta = p[granular_column_P_N_beta];
    if (!(p_N_K > 0)) {
        return granular_column_BROKEN + 0;
    }
    if (!(p_N_alpha > 0)) {
        return granular_column_BROKEN + 1;
    }
    if (!(p_N_alpha <= p_N_beta)) {
        return granular_column_BROKEN + 2;
    }
    if (!(p_N_beta > 0)) {
        return granular_column_BROKEN + 3;
    }
    return granular_column_OK;
}
#endif

static const int jac_rows[] = {
    10, 11, 20, 21, 10, 11, 12, 21, 22, 11, 12, 13, 22, 23, 12, 13,
    14, 23, 24, 13, 14, 15, 24, 25, 14, 15, 16, 25, 26, 15, 16, 17,
    26, 27, 16, 17, 18, 27, 28, 17, 18, 19, 28, 29, 18, 19, 29, 0,
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 20, 10, 11, 21, 11, 12,
    22, 12, 13, 23, 13, 14, 24, 14, 15, 25, 15, 16, 26, 16, 17, 27,
    17, 18, 28, 18, 19, 29
};

static const int jac_columns[] = {
    0, 4, 9, 14, 19, 24, 29, 34, 39, 44, 47, 48, 49, 50, 51, 52,
    53, 54, 55, 56, 57, 59, 62, 65, 68, 71, 74, 77, 80, 83, 86
};

static const int jac_places[] = {
    47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 60, 63, 66, 69, 72,
    75, 78, 81, 84, 0, 5, 10, 15, 20, 25, 30, 35, 40, 45, -1, 1,
    6, 11, 16, 21, 26, 31, 36, 41, 59, 62, 65, 68, 71, 74, 77, 80,
    83, -1, 4, 9, 14, 19, 24, 29, 34, 39, 44, -1, 58, 61, 64, 67,
    70, 73, 76, 79, 82, 85, 2, 7, 12, 17, 22, 27, 32, 37, 42, 46,
    -1, 3, 8, 13, 18, 23, 28, 33, 38, 43
};

int granular_column_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef granular_column_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int granular_column_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real *const x_z = x + granular_column_X_z;
    const real *const x_v = x + granular_column_X_v;
    const real *const x_N_e = x + granular_column_X_N_e;
    const real p_m = p[granular_column_P_m];
    const real p_d = p[granular_column_P_d];
    const real p_g = p[granular_column_P_g];
    const real p_N_K = p[granular_column_P_N_K];
    const real p_N_alpha = p[granular_column_P_N_alpha];
    const real p_N_beta = p[granular_column_P_N_beta];
    {
        const real b_N_psi = x_z[0] - p_d/2;
        const real b_N = p_N_K*max0(x_N_e[0] - p_N_beta*(b_N_psi + x_N_e[0])*(1/p_N_alpha));
        y[granular_column_Y_N] = b_N;
    }
    for (int i = 2; i <= 10; ++i) {
        const real b_N_psi = x_z[i - 1] - (x_z[i - 2] + p_d);
        const real b_N = p_N_K*max0(x_N_e[i - 1] - p_N_beta*(b_N_psi + x_N_e[i - 1])*(1/p_N_alpha));
        y[granular_column_Y_N + i - 1] = b_N;
    }
    y[granular_column_Y_height] = x_z[9];
    real sum1 = 0;
    for (int i = 1; i <= 10; ++i) {
        sum1 += (real)1/2*p_m*(x_v[i - 1]*x_v[i - 1]) + p_m*p_g*x_z[i - 1];
    }
    y[granular_column_Y_energy] = sum1;
    return granular_column_OK;
}

int granular_column_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    for (int k = 0; k < granular_column_JAC_NNZ; ++k) {
        J[k] = 0;
    }
    const real *const x_z = x + granular_column_X_z;
    const real *const x_N_e = x + granular_column_X_N_e;
    const real p_m = p[granular_column_P_m];
    const real p_d = p[granular_column_P_d];
    const real p_N_K = p[granular_column_P_N_K];
    const real p_N_alpha = p[granular_column_P_N_alpha];
    const real p_N_beta = p[granular_column_P_N_beta];
    real b_N_part1[10];
    real b_N_part1_d_N_e_to0[10];
    real b_N_part1_d_z_to0[10];
    real b_N_d_N_e_to0[10];
    real b_N_d_z_to0[10];
    real b_N_d_z_tom1[10];
    real b_N_e_rate_part2[10];
    real b_N_e_rate_part2_d_N_e_to0[10];
    real b_N_e_rate_part3[10];
    real b_N_e_rate_part3_d_z_to0[10];
    real b_N_e_rate_part3_d_z_tom1[10];
    real b_N_e_rate_part3_d_N_e_to0[10];
    const real b_shared_1 = 1/p_N_alpha;
    const real b_shared_2 = -b_shared_1*p_N_beta;
    const real b_shared_3 = 1/p_N_beta;
    const real b_shared_4 = 1/p_m;
    {
        const real b_N_psi = x_z[0] - p_d/2;
        const real b_N_psi_d_z_tom1 = 0;
        b_N_part1[0] = x_N_e[0] - p_N_beta*(b_N_psi + x_N_e[0])*b_shared_1;
        const real b_N_part1_d_z_tom1 = b_shared_2*b_N_psi_d_z_tom1;
        b_N_d_z_tom1[0] = 0 < b_N_part1[0] ? p_N_K*b_N_part1_d_z_tom1 : 0;
        b_N_e_rate_part3[0] = -(b_N_psi + x_N_e[0])*b_shared_1;
        b_N_e_rate_part3_d_z_tom1[0] = -b_shared_1*b_N_psi_d_z_tom1;
        if (jac_places[30 + 0] >= 0) {
            J[jac_places[30 + 0]] += b_shared_4*b_N_d_z_tom1[0];
        }
    }
    for (int i = 2; i <= 10; ++i) {
        const real b_N_psi = x_z[i - 1] - (x_z[i - 2] + p_d);
        const real b_N_psi_d_z_tom1 = -1;
        b_N_part1[i - 1] = x_N_e[i - 1] - p_N_beta*(b_N_psi + x_N_e[i - 1])*b_shared_1;
        const real b_N_part1_d_z_tom1 = b_shared_2*b_N_psi_d_z_tom1;
        b_N_d_z_tom1[i - 1] = 0 < b_N_part1[i - 1] ? p_N_K*b_N_part1_d_z_tom1 : 0;
        b_N_e_rate_part3[i - 1] = -(b_N_psi + x_N_e[i - 1])*b_shared_1;
        b_N_e_rate_part3_d_z_tom1[i - 1] = -b_shared_1*b_N_psi_d_z_tom1;
        if (jac_places[30 + i - 1] >= 0) {
            J[jac_places[30 + i - 1]] += b_shared_4*b_N_d_z_tom1[i - 1];
        }
    }
    for (int i = 1; i <= 10; ++i) {
        b_N_part1_d_N_e_to0[i - 1] = 1 + b_shared_2;
        b_N_part1_d_z_to0[i - 1] = b_shared_2;
        b_N_e_rate_part2[i - 1] = -x_N_e[i - 1]*b_shared_3;
        b_N_e_rate_part2_d_N_e_to0[i - 1] = -b_shared_3;
        b_N_e_rate_part3_d_z_to0[i - 1] = -b_shared_1;
        b_N_e_rate_part3_d_N_e_to0[i - 1] = -b_shared_1;
        J[jac_places[i - 1]] += 1;
    }
    b_N_d_N_e_to0[0] = 0 < b_N_part1[0] ? p_N_K*b_N_part1_d_N_e_to0[0] : 0;
    b_N_d_z_to0[0] = 0 < b_N_part1[0] ? p_N_K*b_N_part1_d_z_to0[0] : 0;
    J[jac_places[10 + 0]] += b_shared_4*b_N_d_N_e_to0[0];
    J[jac_places[60 + 0]] += (b_N_e_rate_part2[0] >= b_N_e_rate_part3[0] ?
        b_N_e_rate_part2_d_N_e_to0[0] : 0) + (b_N_e_rate_part2[0] < b_N_e_rate_part3[0] ?
        b_N_e_rate_part3_d_N_e_to0[0] : 0);
    J[jac_places[70 + 0]] += b_N_e_rate_part2[0] < b_N_e_rate_part3[0] ? b_N_e_rate_part3_d_z_to0[0]
        : 0;
    if (jac_places[80 + 0] >= 0) {
        J[jac_places[80 + 0]] += b_N_e_rate_part2[0] < b_N_e_rate_part3[0] ?
            b_N_e_rate_part3_d_z_tom1[0] : 0;
    }
    for (int i = 2; i <= 10; ++i) {
        b_N_d_N_e_to0[i - 1] = 0 < b_N_part1[i - 1] ? p_N_K*b_N_part1_d_N_e_to0[i - 1] : 0;
        b_N_d_z_to0[i - 1] = 0 < b_N_part1[i - 1] ? p_N_K*b_N_part1_d_z_to0[i - 1] : 0;
        J[jac_places[10 + i - 1]] += b_shared_4*b_N_d_N_e_to0[i - 1];
        J[jac_places[60 + i - 1]] += (b_N_e_rate_part2[i - 1] >= b_N_e_rate_part3[i - 1] ?
            b_N_e_rate_part2_d_N_e_to0[i - 1] : 0) + (b_N_e_rate_part2[i - 1] < b_N_e_rate_part3[i -
            1] ? b_N_e_rate_part3_d_N_e_to0[i - 1] : 0);
        J[jac_places[70 + i - 1]] += b_N_e_rate_part2[i - 1] < b_N_e_rate_part3[i - 1] ?
            b_N_e_rate_part3_d_z_to0[i - 1] : 0;
        if (jac_places[80 + i - 1] >= 0) {
            J[jac_places[80 + i - 1]] += b_N_e_rate_part2[i - 1] < b_N_e_rate_part3[i - 1] ?
                b_N_e_rate_part3_d_z_tom1[i - 1] : 0;
        }
    }
    for (int i = 1; i <= 9; ++i) {
        J[jac_places[20 + i - 1]] += b_shared_4*b_N_d_z_to0[i - 1] + (-b_shared_4*b_N_d_z_tom1[i]);
        if (jac_places[40 + i - 1] >= 0) {
            J[jac_places[40 + i - 1]] += -b_shared_4*b_N_d_N_e_to0[i];
        }
        if (jac_places[50 + i - 1] >= 0) {
            J[jac_places[50 + i - 1]] += -b_shared_4*b_N_d_z_to0[i];
        }
    }
    J[jac_places[20 + 9]] += b_shared_4*b_N_d_z_to0[9] + 0;
    return granular_column_OK;
}

int granular_column_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < granular_column_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= granular_column_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return granular_column_OK;
}

int granular_column_init(const real *p, real *x)
{
    const real p_d = p[granular_column_P_d];
    for (int i = 1; i <= 10; ++i) {
        x[granular_column_X_z + i - 1] = p_d*((real)1.2*(real)i - (real)0.5);
        x[granular_column_X_v + i - 1] = 0;
        x[granular_column_X_N_e + i - 1] = 0;
    }
    return granular_column_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < granular_column_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return granular_column_NOT_FINITE;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return granular_column_OK;
}

int granular_column_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef granular_column_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[30], k2[30], k3[30], k4[30], next[30];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int granular_column_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef granular_column_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[30], k2[30], next[30];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int granular_column_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef granular_column_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[30], next[30];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < granular_column_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const granular_column_real granular_column_p0[] = {
    (real)0.01, (real)0.02, (real)9.81, 20000, (real)0.0004, (real)0.001
};

const char granular_column_x_names[] =
    "z[1]\0z[2]\0z[3]\0z[4]\0z[5]\0z[6]\0z[7]\0z[8]\0z[9]\0z[10]\0v[1]\0v[2]\0v[3]\0v[4]\0"
    "v[5]\0v[6]\0v[7]\0v[8]\0v[9]\0v[10]\0N[1].e\0N[2].e\0N[3].e\0N[4].e\0N[5].e\0N[6].e\0"
    "N[7].e\0N[8].e\0N[9].e\0N[10].e\0";

const char granular_column_u_names[] =
    "";

const char granular_column_p_names[] =
    "m\0d\0g\0N.K\0N.alpha\0N.beta\0";

const char granular_column_y_names[] =
    "height\0energy\0N[1]\0N[2]\0N[3]\0N[4]\0N[5]\0N[6]\0N[7]\0N[8]\0N[9]\0N[10]\0";

/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "belt_drive.h"

#include <math.h>

typedef belt_drive_real real;

/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}

static inline real square(real a)
{
    return a*a;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)t;
    (void)u;
    const real x_q1 = x[belt_drive_X_q1];
    const real x_q2 = x[belt_drive_X_q2];
    const real x_w1 = x[belt_drive_X_w1];
    const real x_w2 = x[belt_drive_X_w2];
    const real x_T_a = x[belt_drive_X_T_a];
    const real p_J1 = p[belt_drive_P_J1];
    const real p_J2 = p[belt_drive_P_J2];
    const real p_k = p[belt_drive_P_k];
    const real p_c = p[belt_drive_P_c];
    const real p_Ts = p[belt_drive_P_Ts];
    const real p_Tc = p[belt_drive_P_Tc];
    const real p_ws = p[belt_drive_P_ws];
    const real p_kp = p[belt_drive_P_kp];
    const real p_ref = p[belt_drive_P_ref];
    const real p_T_K = p[belt_drive_P_T_K];
    const real p_T_beta = p[belt_drive_P_T_beta];
    const real b_belt = p_k*(x_q1 - x_q2) + p_c*(x_w1 - x_w2);
    const real b_level = p_Tc + (p_Ts - p_Tc)*exp(-square(x_w2*(1/p_ws)));
    const real b_T_z = x_T_a + p_T_beta*x_w2;
    const real b_T_Z = b_level*(1/p_T_K);
    const real b_T_s = sat(b_T_Z, b_T_z);
    const real b_T = p_T_K*b_T_s;
    dx[belt_drive_X_q1] = x_w1;
    dx[belt_drive_X_q2] = x_w2;
    dx[belt_drive_X_w1] = (p_kp*(p_ref - x_w1) - b_belt)*(1/p_J1);
    dx[belt_drive_X_w2] = (b_belt - b_T)*(1/p_J2);
    dx[belt_drive_X_T_a] = (b_T_s - x_T_a)*(1/p_T_beta);
    return belt_drive_OK;
}

#ifdef belt_drive_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real x_w2 = x[belt_drive_X_w2];
    const real p_Ts = p[belt_drive_P_Ts];
    const real p_Tc = p[belt_drive_P_Tc];
    const real p_ws = p[belt_drive_P_ws];
    const real p_T_K = p[belt_drive_P_T_K];
    const real p_T_beta = p[belt_drive_P_T_beta];
    const real b_level = p_Tc + (p_Ts - p_Tc)*exp(-square(x_w2*(1/p_ws)));
    if (!(p_Ts >= p_Tc)) {
        return belt_drive_BROKEN + 0;
    }
    if (!(b_level >= 0)) {
        return belt_drive_BROKEN + 1;
    }
    if (!(p_Tc >= 0)) {
        return belt_drive_BROKEN + 2;
    }
    if (!(p_T_K > 0)) {
        return belt_drive_BROKEN + 3;
    }
    if (!(p_T_beta > 0)) {
        return belt_drive_BROKEN + 4;
    }
    return belt_drive_OK;
}
#endif

static const int jac_rows[] = {
    2, 3, 2, 3, 0, 2, 3, 1, 2, 3, 4, 3, 4
};

static const int jac_columns[] = {
    0, 2, 4, 7, 11, 13
};

int belt_drive_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef belt_drive_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int belt_drive_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_w2 = x[belt_drive_X_w2];
    const real x_T_a = x[belt_drive_X_T_a];
    const real p_Ts = p[belt_drive_P_Ts];
    const real p_Tc = p[belt_drive_P_Tc];
    const real p_ws = p[belt_drive_P_ws];
    const real p_T_K = p[belt_drive_P_T_K];
    const real p_T_beta = p[belt_drive_P_T_beta];
    const real b_level = p_Tc + (p_Ts - p_Tc)*exp(-square(x_w2*(1/p_ws)));
    const real b_T_z = x_T_a + p_T_beta*x_w2;
    const real b_T_Z = b_level*(1/p_T_K);
    const real b_T_s = sat(b_T_Z, b_T_z);
    const real b_T = p_T_K*b_T_s;
    y[belt_drive_Y_T] = b_T;
    return belt_drive_OK;
}

int belt_drive_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_w2 = x[belt_drive_X_w2];
    const real x_T_a = x[belt_drive_X_T_a];
    const real p_J1 = p[belt_drive_P_J1];
    const real p_J2 = p[belt_drive_P_J2];
    const real p_k = p[belt_drive_P_k];
    const real p_c = p[belt_drive_P_c];
    const real p_Ts = p[belt_drive_P_Ts];
    const real p_Tc = p[belt_drive_P_Tc];
    const real p_ws = p[belt_drive_P_ws];
    const real p_kp = p[belt_drive_P_kp];
    const real p_T_K = p[belt_drive_P_T_K];
    const real p_T_beta = p[belt_drive_P_T_beta];
    const real b_shared_1 = 1/p_ws;
    const real b_shared_2 = 1/p_J1;
    const real b_shared_3 = 1/p_J2;
    const real b_shared_4 = 1/p_T_beta;
    const real b_level = p_Tc + (p_Ts - p_Tc)*exp(-square(x_w2*(1/p_ws)));
    const real b_T_z = x_T_a + p_T_beta*x_w2;
    const real b_T_Z = b_level*(1/p_T_K);
    const real b_level_part1 = x_w2*b_shared_1;
    const real b_level_part2 = -b_level_part1*b_level_part1;
    const real b_level_part2_d_w2 = -2*b_level_part1*b_shared_1;
    const real b_level_d_w2 = (p_Ts - p_Tc)*exp(b_level_part2)*b_level_part2_d_w2;
    const real b_T_Z_d_w2 = 1/p_T_K*b_level_d_w2;
    const real b_T_s_d_T_a = fabs(b_T_z) < b_T_Z ? (real)1 : 0;
    const real b_T_s_d_w2 = (fabs(b_T_z) < b_T_Z ? p_T_beta : 0) + (b_T_z >= b_T_Z && b_T_z > 0 ?
        b_T_Z_d_w2 : 0) + (-b_T_z >= b_T_Z && b_T_z < 0 ? -b_T_Z_d_w2 : 0);
    J[4] = 1;
    J[7] = 1;
    J[5] = -b_shared_2*p_kp + (-b_shared_2*p_c);
    J[0] = -b_shared_2*p_k;
    J[2] = -b_shared_2*(-p_k);
    J[8] = -b_shared_2*(-p_c);
    J[1] = b_shared_3*p_k;
    J[3] = b_shared_3*(-p_k);
    J[6] = b_shared_3*p_c;
    J[9] = b_shared_3*(-p_c) + (-b_shared_3*(p_T_K*b_T_s_d_w2));
    J[11] = -b_shared_3*(p_T_K*b_T_s_d_T_a);
    J[12] = b_shared_4*b_T_s_d_T_a - b_shared_4;
    J[10] = b_shared_4*b_T_s_d_w2;
    return belt_drive_OK;
}

int belt_drive_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < belt_drive_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= belt_drive_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return belt_drive_OK;
}

int belt_drive_init(const real *p, real *x)
{
    (void)p;
    x[belt_drive_X_q1] = 0;
    x[belt_drive_X_q2] = 0;
    x[belt_drive_X_w1] = 0;
    x[belt_drive_X_w2] = 0;
    x[belt_drive_X_T_a] = 0;
    return belt_drive_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < belt_drive_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return belt_drive_NOT_FINITE;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return belt_drive_OK;
}

int belt_drive_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef belt_drive_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[5], k2[5], k3[5], k4[5], next[5];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int belt_drive_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef belt_drive_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[5], k2[5], next[5];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int belt_drive_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef belt_drive_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[5], next[5];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < belt_drive_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const belt_drive_real belt_drive_p0[] = {
    (real)0.002, (real)0.008, 4, (real)0.008, (real)0.6, (real)0.3, (real)0.5, 2, (real)0.8,
    2000, (real)0.002
};

const char belt_drive_x_names[] =
    "q1\0q2\0w1\0w2\0T.a\0";

const char belt_drive_u_names[] =
    "";

const char belt_drive_p_names[] =
    "J1\0J2\0k\0c\0Ts\0Tc\0ws\0kp\0ref\0T.K\0T.beta\0";

const char belt_drive_y_names[] =
    "T\0";

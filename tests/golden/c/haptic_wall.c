/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "haptic_wall.h"

#include <math.h>

typedef haptic_wall_real real;

static inline real max0(real y)
{
    return y <= 0 ? 0 : y;
}

static inline real larger(real a, real b)
{
    return a > b ? a : b >= a ? b : a + b;
}

/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)t;
    const real x_p_x = x[haptic_wall_X_p_x];
    const real x_p_y = x[haptic_wall_X_p_y];
    const real x_v_x = x[haptic_wall_X_v_x];
    const real x_v_y = x[haptic_wall_X_v_y];
    const real x_N_e = x[haptic_wall_X_N_e];
    const real x_F_a = x[haptic_wall_X_F_a];
    const real u_hand_x = u[haptic_wall_U_hand_x];
    const real u_hand_y = u[haptic_wall_U_hand_y];
    const real p_m = p[haptic_wall_P_m];
    const real p_b = p[haptic_wall_P_b];
    const real p_k = p[haptic_wall_P_k];
    const real p_c = p[haptic_wall_P_c];
    const real p_mu = p[haptic_wall_P_mu];
    const real p_N_K = p[haptic_wall_P_N_K];
    const real p_N_alpha = p[haptic_wall_P_N_alpha];
    const real p_N_beta = p[haptic_wall_P_N_beta];
    const real p_F_K = p[haptic_wall_P_F_K];
    const real p_F_beta = p[haptic_wall_P_F_beta];
    const real b_N_psi = x_p_x;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z = x_F_a + p_F_beta*x_v_y;
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_F_s = sat(b_F_Z, b_F_z);
    const real b_F = p_F_K*b_F_s;
    const real b_arm_x = p_k*(u_hand_x - x_p_x) - p_c*x_v_x;
    const real b_arm_y = p_k*(u_hand_y - x_p_y) - p_c*x_v_y;
    dx[haptic_wall_X_p_x] = x_v_x;
    dx[haptic_wall_X_p_y] = x_v_y;
    dx[haptic_wall_X_v_x] = (b_arm_x - p_b*x_v_x + b_N)*(1/p_m);
    dx[haptic_wall_X_v_y] = (b_arm_y - p_b*x_v_y - b_F)*(1/p_m);
    dx[haptic_wall_X_N_e] = larger(-x_N_e*(1/p_N_beta), -(b_N_psi + x_N_e)*(1/p_N_alpha));
    dx[haptic_wall_X_F_a] = (b_F_s - x_F_a)*(1/p_F_beta);
    return haptic_wall_OK;
}

#ifdef haptic_wall_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real x_p_x = x[haptic_wall_X_p_x];
    const real x_N_e = x[haptic_wall_X_N_e];
    const real p_mu = p[haptic_wall_P_mu];
    const real p_N_K = p[haptic_wall_P_N_K];
    const real p_N_alpha = p[haptic_wall_P_N_alpha];
    const real p_N_beta = p[haptic_wall_P_N_beta];
    const real p_F_K = p[haptic_wall_P_F_K];
    const real p_F_beta = p[haptic_wall_P_F_beta];
    const real b_N_psi = x_p_x;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    if (!(p_mu*b_N >= 0)) {
        return haptic_wall_BROKEN + 0;
    }
    if (!(p_mu >= 0)) {
        return haptic_wall_BROKEN + 1;
    }
    if (!(p_N_K > 0)) {
        return haptic_wall_BROKEN + 2;
    }
    if (!(p_N_alpha > 0)) {
        return haptic_wall_BROKEN + 3;
    }
    if (!(p_N_alpha <= p_N_beta)) {
        return haptic_wall_BROKEN + 4;
    }
    if (!(p_N_beta > 0)) {
        return haptic_wall_BROKEN + 5;
    }
    if (!(p_F_K > 0)) {
        return haptic_wall_BROKEN + 6;
    }
    if (!(p_F_beta > 0)) {
        return haptic_wall_BROKEN + 7;
    }
    return haptic_wall_OK;
}
#endif

static const int jac_rows[] = {
    2, 3, 4, 5, 3, 0, 2, 1, 3, 5, 2, 3, 4, 5, 3, 5
};

static const int jac_columns[] = {
    0, 4, 5, 7, 10, 14, 16
};

int haptic_wall_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef haptic_wall_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int haptic_wall_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_p_x = x[haptic_wall_X_p_x];
    const real x_v_y = x[haptic_wall_X_v_y];
    const real x_N_e = x[haptic_wall_X_N_e];
    const real x_F_a = x[haptic_wall_X_F_a];
    const real p_mu = p[haptic_wall_P_mu];
    const real p_N_K = p[haptic_wall_P_N_K];
    const real p_N_alpha = p[haptic_wall_P_N_alpha];
    const real p_N_beta = p[haptic_wall_P_N_beta];
    const real p_F_K = p[haptic_wall_P_F_K];
    const real p_F_beta = p[haptic_wall_P_F_beta];
    const real b_N_psi = x_p_x;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z = x_F_a + p_F_beta*x_v_y;
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_F_s = sat(b_F_Z, b_F_z);
    const real b_F = p_F_K*b_F_s;
    y[haptic_wall_Y_felt_x] = b_N;
    y[haptic_wall_Y_felt_y] = -b_F;
    y[haptic_wall_Y_N] = b_N;
    y[haptic_wall_Y_F] = b_F;
    return haptic_wall_OK;
}

int haptic_wall_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_p_x = x[haptic_wall_X_p_x];
    const real x_v_y = x[haptic_wall_X_v_y];
    const real x_N_e = x[haptic_wall_X_N_e];
    const real x_F_a = x[haptic_wall_X_F_a];
    const real p_m = p[haptic_wall_P_m];
    const real p_b = p[haptic_wall_P_b];
    const real p_k = p[haptic_wall_P_k];
    const real p_c = p[haptic_wall_P_c];
    const real p_mu = p[haptic_wall_P_mu];
    const real p_N_K = p[haptic_wall_P_N_K];
    const real p_N_alpha = p[haptic_wall_P_N_alpha];
    const real p_N_beta = p[haptic_wall_P_N_beta];
    const real p_F_K = p[haptic_wall_P_F_K];
    const real p_F_beta = p[haptic_wall_P_F_beta];
    const real b_shared_1 = 1/p_N_alpha;
    const real b_shared_2 = -b_shared_1*p_N_beta;
    const real b_shared_3 = 1/p_F_K*p_mu;
    const real b_shared_4 = 1/p_N_beta;
    const real b_shared_5 = 1/p_m;
    const real b_shared_6 = b_shared_5*(-p_k);
    const real b_shared_7 = b_shared_5*(-p_c);
    const real b_shared_8 = -b_shared_5*p_b;
    const real b_shared_10 = 1/p_F_beta;
    const real b_N_psi = x_p_x;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z = x_F_a + p_F_beta*x_v_y;
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_N_part1 = x_N_e - p_N_beta*(b_N_psi + x_N_e)*b_shared_1;
    const real b_N_part1_d_N_e = 1 + b_shared_2;
    const real b_N_part1_d_p_x = b_shared_2;
    const real b_N_d_N_e = 0 < b_N_part1 ? p_N_K*b_N_part1_d_N_e : 0;
    const real b_N_d_p_x = 0 < b_N_part1 ? p_N_K*b_N_part1_d_p_x : 0;
    const real b_F_Z_d_N_e = b_shared_3*b_N_d_N_e;
    const real b_F_Z_d_p_x = b_shared_3*b_N_d_p_x;
    const real b_F_s_d_F_a = fabs(b_F_z) < b_F_Z ? (real)1 : 0;
    const real b_F_s_d_v_y = fabs(b_F_z) < b_F_Z ? p_F_beta : 0;
    const real b_F_s_d_N_e = (b_F_z >= b_F_Z && b_F_z > 0 ? b_F_Z_d_N_e : 0) + (-b_F_z >= b_F_Z &&
        b_F_z < 0 ? -b_F_Z_d_N_e : 0);
    const real b_F_s_d_p_x = (b_F_z >= b_F_Z && b_F_z > 0 ? b_F_Z_d_p_x : 0) + (-b_F_z >= b_F_Z &&
        b_F_z < 0 ? -b_F_Z_d_p_x : 0);
    const real b_N_e_rate_part2 = -x_N_e*b_shared_4;
    const real b_N_e_rate_part3 = -(b_N_psi + x_N_e)*b_shared_1;
    const real b_shared_9 = b_N_e_rate_part2 < b_N_e_rate_part3 ? -b_shared_1 : 0;
    J[5] = 1;
    J[7] = 1;
    J[0] = b_shared_6 + b_shared_5*b_N_d_p_x;
    J[6] = b_shared_7 + b_shared_8;
    J[10] = b_shared_5*b_N_d_N_e;
    J[4] = b_shared_6;
    J[8] = b_shared_7 + b_shared_8 + (-b_shared_5*(p_F_K*b_F_s_d_v_y));
    J[14] = -b_shared_5*(p_F_K*b_F_s_d_F_a);
    J[11] = -b_shared_5*(p_F_K*b_F_s_d_N_e);
    J[1] = -b_shared_5*(p_F_K*b_F_s_d_p_x);
    J[12] = (b_N_e_rate_part2 >= b_N_e_rate_part3 ? -b_shared_4 : 0) + b_shared_9;
    J[2] = b_shared_9;
    J[15] = b_shared_10*b_F_s_d_F_a - b_shared_10;
    J[9] = b_shared_10*b_F_s_d_v_y;
    J[13] = b_shared_10*b_F_s_d_N_e;
    J[3] = b_shared_10*b_F_s_d_p_x;
    return haptic_wall_OK;
}

int haptic_wall_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < haptic_wall_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= haptic_wall_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return haptic_wall_OK;
}

int haptic_wall_init(const real *p, real *x)
{
    (void)p;
    x[haptic_wall_X_p_x] = (real)0.02;
    x[haptic_wall_X_p_y] = 0;
    x[haptic_wall_X_v_x] = 0;
    x[haptic_wall_X_v_y] = 0;
    x[haptic_wall_X_N_e] = 0;
    x[haptic_wall_X_F_a] = 0;
    return haptic_wall_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < haptic_wall_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return haptic_wall_NOT_FINITE;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return haptic_wall_OK;
}

int haptic_wall_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef haptic_wall_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[6], k2[6], k3[6], k4[6], next[6];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int haptic_wall_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef haptic_wall_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[6], k2[6], next[6];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int haptic_wall_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef haptic_wall_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[6], next[6];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < haptic_wall_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const haptic_wall_real haptic_wall_p0[] = {
    (real)0.15, (real)0.8, 250, 6, (real)0.4, 50000, (real)0.001, (real)0.002, 50000,
    (real)0.002
};

const char haptic_wall_x_names[] =
    "p.x\0p.y\0v.x\0v.y\0N.e\0F.a\0";

const char haptic_wall_u_names[] =
    "hand.x\0hand.y\0";

const char haptic_wall_p_names[] =
    "m\0b\0k\0c\0mu\0N.K\0N.alpha\0N.beta\0F.K\0F.beta\0";

const char haptic_wall_y_names[] =
    "felt.x\0felt.y\0N\0F\0";

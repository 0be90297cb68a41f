/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "hopping_leg.h"

#include <math.h>

typedef hopping_leg_real real;

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
    const real x_y = x[hopping_leg_X_y];
    const real x_yf = x[hopping_leg_X_yf];
    const real x_v = x[hopping_leg_X_v];
    const real x_vf = x[hopping_leg_X_vf];
    const real x_N_e = x[hopping_leg_X_N_e];
    const real x_S_e = x[hopping_leg_X_S_e];
    const real p_M = p[hopping_leg_P_M];
    const real p_m = p[hopping_leg_P_m];
    const real p_k = p[hopping_leg_P_k];
    const real p_c = p[hopping_leg_P_c];
    const real p_l0 = p[hopping_leg_P_l0];
    const real p_s = p[hopping_leg_P_s];
    const real p_A = p[hopping_leg_P_A];
    const real p_omega = p[hopping_leg_P_omega];
    const real p_g = p[hopping_leg_P_g];
    const real p_N_K = p[hopping_leg_P_N_K];
    const real p_N_alpha = p[hopping_leg_P_N_alpha];
    const real p_N_beta = p[hopping_leg_P_N_beta];
    const real p_S_K = p[hopping_leg_P_S_K];
    const real p_S_alpha = p[hopping_leg_P_S_alpha];
    const real p_S_beta = p[hopping_leg_P_S_beta];
    const real b_rest = p_l0 + p_A*sin(p_omega*t);
    const real b_leg = p_k*(b_rest - (x_y - x_yf)) - p_c*(x_v - x_vf);
    const real b_N_psi = x_yf;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_S_psi = p_s - (x_y - x_yf);
    const real b_S = p_S_K*max0(x_S_e - p_S_beta*(b_S_psi + x_S_e)*(1/p_S_alpha));
    dx[hopping_leg_X_y] = x_v;
    dx[hopping_leg_X_yf] = x_vf;
    dx[hopping_leg_X_v] = (b_leg - b_S - p_M*p_g)*(1/p_M);
    dx[hopping_leg_X_vf] = (b_N + b_S - b_leg - p_m*p_g)*(1/p_m);
    dx[hopping_leg_X_N_e] = larger(-x_N_e*(1/p_N_beta), -(b_N_psi + x_N_e)*(1/p_N_alpha));
    dx[hopping_leg_X_S_e] = larger(-x_S_e*(1/p_S_beta), -(b_S_psi + x_S_e)*(1/p_S_alpha));
    return hopping_leg_OK;
}

#ifdef hopping_leg_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)x;
    (void)u;
    const real p_N_K = p[hopping_leg_P_N_K];
    const real p_N_alpha = p[hopping_leg_P_N_alpha];
    const real p_N_beta = p[hopping_leg_P_N_beta];
    const real p_S_K = p[hopping_leg_P_S_K];
    const real p_S_alpha = p[hopping_leg_P_S_alpha];
    const real p_S_beta = p[hopping_leg_P_S_beta];
    if (!(p_N_K > 0)) {
        return hopping_leg_BROKEN + 0;
    }
    if (!(p_N_alpha > 0)) {
        return hopping_leg_BROKEN + 1;
    }
    if (!(p_N_alpha <= p_N_beta)) {
        return hopping_leg_BROKEN + 2;
    }
    if (!(p_N_beta > 0)) {
        return hopping_leg_BROKEN + 3;
    }
    if (!(p_S_K > 0)) {
        return hopping_leg_BROKEN + 4;
    }
    if (!(p_S_alpha > 0)) {
        return hopping_leg_BROKEN + 5;
    }
    if (!(p_S_alpha <= p_S_beta)) {
        return hopping_leg_BROKEN + 6;
    }
    if (!(p_S_beta > 0)) {
        return hopping_leg_BROKEN + 7;
    }
    return hopping_leg_OK;
}
#endif

static const int jac_rows[] = {
    2, 3, 5, 2, 3, 4, 5, 0, 2, 3, 1, 2, 3, 3, 4, 2,
    3, 5
};

static const int jac_columns[] = {
    0, 3, 7, 10, 13, 15, 18
};

int hopping_leg_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef hopping_leg_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int hopping_leg_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_y = x[hopping_leg_X_y];
    const real x_yf = x[hopping_leg_X_yf];
    const real x_N_e = x[hopping_leg_X_N_e];
    const real x_S_e = x[hopping_leg_X_S_e];
    const real p_s = p[hopping_leg_P_s];
    const real p_N_K = p[hopping_leg_P_N_K];
    const real p_N_alpha = p[hopping_leg_P_N_alpha];
    const real p_N_beta = p[hopping_leg_P_N_beta];
    const real p_S_K = p[hopping_leg_P_S_K];
    const real p_S_alpha = p[hopping_leg_P_S_alpha];
    const real p_S_beta = p[hopping_leg_P_S_beta];
    const real b_N_psi = x_yf;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_S_psi = p_s - (x_y - x_yf);
    const real b_S = p_S_K*max0(x_S_e - p_S_beta*(b_S_psi + x_S_e)*(1/p_S_alpha));
    y[hopping_leg_Y_N] = b_N;
    y[hopping_leg_Y_S] = b_S;
    return hopping_leg_OK;
}

int hopping_leg_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_y = x[hopping_leg_X_y];
    const real x_yf = x[hopping_leg_X_yf];
    const real x_N_e = x[hopping_leg_X_N_e];
    const real x_S_e = x[hopping_leg_X_S_e];
    const real p_M = p[hopping_leg_P_M];
    const real p_m = p[hopping_leg_P_m];
    const real p_k = p[hopping_leg_P_k];
    const real p_c = p[hopping_leg_P_c];
    const real p_s = p[hopping_leg_P_s];
    const real p_N_K = p[hopping_leg_P_N_K];
    const real p_N_alpha = p[hopping_leg_P_N_alpha];
    const real p_N_beta = p[hopping_leg_P_N_beta];
    const real p_S_K = p[hopping_leg_P_S_K];
    const real p_S_alpha = p[hopping_leg_P_S_alpha];
    const real p_S_beta = p[hopping_leg_P_S_beta];
    const real b_shared_1 = 1/p_N_alpha;
    const real b_shared_2 = -b_shared_1*p_N_beta;
    const real b_shared_3 = 1/p_S_alpha;
    const real b_shared_4 = -b_shared_3*p_S_beta;
    const real b_shared_5 = 1/p_N_beta;
    const real b_shared_6 = 1/p_S_beta;
    const real b_shared_7 = 1/p_M;
    const real b_shared_8 = 1/p_m;
    const real b_N_psi = x_yf;
    const real b_S_psi = p_s - (x_y - x_yf);
    const real b_N_part1 = x_N_e - p_N_beta*(b_N_psi + x_N_e)*b_shared_1;
    const real b_N_part1_d_N_e = 1 + b_shared_2;
    const real b_N_part1_d_yf = b_shared_2;
    const real b_N_d_N_e = 0 < b_N_part1 ? p_N_K*b_N_part1_d_N_e : 0;
    const real b_N_d_yf = 0 < b_N_part1 ? p_N_K*b_N_part1_d_yf : 0;
    const real b_S_part2 = x_S_e - p_S_beta*(b_S_psi + x_S_e)*b_shared_3;
    const real b_S_part2_d_S_e = 1 + b_shared_4;
    const real b_S_part2_d_y = -b_shared_4;
    const real b_S_part2_d_yf = b_shared_4;
    const real b_S_d_S_e = 0 < b_S_part2 ? p_S_K*b_S_part2_d_S_e : 0;
    const real b_S_d_y = 0 < b_S_part2 ? p_S_K*b_S_part2_d_y : 0;
    const real b_S_d_yf = 0 < b_S_part2 ? p_S_K*b_S_part2_d_yf : 0;
    const real b_N_e_rate_part3 = -x_N_e*b_shared_5;
    const real b_N_e_rate_part4 = -(b_N_psi + x_N_e)*b_shared_1;
    const real b_shared_9 = b_N_e_rate_part3 < b_N_e_rate_part4 ? -b_shared_1 : 0;
    const real b_S_e_rate_part5 = -x_S_e*b_shared_6;
    const real b_S_e_rate_part6 = -(b_S_psi + x_S_e)*b_shared_3;
    const real b_shared_10 = b_S_e_rate_part5 < b_S_e_rate_part6 ? -b_shared_3 : 0;
    J[7] = 1;
    J[10] = 1;
    J[0] = b_shared_7*(-p_k) + (-b_shared_7*b_S_d_y);
    J[3] = b_shared_7*p_k + (-b_shared_7*b_S_d_yf);
    J[8] = b_shared_7*(-p_c);
    J[11] = b_shared_7*p_c;
    J[15] = -b_shared_7*b_S_d_S_e;
    J[13] = b_shared_8*b_N_d_N_e;
    J[4] = b_shared_8*b_N_d_yf + b_shared_8*b_S_d_yf + (-b_shared_8*p_k);
    J[16] = b_shared_8*b_S_d_S_e;
    J[1] = b_shared_8*b_S_d_y + (-b_shared_8*(-p_k));
    J[9] = -b_shared_8*(-p_c);
    J[12] = -b_shared_8*p_c;
    J[14] = (b_N_e_rate_part3 >= b_N_e_rate_part4 ? -b_shared_5 : 0) + b_shared_9;
    J[5] = b_shared_9;
    J[17] = (b_S_e_rate_part5 >= b_S_e_rate_part6 ? -b_shared_6 : 0) + b_shared_10;
    J[2] = b_S_e_rate_part5 < b_S_e_rate_part6 ? b_shared_3 : 0;
    J[6] = b_shared_10;
    return hopping_leg_OK;
}

int hopping_leg_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < hopping_leg_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= hopping_leg_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return hopping_leg_OK;
}

int hopping_leg_init(const real *p, real *x)
{
    (void)p;
    x[hopping_leg_X_y] = (real)0.7;
    x[hopping_leg_X_yf] = (real)0.2;
    x[hopping_leg_X_v] = 0;
    x[hopping_leg_X_vf] = 0;
    x[hopping_leg_X_N_e] = 0;
    x[hopping_leg_X_S_e] = 0;
    return hopping_leg_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < hopping_leg_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return hopping_leg_NOT_FINITE;
    }
    for (int i = 0; i < hopping_leg_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return hopping_leg_OK;
}

int hopping_leg_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef hopping_leg_CHECKS
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
    for (int i = 0; i < hopping_leg_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < hopping_leg_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < hopping_leg_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < hopping_leg_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int hopping_leg_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef hopping_leg_CHECKS
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
    for (int i = 0; i < hopping_leg_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < hopping_leg_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int hopping_leg_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef hopping_leg_CHECKS
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
    for (int i = 0; i < hopping_leg_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const hopping_leg_real hopping_leg_p0[] = {
    2, (real)0.3, 1200, 4, (real)0.5, (real)0.56, (real)0.04, 18, (real)9.81, 200000,
    (real)0.0008, (real)0.004, 200000, (real)0.0008, (real)0.004
};

const char hopping_leg_x_names[] =
    "y\0yf\0v\0vf\0N.e\0S.e\0";

const char hopping_leg_u_names[] =
    "";

const char hopping_leg_p_names[] =
    "M\0m\0k\0c\0l0\0s\0A\0omega\0g\0N.K\0N.alpha\0N.beta\0S.K\0S.alpha\0S.beta\0";

const char hopping_leg_y_names[] =
    "N\0S\0";

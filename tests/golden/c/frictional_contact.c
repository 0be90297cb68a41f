/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "frictional_contact.h"

#include <math.h>

typedef frictional_contact_real real;

static inline real max0(real y)
{
    return y <= 0 ? 0 : y;
}

static inline real larger(real a, real b)
{
    return a > b ? a : b >= a ? b : a + b;
}

/* The factor that brings a vector of norm n into the ball of radius Z; 0 where both are 0. */
static inline real shrink(real Z, real n)
{
    return n < Z ? 1 : n > 0 ? Z/n : Z + n;
}

static inline real norm2(real a, real b)
{
    return sqrt(a*a + b*b);
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)t;
    (void)u;
    const real x_p_z = x[frictional_contact_X_p_z];
    const real x_v_x = x[frictional_contact_X_v_x];
    const real x_v_y = x[frictional_contact_X_v_y];
    const real x_v_z = x[frictional_contact_X_v_z];
    const real x_N_e = x[frictional_contact_X_N_e];
    const real x_F_a_x = x[frictional_contact_X_F_a_x];
    const real x_F_a_y = x[frictional_contact_X_F_a_y];
    const real p_M = p[frictional_contact_P_M];
    const real p_mu = p[frictional_contact_P_mu];
    const real p_N_K = p[frictional_contact_P_N_K];
    const real p_N_alpha = p[frictional_contact_P_N_alpha];
    const real p_N_beta = p[frictional_contact_P_N_beta];
    const real p_F_K = p[frictional_contact_P_F_K];
    const real p_F_beta = p[frictional_contact_P_F_beta];
    const real b_N_psi = x_p_z;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z_x = x_F_a_x + p_F_beta*x_v_x;
    const real b_F_z_y = x_F_a_y + p_F_beta*x_v_y;
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_F_shrink = shrink(b_F_Z, norm2(b_F_z_x, b_F_z_y));
    const real b_F_s_x = b_F_shrink*b_F_z_x;
    const real b_F_s_y = b_F_shrink*b_F_z_y;
    const real b_F_x = p_F_K*b_F_s_x;
    const real b_F_y = p_F_K*b_F_s_y;
    dx[frictional_contact_X_p_x] = x_v_x;
    dx[frictional_contact_X_p_y] = x_v_y;
    dx[frictional_contact_X_p_z] = x_v_z;
    dx[frictional_contact_X_v_x] = -b_F_x*(1/p_M);
    dx[frictional_contact_X_v_y] = -b_F_y*(1/p_M);
    dx[frictional_contact_X_v_z] = b_N*(1/p_M);
    dx[frictional_contact_X_N_e] = larger(-x_N_e*(1/p_N_beta), -(b_N_psi + x_N_e)*(1/p_N_alpha));
    dx[frictional_contact_X_F_a_x] = (b_F_s_x - x_F_a_x)*(1/p_F_beta);
    dx[frictional_contact_X_F_a_y] = (b_F_s_y - x_F_a_y)*(1/p_F_beta);
    return frictional_contact_OK;
}

#ifdef frictional_contact_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real x_p_z = x[frictional_contact_X_p_z];
    const real x_N_e = x[frictional_contact_X_N_e];
    const real p_mu = p[frictional_contact_P_mu];
    const real p_N_K = p[frictional_contact_P_N_K];
    const real p_N_alpha = p[frictional_contact_P_N_alpha];
    const real p_N_beta = p[frictional_contact_P_N_beta];
    const real p_F_K = p[frictional_contact_P_F_K];
    const real p_F_beta = p[frictional_contact_P_F_beta];
    const real b_N_psi = x_p_z;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    if (!(p_mu*b_N >= 0)) {
        return frictional_contact_BROKEN + 0;
    }
    if (!(p_mu >= 0)) {
        return frictional_contact_BROKEN + 1;
    }
    if (!(p_N_K > 0)) {
        return frictional_contact_BROKEN + 2;
    }
    if (!(p_N_alpha > 0)) {
        return frictional_contact_BROKEN + 3;
    }
    if (!(p_N_alpha <= p_N_beta)) {
        return frictional_contact_BROKEN + 4;
    }
    if (!(p_N_beta > 0)) {
        return frictional_contact_BROKEN + 5;
    }
    if (!(p_F_K > 0)) {
        return frictional_contact_BROKEN + 6;
    }
    if (!(p_F_beta > 0)) {
        return frictional_contact_BROKEN + 7;
    }
    return frictional_contact_OK;
}
#endif

static const int jac_rows[] = {
    3, 4, 5, 6, 7, 8, 0, 3, 4, 7, 8, 1, 3, 4, 7, 8,
    2, 3, 4, 5, 6, 7, 8, 3, 4, 7, 8, 3, 4, 7, 8
};

static const int jac_columns[] = {
    0, 0, 0, 6, 11, 16, 17, 23, 27, 31
};

int frictional_contact_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef frictional_contact_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int frictional_contact_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_p_z = x[frictional_contact_X_p_z];
    const real x_v_x = x[frictional_contact_X_v_x];
    const real x_v_y = x[frictional_contact_X_v_y];
    const real x_N_e = x[frictional_contact_X_N_e];
    const real x_F_a_x = x[frictional_contact_X_F_a_x];
    const real x_F_a_y = x[frictional_contact_X_F_a_y];
    const real p_mu = p[frictional_contact_P_mu];
    const real p_N_K = p[frictional_contact_P_N_K];
    const real p_N_alpha = p[frictional_contact_P_N_alpha];
    const real p_N_beta = p[frictional_contact_P_N_beta];
    const real p_F_K = p[frictional_contact_P_F_K];
    const real p_F_beta = p[frictional_contact_P_F_beta];
    const real b_N_psi = x_p_z;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z_x = x_F_a_x + p_F_beta*x_v_x;
    const real b_F_z_y = x_F_a_y + p_F_beta*x_v_y;
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_F_shrink = shrink(b_F_Z, norm2(b_F_z_x, b_F_z_y));
    const real b_F_s_x = b_F_shrink*b_F_z_x;
    const real b_F_s_y = b_F_shrink*b_F_z_y;
    const real b_F_x = p_F_K*b_F_s_x;
    const real b_F_y = p_F_K*b_F_s_y;
    y[frictional_contact_Y_N] = b_N;
    y[frictional_contact_Y_F_x] = b_F_x;
    y[frictional_contact_Y_F_y] = b_F_y;
    return frictional_contact_OK;
}

int frictional_contact_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_p_z = x[frictional_contact_X_p_z];
    const real x_v_x = x[frictional_contact_X_v_x];
    const real x_v_y = x[frictional_contact_X_v_y];
    const real x_N_e = x[frictional_contact_X_N_e];
    const real x_F_a_x = x[frictional_contact_X_F_a_x];
    const real x_F_a_y = x[frictional_contact_X_F_a_y];
    const real p_M = p[frictional_contact_P_M];
    const real p_mu = p[frictional_contact_P_mu];
    const real p_N_K = p[frictional_contact_P_N_K];
    const real p_N_alpha = p[frictional_contact_P_N_alpha];
    const real p_N_beta = p[frictional_contact_P_N_beta];
    const real p_F_K = p[frictional_contact_P_F_K];
    const real p_F_beta = p[frictional_contact_P_F_beta];
    const real b_shared_1 = 1/p_N_alpha;
    const real b_shared_2 = -b_shared_1*p_N_beta;
    const real b_shared_3 = 1/p_F_K*p_mu;
    const real b_shared_5 = 1/p_N_beta;
    const real b_shared_6 = 1/p_M;
    const real b_shared_8 = 1/p_F_beta;
    const real b_N_psi = x_p_z;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z_x = x_F_a_x + p_F_beta*x_v_x;
    const real b_F_z_y = x_F_a_y + p_F_beta*x_v_y;
    const real b_shared_4 = norm2(b_F_z_x, b_F_z_y);
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_F_shrink = shrink(b_F_Z, norm2(b_F_z_x, b_F_z_y));
    const real b_N_part1 = x_N_e - p_N_beta*(b_N_psi + x_N_e)*b_shared_1;
    const real b_N_part1_d_N_e = 1 + b_shared_2;
    const real b_N_part1_d_p_z = b_shared_2;
    const real b_N_d_N_e = 0 < b_N_part1 ? p_N_K*b_N_part1_d_N_e : 0;
    const real b_N_d_p_z = 0 < b_N_part1 ? p_N_K*b_N_part1_d_p_z : 0;
    const real b_F_Z_d_N_e = b_shared_3*b_N_d_N_e;
    const real b_F_Z_d_p_z = b_shared_3*b_N_d_p_z;
    const real b_F_shrink_d_N_e = b_shared_4 >= b_F_Z && b_shared_4 > 0 ? 1/b_shared_4*b_F_Z_d_N_e :
        0;
    const real b_F_shrink_d_p_z = b_shared_4 >= b_F_Z && b_shared_4 > 0 ? 1/b_shared_4*b_F_Z_d_p_z :
        0;
    const real b_F_shrink_d_F_a_x = b_shared_4 >= b_F_Z && b_shared_4 > 0 ?
        -b_F_Z/b_shared_4/b_shared_4*(b_F_z_x/b_shared_4) : 0;
    const real b_F_shrink_d_v_x = b_F_shrink_d_F_a_x*p_F_beta;
    const real b_F_shrink_d_F_a_y = b_shared_4 >= b_F_Z && b_shared_4 > 0 ?
        -b_F_Z/b_shared_4/b_shared_4*(b_F_z_y/b_shared_4) : 0;
    const real b_F_shrink_d_v_y = b_F_shrink_d_F_a_y*p_F_beta;
    const real b_F_s_x_d_F_a_x = b_F_z_x*b_F_shrink_d_F_a_x + b_F_shrink;
    const real b_F_s_x_d_v_x = b_F_z_x*b_F_shrink_d_v_x + b_F_shrink*p_F_beta;
    const real b_F_s_y_d_F_a_y = b_F_z_y*b_F_shrink_d_F_a_y + b_F_shrink;
    const real b_F_s_y_d_v_y = b_F_z_y*b_F_shrink_d_v_y + b_F_shrink*p_F_beta;
    const real b_F_x_d_N_e = p_F_K*(b_F_z_x*b_F_shrink_d_N_e);
    const real b_F_x_d_p_z = p_F_K*(b_F_z_x*b_F_shrink_d_p_z);
    const real b_F_x_d_F_a_y = p_F_K*(b_F_z_x*b_F_shrink_d_F_a_y);
    const real b_F_x_d_v_y = p_F_K*(b_F_z_x*b_F_shrink_d_v_y);
    const real b_F_y_d_N_e = p_F_K*(b_F_z_y*b_F_shrink_d_N_e);
    const real b_F_y_d_p_z = p_F_K*(b_F_z_y*b_F_shrink_d_p_z);
    const real b_F_y_d_F_a_x = p_F_K*(b_F_z_y*b_F_shrink_d_F_a_x);
    const real b_F_y_d_v_x = p_F_K*(b_F_z_y*b_F_shrink_d_v_x);
    const real b_N_e_rate_part2 = -x_N_e*b_shared_5;
    const real b_N_e_rate_part3 = -(b_N_psi + x_N_e)*b_shared_1;
    const real b_shared_7 = b_N_e_rate_part2 < b_N_e_rate_part3 ? -b_shared_1 : 0;
    J[6] = 1;
    J[11] = 1;
    J[16] = 1;
    J[17] = -b_shared_6*b_F_x_d_N_e;
    J[0] = -b_shared_6*b_F_x_d_p_z;
    J[23] = -b_shared_6*(p_F_K*b_F_s_x_d_F_a_x);
    J[7] = -b_shared_6*(p_F_K*b_F_s_x_d_v_x);
    J[27] = -b_shared_6*b_F_x_d_F_a_y;
    J[12] = -b_shared_6*b_F_x_d_v_y;
    J[18] = -b_shared_6*b_F_y_d_N_e;
    J[1] = -b_shared_6*b_F_y_d_p_z;
    J[24] = -b_shared_6*b_F_y_d_F_a_x;
    J[8] = -b_shared_6*b_F_y_d_v_x;
    J[28] = -b_shared_6*(p_F_K*b_F_s_y_d_F_a_y);
    J[13] = -b_shared_6*(p_F_K*b_F_s_y_d_v_y);
    J[19] = b_shared_6*b_N_d_N_e;
    J[2] = b_shared_6*b_N_d_p_z;
    J[20] = (b_N_e_rate_part2 >= b_N_e_rate_part3 ? -b_shared_5 : 0) + b_shared_7;
    J[3] = b_shared_7;
    J[21] = b_shared_8*(b_F_z_x*b_F_shrink_d_N_e);
    J[4] = b_shared_8*(b_F_z_x*b_F_shrink_d_p_z);
    J[25] = b_shared_8*b_F_s_x_d_F_a_x - b_shared_8;
    J[9] = b_shared_8*b_F_s_x_d_v_x;
    J[29] = b_shared_8*(b_F_z_x*b_F_shrink_d_F_a_y);
    J[14] = b_shared_8*(b_F_z_x*b_F_shrink_d_v_y);
    J[22] = b_shared_8*(b_F_z_y*b_F_shrink_d_N_e);
    J[5] = b_shared_8*(b_F_z_y*b_F_shrink_d_p_z);
    J[26] = b_shared_8*(b_F_z_y*b_F_shrink_d_F_a_x);
    J[10] = b_shared_8*(b_F_z_y*b_F_shrink_d_v_x);
    J[30] = b_shared_8*b_F_s_y_d_F_a_y - b_shared_8;
    J[15] = b_shared_8*b_F_s_y_d_v_y;
    return frictional_contact_OK;
}

int frictional_contact_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < frictional_contact_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= frictional_contact_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return frictional_contact_OK;
}

int frictional_contact_init(const real *p, real *x)
{
    (void)p;
    x[frictional_contact_X_p_x] = 0;
    x[frictional_contact_X_p_y] = 0;
    x[frictional_contact_X_p_z] = (real)0.1;
    x[frictional_contact_X_v_x] = 1;
    x[frictional_contact_X_v_y] = (real)0.5;
    x[frictional_contact_X_v_z] = -1;
    x[frictional_contact_X_N_e] = 0;
    x[frictional_contact_X_F_a_x] = 0;
    x[frictional_contact_X_F_a_y] = 0;
    return frictional_contact_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < frictional_contact_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return frictional_contact_NOT_FINITE;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return frictional_contact_OK;
}

int frictional_contact_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef frictional_contact_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[9], k2[9], k3[9], k4[9], next[9];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int frictional_contact_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef frictional_contact_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[9], k2[9], next[9];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int frictional_contact_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef frictional_contact_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[9], next[9];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < frictional_contact_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const frictional_contact_real frictional_contact_p0[] = {
    1, (real)0.3, 100000, (real)0.0028, (real)0.004, 100000, (real)0.004
};

const char frictional_contact_x_names[] =
    "p.x\0p.y\0p.z\0v.x\0v.y\0v.z\0N.e\0F.a.x\0F.a.y\0";

const char frictional_contact_u_names[] =
    "";

const char frictional_contact_p_names[] =
    "M\0mu\0N.K\0N.alpha\0N.beta\0F.K\0F.beta\0";

const char frictional_contact_y_names[] =
    "N\0F.x\0F.y\0";

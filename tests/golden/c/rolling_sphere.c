/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "rolling_sphere.h"

#include <math.h>

typedef rolling_sphere_real real;

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
    const real x_p_z = x[rolling_sphere_X_p_z];
    const real x_v_x = x[rolling_sphere_X_v_x];
    const real x_v_y = x[rolling_sphere_X_v_y];
    const real x_v_z = x[rolling_sphere_X_v_z];
    const real x_w_x = x[rolling_sphere_X_w_x];
    const real x_w_y = x[rolling_sphere_X_w_y];
    const real x_w_z = x[rolling_sphere_X_w_z];
    const real x_q_1 = x[rolling_sphere_X_q_1];
    const real x_q_2 = x[rolling_sphere_X_q_2];
    const real x_q_3 = x[rolling_sphere_X_q_3];
    const real x_q_4 = x[rolling_sphere_X_q_4];
    const real x_N_e = x[rolling_sphere_X_N_e];
    const real x_F_a_x = x[rolling_sphere_X_F_a_x];
    const real x_F_a_y = x[rolling_sphere_X_F_a_y];
    const real p_M = p[rolling_sphere_P_M];
    const real p_R = p[rolling_sphere_P_R];
    const real p_mu = p[rolling_sphere_P_mu];
    const real p_g = p[rolling_sphere_P_g];
    const real p_N_K = p[rolling_sphere_P_N_K];
    const real p_N_alpha = p[rolling_sphere_P_N_alpha];
    const real p_N_beta = p[rolling_sphere_P_N_beta];
    const real p_F_K = p[rolling_sphere_P_F_K];
    const real p_F_beta = p[rolling_sphere_P_F_beta];
    const real b_slip_x = x_v_x - p_R*x_w_y;
    const real b_slip_y = x_v_y + p_R*x_w_x;
    const real b_N_psi = x_p_z - p_R;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z_x = x_F_a_x + p_F_beta*b_slip_x;
    const real b_F_z_y = x_F_a_y + p_F_beta*b_slip_y;
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_F_shrink = shrink(b_F_Z, norm2(b_F_z_x, b_F_z_y));
    const real b_F_s_x = b_F_shrink*b_F_z_x;
    const real b_F_s_y = b_F_shrink*b_F_z_y;
    const real b_F_x = p_F_K*b_F_s_x;
    const real b_F_y = p_F_K*b_F_s_y;
    const real b_f_x = -b_F_x;
    const real b_f_y = -b_F_y;
    const real b_f_z = b_N;
    dx[rolling_sphere_X_p_x] = x_v_x;
    dx[rolling_sphere_X_p_y] = x_v_y;
    dx[rolling_sphere_X_p_z] = x_v_z;
    dx[rolling_sphere_X_v_x] = b_f_x*(1/p_M);
    dx[rolling_sphere_X_v_y] = b_f_y*(1/p_M);
    dx[rolling_sphere_X_v_z] = (b_f_z - p_M*p_g)*(1/p_M);
    dx[rolling_sphere_X_w_x] = p_R*b_f_y*(1/((real)2/5*p_M*(p_R*p_R)));
    dx[rolling_sphere_X_w_y] = -p_R*b_f_x*(1/((real)2/5*p_M*(p_R*p_R)));
    dx[rolling_sphere_X_w_z] = 0;
    dx[rolling_sphere_X_q_1] = (real)1/2*(-x_w_x*x_q_2 - x_w_y*x_q_3 - x_w_z*x_q_4);
    dx[rolling_sphere_X_q_2] = (real)1/2*(x_w_x*x_q_1 + x_w_y*x_q_4 - x_w_z*x_q_3);
    dx[rolling_sphere_X_q_3] = (real)1/2*(-x_w_x*x_q_4 + x_w_y*x_q_1 + x_w_z*x_q_2);
    dx[rolling_sphere_X_q_4] = (real)1/2*(x_w_x*x_q_3 - x_w_y*x_q_2 + x_w_z*x_q_1);
    dx[rolling_sphere_X_N_e] = larger(-x_N_e*(1/p_N_beta), -(b_N_psi + x_N_e)*(1/p_N_alpha));
    dx[rolling_sphere_X_F_a_x] = (b_F_s_x - x_F_a_x)*(1/p_F_beta);
    dx[rolling_sphere_X_F_a_y] = (b_F_s_y - x_F_a_y)*(1/p_F_beta);
    return rolling_sphere_OK;
}

#ifdef rolling_sphere_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real x_p_z = x[rolling_sphere_X_p_z];
    const real x_N_e = x[rolling_sphere_X_N_e];
    const real p_R = p[rolling_sphere_P_R];
    const real p_mu = p[rolling_sphere_P_mu];
    const real p_N_K = p[rolling_sphere_P_N_K];
    const real p_N_alpha = p[rolling_sphere_P_N_alpha];
    const real p_N_beta = p[rolling_sphere_P_N_beta];
    const real p_F_K = p[rolling_sphere_P_F_K];
    const real p_F_beta = p[rolling_sphere_P_F_beta];
    const real b_N_psi = x_p_z - p_R;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    if (!(p_mu*b_N >= 0)) {
        return rolling_sphere_BROKEN + 0;
    }
    if (!(p_mu >= 0)) {
        return rolling_sphere_BROKEN + 1;
    }
    if (!(p_N_K > 0)) {
        return rolling_sphere_BROKEN + 2;
    }
    if (!(p_N_alpha > 0)) {
        return rolling_sphere_BROKEN + 3;
    }
    if (!(p_N_alpha <= p_N_beta)) {
        return rolling_sphere_BROKEN + 4;
    }
    if (!(p_N_beta > 0)) {
        return rolling_sphere_BROKEN + 5;
    }
    if (!(p_F_K > 0)) {
        return rolling_sphere_BROKEN + 6;
    }
    if (!(p_F_beta > 0)) {
        return rolling_sphere_BROKEN + 7;
    }
    return rolling_sphere_OK;
}
#endif

static const int jac_rows[] = {
    3, 4, 5, 6, 7, 13, 14, 15, 0, 3, 4, 6, 7, 14, 15, 1,
    3, 4, 6, 7, 14, 15, 2, 3, 4, 6, 7, 9, 10, 11, 12, 14,
    15, 3, 4, 6, 7, 9, 10, 11, 12, 14, 15, 9, 10, 11, 12, 10,
    11, 12, 9, 11, 12, 9, 10, 12, 9, 10, 11, 3, 4, 5, 6, 7,
    13, 14, 15, 3, 4, 6, 7, 14, 15, 3, 4, 6, 7, 14, 15
};

static const int jac_columns[] = {
    0, 0, 0, 8, 15, 22, 23, 33, 43, 47, 50, 53, 56, 59, 67, 73,
    79
};

int rolling_sphere_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef rolling_sphere_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int rolling_sphere_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_p_z = x[rolling_sphere_X_p_z];
    const real x_v_x = x[rolling_sphere_X_v_x];
    const real x_v_y = x[rolling_sphere_X_v_y];
    const real x_w_x = x[rolling_sphere_X_w_x];
    const real x_w_y = x[rolling_sphere_X_w_y];
    const real x_N_e = x[rolling_sphere_X_N_e];
    const real x_F_a_x = x[rolling_sphere_X_F_a_x];
    const real x_F_a_y = x[rolling_sphere_X_F_a_y];
    const real p_R = p[rolling_sphere_P_R];
    const real p_mu = p[rolling_sphere_P_mu];
    const real p_N_K = p[rolling_sphere_P_N_K];
    const real p_N_alpha = p[rolling_sphere_P_N_alpha];
    const real p_N_beta = p[rolling_sphere_P_N_beta];
    const real p_F_K = p[rolling_sphere_P_F_K];
    const real p_F_beta = p[rolling_sphere_P_F_beta];
    const real b_slip_x = x_v_x - p_R*x_w_y;
    const real b_slip_y = x_v_y + p_R*x_w_x;
    const real b_N_psi = x_p_z - p_R;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z_x = x_F_a_x + p_F_beta*b_slip_x;
    const real b_F_z_y = x_F_a_y + p_F_beta*b_slip_y;
    const real b_F_Z = p_mu*b_N*(1/p_F_K);
    const real b_F_shrink = shrink(b_F_Z, norm2(b_F_z_x, b_F_z_y));
    const real b_F_s_x = b_F_shrink*b_F_z_x;
    const real b_F_s_y = b_F_shrink*b_F_z_y;
    const real b_F_x = p_F_K*b_F_s_x;
    const real b_F_y = p_F_K*b_F_s_y;
    y[rolling_sphere_Y_depth] = max0(p_R - x_p_z);
    y[rolling_sphere_Y_N] = b_N;
    y[rolling_sphere_Y_F_x] = b_F_x;
    y[rolling_sphere_Y_F_y] = b_F_y;
    return rolling_sphere_OK;
}

int rolling_sphere_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_p_z = x[rolling_sphere_X_p_z];
    const real x_v_x = x[rolling_sphere_X_v_x];
    const real x_v_y = x[rolling_sphere_X_v_y];
    const real x_w_x = x[rolling_sphere_X_w_x];
    const real x_w_y = x[rolling_sphere_X_w_y];
    const real x_w_z = x[rolling_sphere_X_w_z];
    const real x_q_1 = x[rolling_sphere_X_q_1];
    const real x_q_2 = x[rolling_sphere_X_q_2];
    const real x_q_3 = x[rolling_sphere_X_q_3];
    const real x_q_4 = x[rolling_sphere_X_q_4];
    const real x_N_e = x[rolling_sphere_X_N_e];
    const real x_F_a_x = x[rolling_sphere_X_F_a_x];
    const real x_F_a_y = x[rolling_sphere_X_F_a_y];
    const real p_M = p[rolling_sphere_P_M];
    const real p_R = p[rolling_sphere_P_R];
    const real p_mu = p[rolling_sphere_P_mu];
    const real p_N_K = p[rolling_sphere_P_N_K];
    const real p_N_alpha = p[rolling_sphere_P_N_alpha];
    const real p_N_beta = p[rolling_sphere_P_N_beta];
    const real p_F_K = p[rolling_sphere_P_F_K];
    const real p_F_beta = p[rolling_sphere_P_F_beta];
    const real b_shared_1 = 1/p_N_alpha;
    const real b_shared_2 = -b_shared_1*p_N_beta;
    const real b_shared_3 = 1/p_F_K*p_mu;
    const real b_shared_5 = 1/p_N_beta;
    const real b_shared_6 = 1/p_M;
    const real b_shared_7 = 1/((real)2/5*p_M*(p_R*p_R));
    const real b_shared_8 = b_shared_7*p_R;
    const real b_shared_9 = -b_shared_7*p_R;
    const real b_shared_10 = (real)1/2*x_q_1;
    const real b_shared_12 = 1/p_F_beta;
    const real b_slip_x = x_v_x - p_R*x_w_y;
    const real b_slip_y = x_v_y + p_R*x_w_x;
    const real b_N_psi = x_p_z - p_R;
    const real b_N = p_N_K*max0(x_N_e - p_N_beta*(b_N_psi + x_N_e)*(1/p_N_alpha));
    const real b_F_z_x = x_F_a_x + p_F_beta*b_slip_x;
    const real b_F_z_y = x_F_a_y + p_F_beta*b_slip_y;
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
    const real b_F_shrink_d_w_y = b_F_shrink_d_F_a_x*(p_F_beta*(-p_R));
    const real b_F_shrink_d_F_a_y = b_shared_4 >= b_F_Z && b_shared_4 > 0 ?
        -b_F_Z/b_shared_4/b_shared_4*(b_F_z_y/b_shared_4) : 0;
    const real b_F_shrink_d_v_y = b_F_shrink_d_F_a_y*p_F_beta;
    const real b_F_shrink_d_w_x = b_F_shrink_d_F_a_y*(p_F_beta*p_R);
    const real b_F_s_x_d_F_a_x = b_F_z_x*b_F_shrink_d_F_a_x + b_F_shrink;
    const real b_F_s_x_d_v_x = b_F_z_x*b_F_shrink_d_v_x + b_F_shrink*p_F_beta;
    const real b_F_s_x_d_w_y = b_F_z_x*b_F_shrink_d_w_y + b_F_shrink*(p_F_beta*(-p_R));
    const real b_F_s_y_d_F_a_y = b_F_z_y*b_F_shrink_d_F_a_y + b_F_shrink;
    const real b_F_s_y_d_v_y = b_F_z_y*b_F_shrink_d_v_y + b_F_shrink*p_F_beta;
    const real b_F_s_y_d_w_x = b_F_z_y*b_F_shrink_d_w_x + b_F_shrink*(p_F_beta*p_R);
    const real b_F_x_d_N_e = p_F_K*(b_F_z_x*b_F_shrink_d_N_e);
    const real b_F_x_d_p_z = p_F_K*(b_F_z_x*b_F_shrink_d_p_z);
    const real b_F_x_d_F_a_y = p_F_K*(b_F_z_x*b_F_shrink_d_F_a_y);
    const real b_F_x_d_v_y = p_F_K*(b_F_z_x*b_F_shrink_d_v_y);
    const real b_F_x_d_w_x = p_F_K*(b_F_z_x*b_F_shrink_d_w_x);
    const real b_F_y_d_N_e = p_F_K*(b_F_z_y*b_F_shrink_d_N_e);
    const real b_F_y_d_p_z = p_F_K*(b_F_z_y*b_F_shrink_d_p_z);
    const real b_F_y_d_F_a_x = p_F_K*(b_F_z_y*b_F_shrink_d_F_a_x);
    const real b_F_y_d_v_x = p_F_K*(b_F_z_y*b_F_shrink_d_v_x);
    const real b_F_y_d_w_y = p_F_K*(b_F_z_y*b_F_shrink_d_w_y);
    const real b_N_e_rate_part2 = -x_N_e*b_shared_5;
    const real b_N_e_rate_part3 = -(b_N_psi + x_N_e)*b_shared_1;
    const real b_shared_11 = b_N_e_rate_part2 < b_N_e_rate_part3 ? -b_shared_1 : 0;
    J[8] = 1;
    J[15] = 1;
    J[22] = 1;
    J[59] = b_shared_6*(-b_F_x_d_N_e);
    J[0] = b_shared_6*(-b_F_x_d_p_z);
    J[67] = b_shared_6*(-p_F_K*b_F_s_x_d_F_a_x);
    J[9] = b_shared_6*(-p_F_K*b_F_s_x_d_v_x);
    J[33] = b_shared_6*(-p_F_K*b_F_s_x_d_w_y);
    J[73] = b_shared_6*(-b_F_x_d_F_a_y);
    J[16] = b_shared_6*(-b_F_x_d_v_y);
    J[23] = b_shared_6*(-b_F_x_d_w_x);
    J[60] = b_shared_6*(-b_F_y_d_N_e);
    J[1] = b_shared_6*(-b_F_y_d_p_z);
    J[68] = b_shared_6*(-b_F_y_d_F_a_x);
    J[10] = b_shared_6*(-b_F_y_d_v_x);
    J[34] = b_shared_6*(-b_F_y_d_w_y);
    J[74] = b_shared_6*(-p_F_K*b_F_s_y_d_F_a_y);
    J[17] = b_shared_6*(-p_F_K*b_F_s_y_d_v_y);
    J[24] = b_shared_6*(-p_F_K*b_F_s_y_d_w_x);
    J[61] = b_shared_6*b_N_d_N_e;
    J[2] = b_shared_6*b_N_d_p_z;
    J[62] = b_shared_8*(-b_F_y_d_N_e);
    J[3] = b_shared_8*(-b_F_y_d_p_z);
    J[69] = b_shared_8*(-b_F_y_d_F_a_x);
    J[11] = b_shared_8*(-b_F_y_d_v_x);
    J[35] = b_shared_8*(-b_F_y_d_w_y);
    J[75] = b_shared_8*(-p_F_K*b_F_s_y_d_F_a_y);
    J[18] = b_shared_8*(-p_F_K*b_F_s_y_d_v_y);
    J[25] = b_shared_8*(-p_F_K*b_F_s_y_d_w_x);
    J[63] = b_shared_9*(-b_F_x_d_N_e);
    J[4] = b_shared_9*(-b_F_x_d_p_z);
    J[70] = b_shared_9*(-p_F_K*b_F_s_x_d_F_a_x);
    J[12] = b_shared_9*(-p_F_K*b_F_s_x_d_v_x);
    J[36] = b_shared_9*(-p_F_K*b_F_s_x_d_w_y);
    J[76] = b_shared_9*(-b_F_x_d_F_a_y);
    J[19] = b_shared_9*(-b_F_x_d_v_y);
    J[26] = b_shared_9*(-b_F_x_d_w_x);
    J[27] = -(real)1/2*x_q_2;
    J[50] = -(real)1/2*x_w_x;
    J[37] = -(real)1/2*x_q_3;
    J[53] = -(real)1/2*x_w_y;
    J[43] = -(real)1/2*x_q_4;
    J[56] = -(real)1/2*x_w_z;
    J[28] = b_shared_10;
    J[47] = (real)1/2*x_w_x;
    J[38] = (real)1/2*x_q_4;
    J[57] = (real)1/2*x_w_y;
    J[44] = -(real)1/2*x_q_3;
    J[54] = -(real)1/2*x_w_z;
    J[29] = -(real)1/2*x_q_4;
    J[58] = -(real)1/2*x_w_x;
    J[39] = b_shared_10;
    J[48] = (real)1/2*x_w_y;
    J[45] = (real)1/2*x_q_2;
    J[51] = (real)1/2*x_w_z;
    J[30] = (real)1/2*x_q_3;
    J[55] = (real)1/2*x_w_x;
    J[40] = -(real)1/2*x_q_2;
    J[52] = -(real)1/2*x_w_y;
    J[46] = b_shared_10;
    J[49] = (real)1/2*x_w_z;
    J[64] = (b_N_e_rate_part2 >= b_N_e_rate_part3 ? -b_shared_5 : 0) + b_shared_11;
    J[5] = b_shared_11;
    J[65] = b_shared_12*(b_F_z_x*b_F_shrink_d_N_e);
    J[6] = b_shared_12*(b_F_z_x*b_F_shrink_d_p_z);
    J[71] = b_shared_12*b_F_s_x_d_F_a_x - b_shared_12;
    J[13] = b_shared_12*b_F_s_x_d_v_x;
    J[41] = b_shared_12*b_F_s_x_d_w_y;
    J[77] = b_shared_12*(b_F_z_x*b_F_shrink_d_F_a_y);
    J[20] = b_shared_12*(b_F_z_x*b_F_shrink_d_v_y);
    J[31] = b_shared_12*(b_F_z_x*b_F_shrink_d_w_x);
    J[66] = b_shared_12*(b_F_z_y*b_F_shrink_d_N_e);
    J[7] = b_shared_12*(b_F_z_y*b_F_shrink_d_p_z);
    J[72] = b_shared_12*(b_F_z_y*b_F_shrink_d_F_a_x);
    J[14] = b_shared_12*(b_F_z_y*b_F_shrink_d_v_x);
    J[42] = b_shared_12*(b_F_z_y*b_F_shrink_d_w_y);
    J[78] = b_shared_12*b_F_s_y_d_F_a_y - b_shared_12;
    J[21] = b_shared_12*b_F_s_y_d_v_y;
    J[32] = b_shared_12*b_F_s_y_d_w_x;
    return rolling_sphere_OK;
}

int rolling_sphere_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < rolling_sphere_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= rolling_sphere_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return rolling_sphere_OK;
}

int rolling_sphere_init(const real *p, real *x)
{
    const real p_R = p[rolling_sphere_P_R];
    x[rolling_sphere_X_p_x] = 0;
    x[rolling_sphere_X_p_y] = 0;
    x[rolling_sphere_X_p_z] = 2*p_R;
    x[rolling_sphere_X_v_x] = (real)5.5;
    x[rolling_sphere_X_v_y] = 0;
    x[rolling_sphere_X_v_z] = 0;
    x[rolling_sphere_X_w_x] = 0;
    x[rolling_sphere_X_w_y] = 0;
    x[rolling_sphere_X_w_z] = 0;
    x[rolling_sphere_X_q_1] = 1;
    x[rolling_sphere_X_q_2] = 0;
    x[rolling_sphere_X_q_3] = 0;
    x[rolling_sphere_X_q_4] = 0;
    x[rolling_sphere_X_N_e] = 0;
    x[rolling_sphere_X_F_a_x] = 0;
    x[rolling_sphere_X_F_a_y] = 0;
    return rolling_sphere_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return rolling_sphere_NOT_FINITE;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return rolling_sphere_OK;
}

int rolling_sphere_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef rolling_sphere_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[16], k2[16], k3[16], k4[16], next[16];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int rolling_sphere_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef rolling_sphere_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[16], k2[16], next[16];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int rolling_sphere_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef rolling_sphere_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[16], next[16];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < rolling_sphere_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const rolling_sphere_real rolling_sphere_p0[] = {
    1, (real)0.5, (real)0.1, (real)9.8, 100000, (real)0.0028, (real)0.004, 100000, (real)0.004
};

const char rolling_sphere_x_names[] =
    "p.x\0p.y\0p.z\0v.x\0v.y\0v.z\0w.x\0w.y\0w.z\0q[1]\0q[2]\0q[3]\0q[4]\0N.e\0F.a.x\0F.a.y\0";

const char rolling_sphere_u_names[] =
    "";

const char rolling_sphere_p_names[] =
    "M\0R\0mu\0g\0N.K\0N.alpha\0N.beta\0F.K\0F.beta\0";

const char rolling_sphere_y_names[] =
    "depth\0N\0F.x\0F.y\0";

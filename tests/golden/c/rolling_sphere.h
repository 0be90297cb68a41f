/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef rolling_sphere_H
#define rolling_sphere_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double rolling_sphere_real;

enum {
    rolling_sphere_NX = 16,
    rolling_sphere_NU = 0,
    rolling_sphere_NP = 9,
    rolling_sphere_NY = 4,
    rolling_sphere_JAC_NNZ = 79
};

/* states */
enum {
    rolling_sphere_X_p_x = 0,
    rolling_sphere_X_p_y = 1,
    rolling_sphere_X_p_z = 2,
    rolling_sphere_X_v_x = 3,
    rolling_sphere_X_v_y = 4,
    rolling_sphere_X_v_z = 5,
    rolling_sphere_X_w_x = 6,
    rolling_sphere_X_w_y = 7,
    rolling_sphere_X_w_z = 8,
    rolling_sphere_X_q_1 = 9,
    rolling_sphere_X_q_2 = 10,
    rolling_sphere_X_q_3 = 11,
    rolling_sphere_X_q_4 = 12,
    rolling_sphere_X_N_e = 13,
    rolling_sphere_X_F_a_x = 14,
    rolling_sphere_X_F_a_y = 15
};

/* parameters */
enum {
    rolling_sphere_P_M = 0,
    rolling_sphere_P_R = 1,
    rolling_sphere_P_mu = 2,
    rolling_sphere_P_g = 3,
    rolling_sphere_P_N_K = 4,
    rolling_sphere_P_N_alpha = 5,
    rolling_sphere_P_N_beta = 6,
    rolling_sphere_P_F_K = 7,
    rolling_sphere_P_F_beta = 8
};

/* outputs */
enum {
    rolling_sphere_Y_depth = 0,
    rolling_sphere_Y_N = 1,
    rolling_sphere_Y_F_x = 2,
    rolling_sphere_Y_F_y = 3
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with rolling_sphere_CHECKS): check number status - BROKEN of rolling_sphere.json. */
enum {
    rolling_sphere_OK = 0,
    rolling_sphere_NOT_FINITE = 1,
    rolling_sphere_SINGULAR = 2,
    rolling_sphere_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int rolling_sphere_rhs(rolling_sphere_real t, const rolling_sphere_real *x,
    const rolling_sphere_real *u, const rolling_sphere_real *p, rolling_sphere_real *dx);
/* The outputs y: the declared ones, then every force. */
int rolling_sphere_out(rolling_sphere_real t, const rolling_sphere_real *x,
    const rolling_sphere_real *u, const rolling_sphere_real *p, rolling_sphere_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int rolling_sphere_jac(rolling_sphere_real t, const rolling_sphere_real *x,
    const rolling_sphere_real *u, const rolling_sphere_real *p, rolling_sphere_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int rolling_sphere_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int rolling_sphere_init(const rolling_sphere_real *p, rolling_sphere_real *x);
/* One step of size h: classical Runge-Kutta. */
int rolling_sphere_step_rk4(rolling_sphere_real t, rolling_sphere_real h, rolling_sphere_real *x,
    const rolling_sphere_real *u, const rolling_sphere_real *p);
/* One step of size h: Heun. */
int rolling_sphere_step_heun(rolling_sphere_real t, rolling_sphere_real h, rolling_sphere_real *x,
    const rolling_sphere_real *u, const rolling_sphere_real *p);
/* One step of size h: explicit Euler. */
int rolling_sphere_step_euler(rolling_sphere_real t, rolling_sphere_real h, rolling_sphere_real *x,
    const rolling_sphere_real *u, const rolling_sphere_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const rolling_sphere_real rolling_sphere_p0[];
extern const char rolling_sphere_x_names[];
extern const char rolling_sphere_u_names[];
extern const char rolling_sphere_p_names[];
extern const char rolling_sphere_y_names[];

#ifdef __cplusplus
}
#endif

#endif

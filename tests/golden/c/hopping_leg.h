/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef hopping_leg_H
#define hopping_leg_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double hopping_leg_real;

enum {
    hopping_leg_NX = 6,
    hopping_leg_NU = 0,
    hopping_leg_NP = 15,
    hopping_leg_NY = 2,
    hopping_leg_JAC_NNZ = 18
};

/* states */
enum {
    hopping_leg_X_y = 0,
    hopping_leg_X_yf = 1,
    hopping_leg_X_v = 2,
    hopping_leg_X_vf = 3,
    hopping_leg_X_N_e = 4,
    hopping_leg_X_S_e = 5
};

/* parameters */
enum {
    hopping_leg_P_M = 0,
    hopping_leg_P_m = 1,
    hopping_leg_P_k = 2,
    hopping_leg_P_c = 3,
    hopping_leg_P_l0 = 4,
    hopping_leg_P_s = 5,
    hopping_leg_P_A = 6,
    hopping_leg_P_omega = 7,
    hopping_leg_P_g = 8,
    hopping_leg_P_N_K = 9,
    hopping_leg_P_N_alpha = 10,
    hopping_leg_P_N_beta = 11,
    hopping_leg_P_S_K = 12,
    hopping_leg_P_S_alpha = 13,
    hopping_leg_P_S_beta = 14
};

/* outputs */
enum {
    hopping_leg_Y_N = 0,
    hopping_leg_Y_S = 1
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with hopping_leg_CHECKS): check number status - BROKEN of hopping_leg.json. */
enum {
    hopping_leg_OK = 0,
    hopping_leg_NOT_FINITE = 1,
    hopping_leg_SINGULAR = 2,
    hopping_leg_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int hopping_leg_rhs(hopping_leg_real t, const hopping_leg_real *x, const hopping_leg_real *u,
    const hopping_leg_real *p, hopping_leg_real *dx);
/* The outputs y: the declared ones, then every force. */
int hopping_leg_out(hopping_leg_real t, const hopping_leg_real *x, const hopping_leg_real *u,
    const hopping_leg_real *p, hopping_leg_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int hopping_leg_jac(hopping_leg_real t, const hopping_leg_real *x, const hopping_leg_real *u,
    const hopping_leg_real *p, hopping_leg_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int hopping_leg_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int hopping_leg_init(const hopping_leg_real *p, hopping_leg_real *x);
/* One step of size h: classical Runge-Kutta. */
int hopping_leg_step_rk4(hopping_leg_real t, hopping_leg_real h, hopping_leg_real *x,
    const hopping_leg_real *u, const hopping_leg_real *p);
/* One step of size h: Heun. */
int hopping_leg_step_heun(hopping_leg_real t, hopping_leg_real h, hopping_leg_real *x,
    const hopping_leg_real *u, const hopping_leg_real *p);
/* One step of size h: explicit Euler. */
int hopping_leg_step_euler(hopping_leg_real t, hopping_leg_real h, hopping_leg_real *x,
    const hopping_leg_real *u, const hopping_leg_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const hopping_leg_real hopping_leg_p0[];
extern const char hopping_leg_x_names[];
extern const char hopping_leg_u_names[];
extern const char hopping_leg_p_names[];
extern const char hopping_leg_y_names[];

#ifdef __cplusplus
}
#endif

#endif

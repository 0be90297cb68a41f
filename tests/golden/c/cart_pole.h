/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef cart_pole_H
#define cart_pole_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double cart_pole_real;

enum {
    cart_pole_NX = 6,
    cart_pole_NU = 1,
    cart_pole_NP = 10,
    cart_pole_NY = 4,
    cart_pole_JAC_NNZ = 16
};

/* states */
enum {
    cart_pole_X_x = 0,
    cart_pole_X_phi = 1,
    cart_pole_X_v = 2,
    cart_pole_X_w = 3,
    cart_pole_X_F_a = 4,
    cart_pole_X_T_a = 5
};

/* inputs */
enum {
    cart_pole_U_fe = 0
};

/* parameters */
enum {
    cart_pole_P_mc = 0,
    cart_pole_P_mp = 1,
    cart_pole_P_l = 2,
    cart_pole_P_g = 3,
    cart_pole_P_Fc = 4,
    cart_pole_P_T0 = 5,
    cart_pole_P_F_K = 6,
    cart_pole_P_F_beta = 7,
    cart_pole_P_T_K = 8,
    cart_pole_P_T_beta = 9
};

/* outputs */
enum {
    cart_pole_Y_tip_x = 0,
    cart_pole_Y_tip_y = 1,
    cart_pole_Y_F = 2,
    cart_pole_Y_T = 3
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with cart_pole_CHECKS): check number status - BROKEN of cart_pole.json. */
enum {
    cart_pole_OK = 0,
    cart_pole_NOT_FINITE = 1,
    cart_pole_SINGULAR = 2,
    cart_pole_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int cart_pole_rhs(cart_pole_real t, const cart_pole_real *x, const cart_pole_real *u,
    const cart_pole_real *p, cart_pole_real *dx);
/* The outputs y: the declared ones, then every force. */
int cart_pole_out(cart_pole_real t, const cart_pole_real *x, const cart_pole_real *u,
    const cart_pole_real *p, cart_pole_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int cart_pole_jac(cart_pole_real t, const cart_pole_real *x, const cart_pole_real *u,
    const cart_pole_real *p, cart_pole_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int cart_pole_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int cart_pole_init(const cart_pole_real *p, cart_pole_real *x);
/* One step of size h: classical Runge-Kutta. */
int cart_pole_step_rk4(cart_pole_real t, cart_pole_real h, cart_pole_real *x, const cart_pole_real
    *u, const cart_pole_real *p);
/* One step of size h: Heun. */
int cart_pole_step_heun(cart_pole_real t, cart_pole_real h, cart_pole_real *x, const cart_pole_real
    *u, const cart_pole_real *p);
/* One step of size h: explicit Euler. */
int cart_pole_step_euler(cart_pole_real t, cart_pole_real h, cart_pole_real *x, const cart_pole_real
    *u, const cart_pole_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const cart_pole_real cart_pole_p0[];
extern const char cart_pole_x_names[];
extern const char cart_pole_u_names[];
extern const char cart_pole_p_names[];
extern const char cart_pole_y_names[];

#ifdef __cplusplus
}
#endif

#endif

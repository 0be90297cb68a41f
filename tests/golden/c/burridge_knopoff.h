/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef burridge_knopoff_H
#define burridge_knopoff_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double burridge_knopoff_real;

enum {
    burridge_knopoff_NX = 96,
    burridge_knopoff_NU = 0,
    burridge_knopoff_NP = 39,
    burridge_knopoff_NY = 33,
    burridge_knopoff_JAC_NNZ = 254
};

/* states */
enum {
    burridge_knopoff_X_x = 0,
    burridge_knopoff_X_v = 32,
    burridge_knopoff_X_F_a = 64
};

/* parameters */
enum {
    burridge_knopoff_P_m = 0,
    burridge_knopoff_P_kc = 1,
    burridge_knopoff_P_kp = 2,
    burridge_knopoff_P_V = 3,
    burridge_knopoff_P_vc = 4,
    burridge_knopoff_P_F0 = 5,
    burridge_knopoff_P_F_K = 37,
    burridge_knopoff_P_F_beta = 38
};

/* outputs */
enum {
    burridge_knopoff_Y_slip = 0,
    burridge_knopoff_Y_F = 1
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with burridge_knopoff_CHECKS): check number status - BROKEN of burridge_knopoff.json. */
enum {
    burridge_knopoff_OK = 0,
    burridge_knopoff_NOT_FINITE = 1,
    burridge_knopoff_SINGULAR = 2,
    burridge_knopoff_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int burridge_knopoff_rhs(burridge_knopoff_real t, const burridge_knopoff_real *x,
    const burridge_knopoff_real *u, const burridge_knopoff_real *p, burridge_knopoff_real *dx);
/* The outputs y: the declared ones, then every force. */
int burridge_knopoff_out(burridge_knopoff_real t, const burridge_knopoff_real *x,
    const burridge_knopoff_real *u, const burridge_knopoff_real *p, burridge_knopoff_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int burridge_knopoff_jac(burridge_knopoff_real t, const burridge_knopoff_real *x,
    const burridge_knopoff_real *u, const burridge_knopoff_real *p, burridge_knopoff_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int burridge_knopoff_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int burridge_knopoff_init(const burridge_knopoff_real *p, burridge_knopoff_real *x);
/* One step of size h: classical Runge-Kutta. */
int burridge_knopoff_step_rk4(burridge_knopoff_real t, burridge_knopoff_real h,
    burridge_knopoff_real *x, const burridge_knopoff_real *u, const burridge_knopoff_real *p);
/* One step of size h: Heun. */
int burridge_knopoff_step_heun(burridge_knopoff_real t, burridge_knopoff_real h,
    burridge_knopoff_real *x, const burridge_knopoff_real *u, const burridge_knopoff_real *p);
/* One step of size h: explicit Euler. */
int burridge_knopoff_step_euler(burridge_knopoff_real t, burridge_knopoff_real h,
    burridge_knopoff_real *x, const burridge_knopoff_real *u, const burridge_knopoff_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const burridge_knopoff_real burridge_knopoff_p0[];
extern const char burridge_knopoff_x_names[];
extern const char burridge_knopoff_u_names[];
extern const char burridge_knopoff_p_names[];
extern const char burridge_knopoff_y_names[];

#ifdef __cplusplus
}
#endif

#endif

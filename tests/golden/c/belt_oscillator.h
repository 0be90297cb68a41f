/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef belt_oscillator_H
#define belt_oscillator_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double belt_oscillator_real;

enum {
    belt_oscillator_NX = 3,
    belt_oscillator_NU = 0,
    belt_oscillator_NP = 8,
    belt_oscillator_NY = 1,
    belt_oscillator_JAC_NNZ = 6
};

/* states */
enum {
    belt_oscillator_X_p = 0,
    belt_oscillator_X_w = 1,
    belt_oscillator_X_Fc_a = 2
};

/* parameters */
enum {
    belt_oscillator_P_M = 0,
    belt_oscillator_P_k1 = 1,
    belt_oscillator_P_k2 = 2,
    belt_oscillator_P_F = 3,
    belt_oscillator_P_V = 4,
    belt_oscillator_P_u = 5,
    belt_oscillator_P_Fc_K = 6,
    belt_oscillator_P_Fc_beta = 7
};

/* outputs */
enum {
    belt_oscillator_Y_Fc = 0
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with belt_oscillator_CHECKS): check number status - BROKEN of belt_oscillator.json. */
enum {
    belt_oscillator_OK = 0,
    belt_oscillator_NOT_FINITE = 1,
    belt_oscillator_SINGULAR = 2,
    belt_oscillator_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int belt_oscillator_rhs(belt_oscillator_real t, const belt_oscillator_real *x,
    const belt_oscillator_real *u, const belt_oscillator_real *p, belt_oscillator_real *dx);
/* The outputs y: the declared ones, then every force. */
int belt_oscillator_out(belt_oscillator_real t, const belt_oscillator_real *x,
    const belt_oscillator_real *u, const belt_oscillator_real *p, belt_oscillator_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int belt_oscillator_jac(belt_oscillator_real t, const belt_oscillator_real *x,
    const belt_oscillator_real *u, const belt_oscillator_real *p, belt_oscillator_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int belt_oscillator_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int belt_oscillator_init(const belt_oscillator_real *p, belt_oscillator_real *x);
/* One step of size h: classical Runge-Kutta. */
int belt_oscillator_step_rk4(belt_oscillator_real t, belt_oscillator_real h, belt_oscillator_real
    *x, const belt_oscillator_real *u, const belt_oscillator_real *p);
/* One step of size h: Heun. */
int belt_oscillator_step_heun(belt_oscillator_real t, belt_oscillator_real h, belt_oscillator_real
    *x, const belt_oscillator_real *u, const belt_oscillator_real *p);
/* One step of size h: explicit Euler. */
int belt_oscillator_step_euler(belt_oscillator_real t, belt_oscillator_real h, belt_oscillator_real
    *x, const belt_oscillator_real *u, const belt_oscillator_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const belt_oscillator_real belt_oscillator_p0[];
extern const char belt_oscillator_x_names[];
extern const char belt_oscillator_u_names[];
extern const char belt_oscillator_p_names[];
extern const char belt_oscillator_y_names[];

#ifdef __cplusplus
}
#endif

#endif

/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef bouncing_mass_H
#define bouncing_mass_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double bouncing_mass_real;

enum {
    bouncing_mass_NX = 3,
    bouncing_mass_NU = 0,
    bouncing_mass_NP = 5,
    bouncing_mass_NY = 1,
    bouncing_mass_JAC_NNZ = 5
};

/* states */
enum {
    bouncing_mass_X_p = 0,
    bouncing_mass_X_v = 1,
    bouncing_mass_X_f_e = 2
};

/* parameters */
enum {
    bouncing_mass_P_M = 0,
    bouncing_mass_P_fe = 1,
    bouncing_mass_P_f_K = 2,
    bouncing_mass_P_f_alpha = 3,
    bouncing_mass_P_f_beta = 4
};

/* outputs */
enum {
    bouncing_mass_Y_f = 0
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with bouncing_mass_CHECKS): check number status - BROKEN of bouncing_mass.json. */
enum {
    bouncing_mass_OK = 0,
    bouncing_mass_NOT_FINITE = 1,
    bouncing_mass_SINGULAR = 2,
    bouncing_mass_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int bouncing_mass_rhs(bouncing_mass_real t, const bouncing_mass_real *x, const bouncing_mass_real
    *u, const bouncing_mass_real *p, bouncing_mass_real *dx);
/* The outputs y: the declared ones, then every force. */
int bouncing_mass_out(bouncing_mass_real t, const bouncing_mass_real *x, const bouncing_mass_real
    *u, const bouncing_mass_real *p, bouncing_mass_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int bouncing_mass_jac(bouncing_mass_real t, const bouncing_mass_real *x, const bouncing_mass_real
    *u, const bouncing_mass_real *p, bouncing_mass_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int bouncing_mass_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int bouncing_mass_init(const bouncing_mass_real *p, bouncing_mass_real *x);
/* One step of size h: classical Runge-Kutta. */
int bouncing_mass_step_rk4(bouncing_mass_real t, bouncing_mass_real h, bouncing_mass_real *x,
    const bouncing_mass_real *u, const bouncing_mass_real *p);
/* One step of size h: Heun. */
int bouncing_mass_step_heun(bouncing_mass_real t, bouncing_mass_real h, bouncing_mass_real *x,
    const bouncing_mass_real *u, const bouncing_mass_real *p);
/* One step of size h: explicit Euler. */
int bouncing_mass_step_euler(bouncing_mass_real t, bouncing_mass_real h, bouncing_mass_real *x,
    const bouncing_mass_real *u, const bouncing_mass_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const bouncing_mass_real bouncing_mass_p0[];
extern const char bouncing_mass_x_names[];
extern const char bouncing_mass_u_names[];
extern const char bouncing_mass_p_names[];
extern const char bouncing_mass_y_names[];

#ifdef __cplusplus
}
#endif

#endif

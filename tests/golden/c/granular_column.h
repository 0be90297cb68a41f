/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef granular_column_H
#define granular_column_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double granular_column_real;

enum {
    granular_column_NX = 30,
    granular_column_NU = 0,
    granular_column_NP = 6,
    granular_column_NY = 12,
    granular_column_JAC_NNZ = 86
};

/* states */
enum {
    granular_column_X_z = 0,
    granular_column_X_v = 10,
    granular_column_X_N_e = 20
};

/* parameters */
enum {
    granular_column_P_m = 0,
    granular_column_P_d = 1,
    granular_column_P_g = 2,
    granular_column_P_N_K = 3,
    granular_column_P_N_alpha = 4,
    granular_column_P_N_beta = 5
};

/* outputs */
enum {
    granular_column_Y_height = 0,
    granular_column_Y_energy = 1,
    granular_column_Y_N = 2
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with granular_column_CHECKS): check number status - BROKEN of granular_column.json. */
enum {
    granular_column_OK = 0,
    granular_column_NOT_FINITE = 1,
    granular_column_SINGULAR = 2,
    granular_column_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int granular_column_rhs(granular_column_real t, const granular_column_real *x,
    const granular_column_real *u, const granular_column_real *p, granular_column_real *dx);
/* The outputs y: the declared ones, then every force. */
int granular_column_out(granular_column_real t, const granular_column_real *x,
    const granular_column_real *u, const granular_column_real *p, granular_column_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int granular_column_jac(granular_column_real t, const granular_column_real *x,
    const granular_column_real *u, const granular_column_real *p, granular_column_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int granular_column_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int granular_column_init(const granular_column_real *p, granular_column_real *x);
/* One step of size h: classical Runge-Kutta. */
int granular_column_step_rk4(granular_column_real t, granular_column_real h, granular_column_real
    *x, const granular_column_real *u, const granular_column_real *p);
/* One step of size h: Heun. */
int granular_column_step_heun(granular_column_real t, granular_column_real h, granular_column_real
    *x, const granular_column_real *u, const granular_column_real *p);
/* One step of size h: explicit Euler. */
int granular_column_step_euler(granular_column_real t, granular_column_real h, granular_column_real
    *x, const granular_column_real *u, const granular_column_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const granular_column_real granular_column_p0[];
extern const char granular_column_x_names[];
extern const char granular_column_u_names[];
extern const char granular_column_p_names[];
extern const char granular_column_y_names[];

#ifdef __cplusplus
}
#endif

#endif

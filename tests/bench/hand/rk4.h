/* The classical Runge-Kutta step around the `rhs` of the file that includes this. */
void hand_step_rk4(double t, double h, double *x, const double *u, const double *p)
{
    const struct scene s = prepare(p);
    double k[NX], y[NX], sum[NX];
    (void)t;
    (void)u;
    rhs(&s, x, k);
    for (int i = 0; i < NX; i++) { sum[i] = k[i]; y[i] = x[i] + h / 2 * k[i]; }
    rhs(&s, y, k);
    for (int i = 0; i < NX; i++) { sum[i] += 2 * k[i]; y[i] = x[i] + h / 2 * k[i]; }
    rhs(&s, y, k);
    for (int i = 0; i < NX; i++) { sum[i] += 2 * k[i]; y[i] = x[i] + h * k[i]; }
    rhs(&s, y, k);
    for (int i = 0; i < NX; i++) x[i] += h / 6 * (sum[i] + k[i]);
}

"""Small functions that generated C calls, each written only where it is used.

NaN passes through every one of them: ``fmax`` and a plain clamp would swallow it, and a
broken state would look like an open contact. ``@`` stands for ``f`` where real is float.
"""

from __future__ import annotations

from collections.abc import Iterable

#: Text and the helpers that it calls.
HELPERS: dict[str, tuple[str, tuple[str, ...]]] = {
    "max0": (
        """\
static inline real max0(real y)
{
    return y <= 0 ? 0 : y;
}
""",
        (),
    ),
    "larger": (
        """\
static inline real larger(real a, real b)
{
    return a > b ? a : b >= a ? b : a + b;
}
""",
        (),
    ),
    "smaller": (
        """\
static inline real smaller(real a, real b)
{
    return a < b ? a : b <= a ? b : a + b;
}
""",
        (),
    ),
    "sat": (
        """\
/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs@(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}
""",
        (),
    ),
    "shrink": (
        """\
/* The factor that brings a vector of norm n into the ball of radius Z; 0 where both are 0. */
static inline real shrink(real Z, real n)
{
    return n < Z ? 1 : n > 0 ? Z/n : Z + n;
}
""",
        (),
    ),
    "floored_mod": (
        """\
/* The remainder with the sign of b. */
static inline real floored_mod(real a, real b)
{
    const real r = fmod@(a, b);
    return (r < 0 && b > 0) || (r > 0 && b < 0) ? r + b : r;
}
""",
        (),
    ),
    "norm2": (
        """\
static inline real norm2(real a, real b)
{
    return sqrt@(a*a + b*b);
}
""",
        (),
    ),
    "norm3": (
        """\
static inline real norm3(real a, real b, real c)
{
    return sqrt@(a*a + b*b + c*c);
}
""",
        (),
    ),
    "norm4": (
        """\
static inline real norm4(real a, real b, real c, real d)
{
    return sqrt@(a*a + b*b + c*c + d*d);
}
""",
        (),
    ),
    "square": (
        """\
static inline real square(real a)
{
    return a*a;
}
""",
        (),
    ),
    "cube": (
        """\
static inline real cube(real a)
{
    return a*a*a;
}
""",
        (),
    ),
    "power": (
        """\
/* a to the power of a whole number n > 0. */
static inline real power(real a, int n)
{
    real result = n % 2 ? a : 1;
    while (n /= 2) {
        a *= a;
        if (n % 2) {
            result *= a;
        }
    }
    return result;
}
""",
        (),
    ),
    "solve2": (
        """\
/* Solves a 2x2 system in place; 0 if the matrix is singular to working accuracy. */
static inline int solve2(const real *a, real *b)
{
    const real down = a[0]*a[3], up = a[1]*a[2], det = down - up;
    const real first = a[3]*b[0] - a[1]*b[1];
    const real second = a[0]*b[1] - a[2]*b[0];
    if (fabs@(det) <= ROUNDING*(fabs@(down) + fabs@(up))) {
        return 0;
    }
    b[0] = first/det;
    b[1] = second/det;
    return 1;
}
""",
        (),
    ),
    "solve": (
        """\
/* Solves an n x n system in place by Gauss elimination, on rows of equal size, with partial
   pivoting; 0 if the matrix is singular to working accuracy. */
static int solve(int n, real *a, real *b, real *size)
{
    for (int i = 0; i < n; ++i) {
        real largest = 0;
        for (int j = 0; j < n; ++j) {
            largest = larger(largest, fabs@(a[n*i + j]));
        }
        if (largest == 0) {
            return 0;
        }
        for (int j = 0; j < n; ++j) {
            a[n*i + j] /= largest;
        }
        b[i] /= largest;
    }
    for (int j = 0; j < n; ++j) {
        size[j] = 0;
        for (int i = 0; i < n; ++i) {
            size[j] = larger(size[j], fabs@(a[n*i + j]));
        }
    }
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i) {
            pivot = fabs@(a[n*i + k]) > fabs@(a[n*pivot + k]) ? i : pivot;
        }
        if (fabs@(a[n*pivot + k]) <= 2*(real)n*ROUNDING*size[k]) {
            return 0;
        }
        for (int j = 0; j < n; ++j) {
            const real moved = a[n*k + j];
            a[n*k + j] = a[n*pivot + j];
            a[n*pivot + j] = moved;
        }
        const real moved = b[k];
        b[k] = b[pivot];
        b[pivot] = moved;
        for (int i = k + 1; i < n; ++i) {
            const real factor = a[n*i + k]/a[n*k + k];
            for (int j = k + 1; j < n; ++j) {
                a[n*i + j] -= factor*a[n*k + j];
            }
            b[i] -= factor*b[k];
        }
    }
    for (int k = n - 1; k >= 0; --k) {
        for (int j = k + 1; j < n; ++j) {
            b[k] -= a[n*k + j]*b[j];
        }
        b[k] /= a[n*k + k];
    }
    return 1;
}
""",
        ("larger",),
    ),
}

#: A few units in the last place of one: below it, a difference is rounding.
_ROUNDING = {False: "(real)8.9e-16", True: "(real)4.8e-7"}


def with_helpers(used: Iterable[str], single: bool) -> list[str]:
    """Return the text of helpers and of those that they call, in the table's order."""
    wanted = set(used) & HELPERS.keys()
    for name in reversed(HELPERS):
        if name in wanted:
            wanted.update(HELPERS[name][1])
    suffix = "f" if single else ""
    return [
        text.replace("@", suffix).replace("ROUNDING", _ROUNDING[single])
        for name, (text, _) in HELPERS.items()
        if name in wanted
    ]


def need_math(used: Iterable[str]) -> bool:
    """Whether ``math.h`` is wanted by what generated code calls."""
    return any("@" in HELPERS[name][0] if name in HELPERS else True for name in used)

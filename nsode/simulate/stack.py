"""A compiled step keeps its arrays on the stack: told before the run, not by a crash."""

from __future__ import annotations

from nsode.diagnostics import Diagnostic
from nsode.ode import AugmentedODE, Binding, size

_STAGES = 10  # of any method that is compiled, the new state and a copy counted in
_SHARE = 0.8  # of the stack; the rest is the interpreter's


def too_large_for_the_stack(ode: AugmentedODE) -> Diagnostic | None:
    """Return why a step would not fit onto the stack of this process, None if it does."""
    limit = _limit()
    values = _STAGES * sum(map(size, ode.states))
    values += sum(size(item) for item in ode.bindings if isinstance(item, Binding) and item.range)
    needed = 8 * values
    if limit is None or needed <= _SHARE * limit:
        return None
    return Diagnostic(
        "NS511",
        f"a step needs up to {needed / 1e6:.0f} MB of stack, and there are {limit / 1e6:.0f} MB",
        notes=("the generated C allocates nothing: its arrays live on the stack",),
        help=f"run `ulimit -s {2 * needed // 1024}` in the shell first, or shorten the family",
    )


def _limit() -> int | None:
    try:
        import resource
    except ModuleNotFoundError:  # not on Windows
        return None
    soft, _ = resource.getrlimit(resource.RLIMIT_STACK)
    return None if soft == resource.RLIM_INFINITY else soft

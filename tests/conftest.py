"""Fixtures that tests of several kinds share."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest
from hypothesis import settings

import nsode
from nsode.ode import AugmentedODE
from support.native import FLAGS, Native, Real, build, have

# How long an example takes depends on the machine; what it finds may not.
settings.register_profile("nsode", deadline=None)
settings.load_profile("nsode")


def pytest_report_header() -> str:
    return f"nsode {nsode.__version__} from {Path(nsode.__file__).parent}"


@pytest.fixture(scope="session", autouse=True)
def _cache_of_its_own(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session")
def compile_c(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Native]:
    """``compile_c(ode or text, real=, cc=, flags=, prefix=)``: the C of a model, loaded."""

    def compile_(
        model: AugmentedODE | str | Path,
        *,
        real: Real = "double",
        cc: str = "gcc",
        flags: Sequence[str] = FLAGS,
        prefix: str | None = None,
    ) -> Native:
        if not have(cc):
            pytest.skip(f"{cc} is not installed")
        match model:
            case AugmentedODE():
                ode = model
            case Path():
                ode = nsode.load(model).ode
            case _:
                ode = nsode.loads(model).ode
        folder = tmp_path_factory.mktemp(ode.name)
        return build(ode, folder, real=real, cc=cc, flags=flags, prefix=prefix)

    return compile_

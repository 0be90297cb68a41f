"""The driver, and the model that people hold."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from nsode.backends import Options
from nsode.backends import emit as emit_target
from nsode.diagnostics import Diagnostic, ModelError
from nsode.files import write_all
from nsode.inclusion import build
from nsode.ode import AugmentedODE, DifferentialInclusion
from nsode.rewrite import rewrite
from nsode.rewrite.start import at_start
from nsode.source import Source
from nsode.syntax import decode, parse, read


@dataclass(frozen=True, slots=True)
class Model:
    """A compiled model.

    ``inclusion`` is the differential inclusion in normal form, ``ode`` its augmented
    ODE, ``diagnostics`` the warnings and notes that it drew.
    """

    inclusion: DifferentialInclusion
    ode: AugmentedODE
    diagnostics: tuple[Diagnostic, ...]

    @property
    def name(self) -> str:
        """The name of the model, an identifier."""
        return self.ode.name

    @property
    def source(self) -> Source:
        """The text that the model was compiled from."""
        return self.ode.source

    def emit(self, target: str, options: Options = Options()) -> dict[str, str]:
        """Return the files of a target by name, without writing them.

        Raises
        ------
        KeyError
            If there is no such target.
        """
        return emit_target(target, self.ode, options)

    def compile(self, target: str, folder: str | Path, options: Options = Options()) -> list[Path]:
        """Write the files of a target into ``folder``, all of them or none.

        Returns
        -------
        list of Path
            The files written.

        Raises
        ------
        OSError
            If they cannot be written; nothing half written stays behind.
        """
        return write_all(self.emit(target, options), Path(folder))


def load(path: str | Path) -> Model:
    """Compile the model in a file.

    Raises
    ------
    ModelError
        If the file cannot be read or the model is refused.
    """
    return compile_source(read(Path(path)))


def loads(text: str | bytes, name: str = "<string>") -> Model:
    """Compile a model from its text.

    Raises
    ------
    ModelError
        If the model is refused.
    """
    data = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    return compile_source(decode(name, data))


def compile_source(source: Source) -> Model:
    """Compile a model from its source.

    Raises
    ------
    ModelError
        If the model is refused; it names the source.
    """
    try:
        inclusion, diagnostics = build(parse(source))
        ode = rewrite(inclusion)
        return Model(inclusion, ode, (*diagnostics, *at_start(ode)))
    except ModelError as error:
        raise ModelError(error.diagnostics, source) from None

"""``nsode check``."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

import click

from nsode.cli.failure import REFUSED, status_of
from nsode.cli.model import STANDARD_INPUT, load, summary
from nsode.cli.options import complete_files, limit_option
from nsode.cli.terminal import complain, say
from nsode.diagnostics import Diagnostic, ModelError, as_json, visible
from nsode.limits import Limits
from nsode.source import Source

SCHEMA_VERSION = 1  # of the JSON


@dataclass(frozen=True, slots=True)
class Finding:
    """What came out for one model; ``summary`` is None where it is refused."""

    source: Source
    diagnostics: tuple[Diagnostic, ...]
    summary: str | None
    status: int


@click.command()
@click.argument("models", nargs=-1, required=True, shell_complete=complete_files)
@click.option(
    "--format", "style", type=click.Choice(["text", "json"]), default="text", show_default=True,
    help="For a person, or for an editor or a script.",
)  # fmt: skip
@click.option("--strict", is_flag=True, help="Refuse what draws a warning.")
@click.option("--watch", is_flag=True, help="Check again whenever a model changes, until Ctrl-C.")
@limit_option
def command(models: tuple[str, ...], style: str, strict: bool, watch: bool, limits: Limits) -> int:
    """Say whether MODELS are sound, and what is wrong where they are not.

    Exit code 0: all are; 1: one is refused; 2: one cannot be read.
    """
    if not watch:
        return _check(models, style, strict, limits)
    if STANDARD_INPUT in models:
        raise click.UsageError("`--watch` needs files, not standard input")
    return _watch(models, style, strict, limits)


def _watch(models: Sequence[str], style: str, strict: bool, limits: Limits) -> int:
    from nsode.cli.watch import watched

    try:
        for _ in watched(models):
            _check(models, style, strict, limits)
    except KeyboardInterrupt:
        pass
    return 0


def _check(models: Sequence[str], style: str, strict: bool, limits: Limits) -> int:
    findings = [_examine(model, strict, limits) for model in models]
    if style == "json":
        say(json.dumps({"schema_version": SCHEMA_VERSION, "files": list(map(_plain, findings))}))
    else:
        for finding in findings:
            _show(finding)
    return max(finding.status for finding in findings)


def _examine(argument: str, strict: bool, limits: Limits) -> Finding:
    try:
        model = load(argument, limits)
    except ModelError as error:
        source = error.source or Source(argument, "")
        return Finding(source, error.diagnostics, None, status_of(error))
    warned = any(d.severity == "warning" for d in model.diagnostics)
    status = REFUSED if strict and warned else 0
    return Finding(model.ode.source, tuple(model.diagnostics), summary(model), status)


def _show(finding: Finding) -> None:
    complain(finding.diagnostics, finding.source)
    if finding.status == 0:
        say(f"{visible(finding.source.name)}: ok, {finding.summary}")


def _plain(finding: Finding) -> dict[str, object]:
    found = as_json(finding.diagnostics, finding.source)
    return found | {"ok": finding.status == 0, "summary": finding.summary}
